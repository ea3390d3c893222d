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
      finder_(model.instance()),
      bans_(model.instance().roadmap()),
      explainer_(finder_),
      clauses_(model, finder_, bans_),
      pair_lemmas_(model),
      agents_(model.instance().num_agents()),
      apart_(agents_.size() * agents_.size()) {
  for (const AgentId i : model.instance().agent_ids()) {
    TimedPath path;
    const auto arrival = finder_.find(model_.task(i), bans_, kForever, &path);
    QUADRILLE_REQUIRE(arrival.has_value(), "goals can be reached");
    set_path(i, std::move(path));
  }
}

// ---- the assignment -----------------------------------------------------------------------------

Truth ContinuousTheory::value(Lit lit) const {
  const auto index = static_cast<std::size_t>(lit.variable());
  const Truth positive = index < values_.size() ? values_[index] : Truth::unassigned;
  if (positive == Truth::unassigned || lit.positive()) return positive;
  return positive == Truth::is_true ? Truth::is_false : Truth::is_true;
}

void ContinuousTheory::on_assign(std::span<const Lit> newly_true) {
  notice_new_obstacles();
  for (const Lit lit : newly_true) {
    const auto index = static_cast<std::size_t>(lit.variable());
    if (values_.size() <= index) values_.resize(index + 1, Truth::unassigned);
    values_[index] = lit.positive() ? Truth::is_true : Truth::is_false;
    stack_.push_back(lit);
    changes_before_.push_back(changes_.size());
    const auto meaning = model_.variable(lit);
    if (meaning.kind == Model::VariableKind::auxiliary) continue;
    if (meaning.kind == Model::VariableKind::cost) {
      if (lit.positive())
        set_floor(meaning.agent, meaning.cost);
      else
        set_cap(meaning.agent, meaning.cost - 1);
    }
    if (index < watchers_.size())
      for (const ObstacleId id : watchers_[index])
        if (model_.obstacles()[id].allowed == ~lit) activate(id);
  }
}

void ContinuousTheory::on_retract(std::size_t kept) {
  if (kept >= stack_.size()) return;
  for (std::size_t at = kept; at < stack_.size(); ++at)
    values_[static_cast<std::size_t>(stack_[at].variable())] = Truth::unassigned;
  const std::size_t num_kept = changes_before_[kept];
  stack_.resize(kept);
  changes_before_.resize(kept);
  std::vector<ObstacleId> popped;
  while (changes_.size() > num_kept) {
    const Change change = changes_.back();
    changes_.pop_back();
    undo(change);
    if (change.kind == Change::Kind::activation) popped.push_back(change.obstacle);
  }
  // An obstacle that was made after its literal had become false is still active.
  for (auto it = popped.rbegin(); it != popped.rend(); ++it)
    if (value(model_.obstacles()[*it].allowed) == Truth::is_false) activate(*it);
}

void ContinuousTheory::undo(const Change& change) {
  AgentState& agent = agents_[change.agent];
  switch (change.kind) {
    case Change::Kind::activation:
      agent.active.pop_back();
      break;
    case Change::Kind::cap:
      agent.cap = change.cost;
      break;
    case Change::Kind::floor:
      agent.floor = change.cost;
      break;
    case Change::Kind::path:
      agent.path = std::move(replaced_paths_.back());
      replaced_paths_.pop_back();
      // It was violated when it was replaced, and may still be.
      agent.is_violated = true;
      break;
  }
}

void ContinuousTheory::notice_new_obstacles() {
  const auto& obstacles = model_.obstacles();
  for (; num_noticed_ < obstacles.size(); ++num_noticed_) {
    const ObstacleId id(num_noticed_);
    const Lit allowed = obstacles[id].allowed;
    const auto index = static_cast<std::size_t>(allowed.variable());
    if (watchers_.size() <= index) watchers_.resize(index + 1);
    watchers_[index].push_back(id);
    if (value(allowed) == Truth::is_false) activate(id);
  }
}

void ContinuousTheory::activate(ObstacleId id) {
  const Obstacle& obstacle = model_.obstacles()[id];
  AgentState& agent = agents_[obstacle.agent];
  agent.active.push_back(id);
  changes_.push_back({Change::Kind::activation, obstacle.agent, id, 0});
  if (!agent.is_violated && agent.path->uses.breaks(obstacle.bans)) agent.is_violated = true;
}

void ContinuousTheory::set_cap(AgentId i, Cost cap) {
  AgentState& agent = agents_[i];
  if (cap >= agent.cap) return;
  changes_.push_back({Change::Kind::cap, i, ObstacleId(), agent.cap});
  agent.cap = cap;
  if (agent.path->path.arrival > cap) agent.is_violated = true;
}

void ContinuousTheory::set_floor(AgentId i, Cost floor) {
  AgentState& agent = agents_[i];
  if (floor <= agent.floor) return;
  changes_.push_back({Change::Kind::floor, i, ObstacleId(), agent.floor});
  agent.floor = floor;
}

// ---- paths --------------------------------------------------------------------------------------

bool ContinuousTheory::obeys(const AgentState& agent, const KnownPath& known) const {
  const auto& obstacles = model_.obstacles();
  if (known.breaks && value(obstacles[*known.breaks].allowed) == Truth::is_false) return false;
  for (const ObstacleId id : agent.active)
    if (known.uses.breaks(obstacles[id].bans)) {
      known.breaks = id;
      return false;
    }
  return true;
}

void ContinuousTheory::set_path(AgentId i, TimedPath path) {
  AgentState& agent = agents_[i];
  agent.path = agent.cache.remember(model_.instance(), i, std::move(path), last_version_);
}

// A dearer path is taken back with what made it necessary; any other one is as good as before.
void ContinuousTheory::replace_path(AgentId i, KnownPathRef path) {
  AgentState& agent = agents_[i];
  agent.is_violated = false;
  if (path->path.arrival > agent.path->path.arrival) {
    changes_.push_back({Change::Kind::path, i, ObstacleId(), 0});
    replaced_paths_.push_back(agent.path);
  }
  agent.path = std::move(path);
}

KnownPathRef ContinuousTheory::recall(AgentId i) const {
  const AgentState& agent = agents_[i];
  Cost cap = agent.cap;
  for (const auto& threshold : model_.thresholds(i)) {
    if (threshold.cost > cap) break;
    if (threshold.is_natural && value(threshold.at_least) == Truth::unassigned)
      cap = threshold.cost - 1;
  }
  return agent.cache.cheapest(cap, [&](const KnownPath& known) { return obeys(agent, known); });
}

void ContinuousTheory::load_bans(AgentId i) {
  bans_.clear();
  for (const ObstacleId id : agents_[i].active) bans_.add(model_.obstacles()[id].bans);
}

bool ContinuousTheory::replan_all(FormulaWriter& writer) {
  bool good = true;
  for (const AgentId i : model_.instance().agent_ids())
    if (agents_[i].is_violated) good &= replan(i, writer);
  return good;
}

bool ContinuousTheory::replan(AgentId i, FormulaWriter& writer) {
  AgentState& agent = agents_[i];
  if (agent.path->path.arrival <= agent.cap &&
      obeys(agent, *agent.path)) {  // what was in its way is gone
    agent.is_violated = false;
    return true;
  }
  if (KnownPathRef known = recall(i)) {
    replace_path(i, std::move(known));
    return true;
  }
  load_bans(i);
  TimedPath path;
  const auto arrival = finder_.find(model_.task(i), bans_, kForever, &path);
  if (!arrival || *arrival > agent.cap) {
    Cost bound = arrival.value_or(kForever);
    for (const auto& threshold : model_.thresholds(i))
      if (threshold.is_natural && threshold.cost > agent.cap && threshold.cost < bound) {
        bound = threshold.cost;
        break;
      }
    explain_bound(i, bound, writer);
    return false;
  }
  replace_path(i, agent.cache.remember(model_.instance(), i, std::move(path), last_version_));
  Cost refuted = 0;  // the largest open natural threshold that this search refutes
  for (const auto& threshold : model_.thresholds(i)) {
    if (threshold.cost > *arrival) break;
    if (threshold.is_natural && value(threshold.at_least) == Truth::unassigned)
      refuted = threshold.cost;
  }
  if (refuted > 0) explain_bound(i, refuted, writer);
  return true;
}

void ContinuousTheory::explain_bound(AgentId i, Cost bound, FormulaWriter& writer) {
  const AgentState& agent = agents_[i];
  const std::vector<double> priority(agent.active.size(), 0);
  std::vector<std::size_t> slots;
  explainer_.explain(model_.task(i), bans_, bound, priority, slots);
  std::vector<Lit> clause;
  std::vector<sat::Usage> usages;
  if (bound < kForever) clause.push_back(model_.at_least(i, bound, writer));
  for (const std::size_t slot : slots) {
    const ObstacleId id = agent.active[slot];
    usages.push_back({i, id.value()});
    const Lit allowed = model_.obstacles()[id].allowed;
    if (std::find(clause.begin(), clause.end(), allowed) == clause.end()) clause.push_back(allowed);
  }
  writer.add({sat::LemmaKind::path, clause, usages, false});
  blame_pairs(i, bound, slots, writer);
}

void ContinuousTheory::blame_pairs(AgentId i, Cost bound, const std::vector<std::size_t>& slots,
                                   FormulaWriter& writer) {
  if (bound >= kForever || !uses_pair_lemmas_) return;
  std::vector<ObstacleId> obstacles;
  std::map<AgentId, int> due_to;
  for (const std::size_t slot : slots) {
    obstacles.push_back(agents_[i].active[slot]);
    for (const AgentId j : model_.obstacles()[obstacles.back()].partners) ++due_to[j];
  }
  for (const auto& [j, count] : due_to)
    if (count >= 2 &&
        pair_lemmas_.note_explanation({i, std::min(bound - 1, agents_[i].cap), obstacles},
                                      {j, agents_[j].cap, agents_[j].active}, writer))
      return;
}

// The costs of some agents alone are too much: so they are in every plan that costs them as much.
bool ContinuousTheory::check_budget(FormulaWriter& writer) {
  if (budget_ >= kForever) return true;
  const auto delay = [&](AgentId i) {
    return std::max(agents_[i].path->path.arrival, agents_[i].floor) - model_.free_cost(i);
  };
  Cost slack = -budget_ - 1;
  std::vector<AgentId> delayed;
  for (const AgentId i : model_.instance().agent_ids()) {
    slack += model_.free_cost(i) + delay(i);
    if (delay(i) > 0) delayed.push_back(i);
  }
  if (slack < 0) return true;
  // Small delays need no mention where the others' are enough.
  std::stable_sort(delayed.begin(), delayed.end(),
                   [&](AgentId a, AgentId b) { return delay(a) < delay(b); });
  std::vector<Lit> clause{above_budget_};
  for (const AgentId i : delayed) {
    if (delay(i) <= slack) {
      slack -= delay(i);
      continue;
    }
    const Lit claim = claim_cost(i, writer);
    if (!claim.valid()) return check_budget(writer);  // the sum was wrong
    clause.push_back(~claim);
  }
  writer.add({sat::LemmaKind::counting, clause, {}, false});
  return false;
}

Lit ContinuousTheory::claim_cost(AgentId i, FormulaWriter& writer) {
  const AgentState& agent = agents_[i];
  const Cost cost = std::max(agent.path->path.arrival, agent.floor);
  const Lit claim = model_.at_least(i, cost, writer);
  // No path is cheaper as long as paths are changed only when they have to be; but what is not so
  // must not be claimed.
  if (value(claim) == Truth::is_true) return claim;
  load_bans(i);
  TimedPath cheaper;
  if (finder_.find(model_.task(i), bans_, cost, &cheaper)) {
    set_path(i, std::move(cheaper));
    return {};
  }
  explain_bound(i, cost, writer);
  return claim;
}

// ---- checks -------------------------------------------------------------------------------------

void ContinuousTheory::check(sat::Effort effort, sat::TheoryContext& context) {
  if (mode_ == Mode::never || (mode_ == Mode::complete && effort == sat::Effort::partial)) return;
  ContextWriter target(context);
  CountingWriter writer(target);
  notice_new_obstacles();
  if (effort == sat::Effort::partial)
    static_cast<void>(replan_all(writer) && check_budget(writer));
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
    for (AgentId j(i.index() + 1); j.index() < agents_.size(); j = AgentId(j.index() + 1)) {
      auto& apart = apart_[i.index() * agents_.size() + j.index()];
      const std::pair versions{agents_[i].path->version, agents_[j].path->version};
      if (apart == versions) continue;
      if (auto encounter =
              first_encounter(model_.scene(), i, agents_[i].path->steps, j, agents_[j].path->steps))
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
    if (!replan_all(writer) || writer.has_written() || !check_budget(writer)) return;
    ++num_checks_;
    const std::vector<Encounter> found = encounters();
    if (found.empty()) {
      accepted_.emplace();
      for (const AgentId i : model_.instance().agent_ids())
        accepted_->paths.push_back(with_stops(model_.instance(), i, agents_[i].path->path));
      return;
    }
    for (const Encounter& e : found) {
      const auto party = [&](AgentId i) {
        return PairLemmas::Party{i, agents_[i].cap, agents_[i].active};
      };
      if (uses_pair_lemmas_ && pair_lemmas_.note_collision(party(e.first), party(e.second), writer))
        continue;
      const auto final_from = [&](AgentId i) {
        return std::max(agents_[i].path->path.arrival, agents_[i].floor);
      };
      clauses_.exclude(e, final_from(e.first), final_from(e.second), writer);
    }
    notice_new_obstacles();
    if (writer.has_written()) return;
  }
}

sat::Lemma ContinuousTheory::explain(Lit, std::vector<Lit>&) {
  QUADRILLE_REQUIRE(false, "this theory propagates by clauses only");
  return {};
}

}  // namespace quadrille::continuous
