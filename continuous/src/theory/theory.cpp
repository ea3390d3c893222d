// SPDX-License-Identifier: MIT
#include "theory/theory.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "quadrille/core/contract.hpp"
#include "theory/formula_writers.hpp"

namespace quadrille::continuous {

using sat::Lit;
using sat::Truth;

ContinuousTheory::ContinuousTheory(Model& model)
    : model_(model),
      paths_(model),
      trail_(paths_, model.instance().num_agents(), kAnyCost),
      search_(model),
      finder_(model.instance(), &model.limits()),
      bans_(model.instance().roadmap()),
      clauses_(model, finder_, bans_),
      pair_lemmas_(model),
      caches_(model.instance().num_agents()),
      apart_(caches_.size() * caches_.size()) {
  for (const AgentId i : model.instance().agent_ids()) {
    const TimedPath* path = search_.find(i, {}, kAnyCost).path();
    QUADRILLE_REQUIRE(path != nullptr, "goals can be reached");
    paths_.set_path(i, remember(i, *path));
  }
}

// ---- the assignment -----------------------------------------------------------------------------

void ContinuousTheory::on_assign(std::span<const Lit> newly_true) {
  trail_.notice(model_.obstacles());
  num_assigned_ += static_cast<std::int64_t>(newly_true.size());
  for (const Lit lit : newly_true) {
    trail_.push(lit);
    const auto meaning = model_.variable(lit);
    if (meaning.kind != Model::VariableKind::cost) continue;
    if (lit.positive())
      trail_.raise_floor(meaning.agent, meaning.cost);
    else
      trail_.lower_cap(meaning.agent, meaning.cost - 1);
  }
}

void ContinuousTheory::on_retract(std::size_t kept) { trail_.retract(kept); }

// ---- paths --------------------------------------------------------------------------------------

bool ContinuousTheory::obeys(AgentId i, const KnownPathRef& known) const {
  if (known->breaks && trail_.is_active(*known->breaks)) return false;
  const auto broken = trail_.find_broken(i, known);
  if (broken) known->breaks = broken;
  return !broken;
}

KnownPathRef ContinuousTheory::remember(AgentId i, const TimedPath& path) {
  return caches_[i].remember(model_.instance(), i, path, last_version_);
}

Cost ContinuousTheory::current_cost(AgentId i) const {
  return std::max(paths_.cost(paths_.path(i)), trail_.floor(i));
}

KnownPathRef ContinuousTheory::recall(AgentId i) const {
  Cost cap = trail_.cap(i);
  for (const auto& threshold : model_.thresholds(i)) {
    if (threshold.cost > cap) break;
    if (threshold.is_natural && trail_.value(threshold.at_least) == Truth::unassigned)
      cap = threshold.cost - 1;
  }
  return caches_[i].cheapest(cap, [&](const KnownPathRef& known) { return obeys(i, known); });
}

PathSearch::Cheapest ContinuousTheory::search(AgentId i, Cost bound) {
  return search_.find(i, trail_.active(i), bound);
}

bool ContinuousTheory::replan_all(FormulaWriter& writer) {
  bool good = true;
  trail_.mend_violated([&](AgentId i) {
    good &= replan(i, writer);
    return true;
  });
  return good;
}

bool ContinuousTheory::replan(AgentId i, FormulaWriter& writer) {
  const Cost cap = trail_.cap(i);
  // What was in its way may be gone.
  if (paths_.cost(paths_.path(i)) <= cap && obeys(i, paths_.path(i))) {
    trail_.keep_path(i);
    return true;
  }
  if (const KnownPathRef known = recall(i)) {
    trail_.replace_path(i, known);
    return true;
  }
  const auto found = search(i, kAnyCost);
  const Cost arrival = found.path() == nullptr ? kAnyCost : as_cost(found.path()->arrival);
  if (found.path() == nullptr || arrival > cap) {
    Cost bound = arrival;
    for (const auto& threshold : model_.thresholds(i))
      if (threshold.is_natural && threshold.cost > cap && threshold.cost < bound) {
        bound = threshold.cost;
        break;
      }
    explain_bound(i, found, bound, writer);
    return false;
  }
  trail_.replace_path(i, remember(i, *found.path()));
  Cost refuted = 0;  // the largest open natural threshold that this search refutes
  for (const auto& threshold : model_.thresholds(i)) {
    if (threshold.cost > arrival) break;
    if (threshold.is_natural && trail_.value(threshold.at_least) == Truth::unassigned)
      refuted = threshold.cost;
  }
  if (refuted > 0) explain_bound(i, found, refuted, writer);
  return true;
}

void ContinuousTheory::explain_bound(AgentId i, const PathSearch::Cheapest& search, Cost bound,
                                     FormulaWriter& writer) {
  const ObstacleIds blamed = search.blame(bound);
  std::vector<Lit> clause;
  std::vector<sat::Usage> usages;
  if (bound < kAnyCost) clause.push_back(model_.at_least(i, bound, writer));
  for (const ObstacleId id : blamed) {
    usages.push_back({i, id.value()});
    const Lit allowed = model_.obstacles()[id].allowed;
    if (std::find(clause.begin(), clause.end(), allowed) == clause.end()) clause.push_back(allowed);
  }
  writer.add({sat::LemmaKind::path, clause, usages, false});
  blame_pairs(i, bound, blamed, writer);
}

void ContinuousTheory::blame_pairs(AgentId i, Cost bound, const ObstacleIds& blamed,
                                   FormulaWriter& writer) {
  if (bound >= kAnyCost) return;
  pair_lemmas_.set_path_effort(search_.effort());
  std::map<AgentId, int> due_to;
  for (const ObstacleId id : blamed)
    for (const AgentId j : model_.obstacles()[id].partners) ++due_to[j];
  for (const auto& [j, count] : due_to) {
    if (count < 2) continue;
    if (pair_lemmas_.note_explanation({i, std::min(bound - 1, trail_.cap(i)), blamed},
                                      {j, trail_.cap(j), trail_.active(j)}, writer))
      return;
  }
}

// ---- checks -------------------------------------------------------------------------------------

void ContinuousTheory::check(sat::Effort effort, sat::TheoryContext& context) {
  using Mode = Question::Mode;
  if (question_.mode == Mode::never ||
      (question_.mode == Mode::complete && effort == sat::Effort::partial))
    return;
  ContextWriter target(context);
  CountingWriter writer(target);
  trail_.notice(model_.obstacles());
  if (effort == sat::Effort::partial)
    static_cast<void>(replan_all(writer));
  else
    check_paths(writer);
}

bool ContinuousTheory::check_complete(std::span<const Lit> assignment, FormulaWriter& target) {
  on_retract(0);
  on_assign(assignment);
  CountingWriter writer(target);
  check_paths(writer);
  return !writer.has_written();
}

std::vector<Encounter> ContinuousTheory::encounters() {
  std::vector<Encounter> found;
  for (const AgentId i : model_.instance().agent_ids()) {
    for (AgentId j(i.index() + 1); j.index() < caches_.size(); j = AgentId(j.index() + 1)) {
      auto& apart = apart_[i.index() * caches_.size() + j.index()];
      const std::pair versions{paths_.path(i)->version, paths_.path(j)->version};
      if (apart == versions) continue;
      ++num_comparisons_;
      if (auto encounter =
              first_encounter(model_.scene(), i, paths_.path(i)->steps, j, paths_.path(j)->steps))
        found.push_back(*encounter);
      else
        apart = versions;
    }
  }
  return found;
}

// Obstacles whose literal is false already take effect without a clause: then paths change, and
// this has to look again, because an unchanged formula would count as consent.
void ContinuousTheory::check_paths(CountingWriter& writer) {
  while (true) {
    if (!replan_all(writer) || writer.has_written()) return;
    ++num_checks_;
    const std::vector<Encounter> found = encounters();
    if (found.empty()) {
      accepted_.emplace();
      for (const AgentId i : model_.instance().agent_ids())
        accepted_->paths.push_back(with_stops(model_.instance(), i, path(i)));
      return;
    }
    for (const Encounter& e : found) {
      if (!note_collision(e, writer))
        clauses_.exclude(e, as_ticks(current_cost(e.first)), as_ticks(current_cost(e.second)),
                         writer);
    }
    trail_.notice(model_.obstacles());
    if (writer.has_written()) return;
  }
}

bool ContinuousTheory::note_collision(const Encounter& e, FormulaWriter& writer) {
  pair_lemmas_.set_path_effort(search_.effort());
  const auto party = [&](AgentId i) {
    return PairLemmas::Party{i, trail_.cap(i), trail_.active(i)};
  };
  return pair_lemmas_.note_collision(party(e.first), party(e.second), writer);
}

sat::Lemma ContinuousTheory::explain(Lit, std::vector<Lit>&) {
  QUADRILLE_REQUIRE(false, "this theory propagates by clauses only");
  return {};
}

}  // namespace quadrille::continuous
