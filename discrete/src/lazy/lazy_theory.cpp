// SPDX-License-Identifier: MIT
#include "lazy/lazy_theory.hpp"

#include <algorithm>

#include "quadrille/core/contract.hpp"

namespace quadrille::discrete {

using sat::Lit;
using sat::Truth;

namespace {
/// Of each agent. Measured: nine in ten violated paths are replaced by a remembered one; without
/// any the ladders' last rungs take 1.7 times as long (geometric mean). 8 to 32 make no difference
/// on most instances, fewer cost time on hard ones.
constexpr std::size_t kRememberedPaths = 16;
}  // namespace

/// Writes to the solver by way of the theory's context and tells whether the assignment cannot stay
/// as it is: because of a clause that is false or of a literal that has no value yet.
class LazyTheory::ContextWriter final : public FormulaWriter {
 public:
  explicit ContextWriter(sat::TheoryContext& context) : context_(context) {}
  [[nodiscard]] Lit new_lit() override {
    has_excluded_ = true;
    return context_.new_lit();
  }
  void add(const sat::Lemma& lemma) override {
    has_excluded_ =
        has_excluded_ || std::all_of(lemma.clause.begin(), lemma.clause.end(),
                                     [&](Lit l) { return context_.value(l) == Truth::is_false; });
    context_.add_lemma(lemma);
  }
  void stop() { context_.stop(); }
  [[nodiscard]] bool has_excluded() const noexcept { return has_excluded_; }

 private:
  sat::TheoryContext& context_;
  bool has_excluded_ = false;
};

LazyTheory::LazyTheory(LazyModel& model, LimitMonitor& limits, ExplicitPaths::Price price)
    : model_(model),
      limits_(limits),
      paths_(model.instance()),
      trailed_paths_(paths_, model.obstacles()),
      trail_(trailed_paths_, model.instance().num_agents(), kForever),
      search_(model, paths_, limits),
      separation_(paths_, trail_, search_, limits),
      clauses_(model, paths_),
      explicit_paths_(model, price),
      cache_(model.instance().num_agents(), kRememberedPaths) {
  set_free_paths();
}

void LazyTheory::set_free_paths() {
  const std::size_t num_agents = model_.instance().num_agents();
  for (const AgentId i : model_.instance().agent_ids()) {
    const Path* path = search_.find_cheapest(i, {}, model_.distances(i).free_cost()).path();
    QUADRILLE_REQUIRE(path != nullptr, "nothing hinders an agent that is alone");
    paths_.replace(i, *path);
  }
  LazyTrail free_costs(trailed_paths_, num_agents, kForever);
  for (const AgentId i : model_.instance().agent_ids())
    free_costs.lower_cap(i, model_.distances(i).free_cost());
  Separation separation(paths_, free_costs, search_, limits_);
  constexpr int kRounds = 3;
  for (int round = 0; round < kRounds && !limits_.exhausted_now() && separation.bypass_all();
       ++round) {
  }
}

// ---- the assignment -----------------------------------------------------------------------------

void LazyTheory::on_assign(std::span<const Lit> newly_true) {
  trail_.notice(model_.obstacles());
  for (const Lit lit : newly_true) {
    trail_.push(lit);
    if (!lit.positive()) continue;  // costs are high while their variables are false
    const auto meaning = model_.variable(lit);
    if (meaning.kind == LazyModel::VariableKind::cost)
      trail_.lower_cap(meaning.agent, meaning.cost);
  }
}

void LazyTheory::on_retract(std::size_t kept) { trail_.retract(kept); }

void LazyTheory::on_pause() {
  draft_ = {};
  for (const AgentId i : model_.instance().agent_ids()) draft_.paths.push_back(paths_.path(i));
}

const Plan& LazyTheory::draft() {
  if (draft_.paths.empty()) on_pause();
  return draft_;
}

// ---- paths --------------------------------------------------------------------------------------

bool LazyTheory::replan_all(ContextWriter& writer) {
  return trail_.mend_violated([&](AgentId i) {
    if (!is_present(i)) return true;
    if (limits_.exhausted()) {
      writer.stop();
      return false;
    }
    return replan(i, writer);
  });
}

bool LazyTheory::replan(AgentId i, FormulaWriter& writer) {
  const Timestep cap = trail_.cap(i);
  // What hit it may be gone.
  if (paths_.cost(i) <= cap && !trail_.find_broken(i, paths_.path(i))) {
    trail_.keep_path(i);
    return true;
  }
  if (const Path* remembered = find_remembered(i)) {
    trail_.replace_path(i, *remembered);
    return true;
  }
  const auto search = search_.find_cheapest(i, trail_.active(i), cap);
  if (search.path() == nullptr) {
    explain_bound(i, search, cap, writer);
    return false;
  }
  const Timestep cost = trailed_paths_.cost(*search.path());
  Timestep refuted = -1;  // the largest open bound that this search refutes
  for (const auto& literal : model_.cost_literals(i)) {
    if (literal.cost >= cost) break;
    if (trail_.value(literal.above) == Truth::unassigned) refuted = literal.cost;
  }
  if (refuted >= 0) explain_bound(i, search, refuted, writer);
  trail_.replace_path(i, *search.path());
  cache_.add(i, *search.path());
  return true;
}

const Path* LazyTheory::find_remembered(AgentId i) const {
  Timestep max_cost = trail_.cap(i);  // a costlier path needs the search's proof that it must be
  for (const auto& literal : model_.cost_literals(i)) {
    if (literal.cost >= max_cost) break;
    if (trail_.value(literal.above) == Truth::unassigned) max_cost = literal.cost;
  }
  const Path* best = nullptr;
  int fewest = 0;
  for (const Path& path : cache_.paths(i)) {
    if (trailed_paths_.cost(path) > max_cost || trail_.find_broken(i, path)) continue;
    const int collisions = paths_.num_collisions(i, path);
    if (best != nullptr && collisions >= fewest) continue;
    best = &path;
    fewest = collisions;
  }
  return best;
}

void LazyTheory::explain_bound(AgentId i, const PathSearch::Cheapest& search, Timestep cost,
                               FormulaWriter& writer) {
  const std::vector<ObstacleId> blamed = search.blame(cost);
  std::vector<Lit> clause{model_.cost_above(i, cost, writer)};
  std::vector<sat::Usage> usages;
  for (const ObstacleId id : blamed) {
    const Lit allowed = model_.obstacles()[id].allowed;
    usages.push_back({i, id.value()});
    if (std::find(clause.begin(), clause.end(), allowed) == clause.end()) clause.push_back(allowed);
  }
  writer.add({sat::LemmaKind::path, clause, usages, false});
  decisions_.on_path_lemma(clause);
  explicit_paths_.on_path_lemma(i, trail_.cap(i), writer);
}

// ---- checks -------------------------------------------------------------------------------------

void LazyTheory::check(sat::Effort effort, sat::TheoryContext& context) {
  ContextWriter writer(context);
  trail_.notice(model_.obstacles());
  if (effort == sat::Effort::partial)
    static_cast<void>(replan_all(writer));
  else
    check_paths(writer);
}

// Obstacles whose literal is false already take effect without a clause: then paths change, and
// this has to look again, because a formula that is still satisfied would count as consent.
void LazyTheory::check_paths(ContextWriter& writer) {
  bool has_bypassed = false;
  while (true) {
    if (!replan_all(writer) || writer.has_excluded()) return;
    ++num_checks_;
    if (limits_.exhausted_now()) {
      writer.stop();
      return;
    }
    while (!has_bypassed && !limits_.exhausted_now() && separation_.bypass_all()) {
    }
    has_bypassed = true;
    std::vector<Encounter> collisions = separation_.collisions();
    if (collisions.empty()) {
      accept();
      return;
    }
    std::stable_sort(
        collisions.begin(), collisions.end(),
        [](const Encounter& a, const Encounter& b) { return a.timestep < b.timestep; });
    for (const Encounter& e : collisions) {
      // One may take several searches of the whole map: for where an agent can be, and for the ways
      // around a corridor.
      if (limits_.exhausted()) {
        writer.stop();
        return;
      }
      clauses_.exclude(e, trail_.cap(e.first), writer);
    }
    trail_.notice(model_.obstacles());
    explicit_paths_.link_new_obstacles(writer);
    if (writer.has_excluded()) return;
  }
}

void LazyTheory::accept() {
  accepted_.reset();
  for (const AgentId i : model_.instance().agent_ids())
    if (!is_present(i)) return;
  accepted_.emplace();
  for (const AgentId i : model_.instance().agent_ids()) accepted_->paths.push_back(paths_.path(i));
}

Lit LazyTheory::decide(sat::TheoryContext& context) {
  if (!is_part_) return {};
  // After a lemma that the solver has not seen yet.
  if (trail_.any_violated([&](AgentId i) { return is_present(i); })) return {};
  std::vector<Encounter> collisions = separation_.collisions();
  while (!collisions.empty() && (separation_.bypass(collisions.front().first) ||
                                 separation_.bypass(collisions.front().second)))
    collisions = separation_.collisions();
  if (collisions.empty()) {
    context.stop();
    return {};
  }
  ContextWriter writer(context);
  for (const Encounter& e : collisions)
    if (const Lit usage = choose_usage(e, writer); usage.valid()) return ~usage;
  return {};
}

Lit LazyTheory::choose_usage(const Encounter& e, FormulaWriter& writer) {
  const auto usages = clauses_.exclude(e, trail_.cap(e.first), writer);
  trail_.notice(model_.obstacles());
  explicit_paths_.link_new_obstacles(writer);
  std::vector<Lit> open;
  for (const ObstacleId id : usages)
    if (const Lit allowed = model_.obstacles()[id].allowed;
        trail_.value(allowed) == Truth::unassigned)
      open.push_back(allowed);
  return decisions_.choose(open);
}

sat::Lemma LazyTheory::explain(Lit, std::vector<Lit>&) {
  QUADRILLE_REQUIRE(false, "this theory propagates by clauses only");
  return {};
}

}  // namespace quadrille::discrete
