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

LazyTheory::LazyTheory(LazyModel& model, LimitMonitor& limits)
    : model_(model),
      limits_(limits),
      paths_(model.instance()),
      clauses_(model, paths_),
      obstacle_map_(model.instance().graph().num_vertices()),
      finder_(model.instance().graph().num_vertices()),
      explainer_(model.instance().graph().num_vertices()),
      explicit_paths_(model),
      cache_(model.instance().num_agents(), kRememberedPaths),
      agents_(model.instance().num_agents()) {
  for (const AgentId i : model.instance().agents()) {
    const AgentDistances& distances = model_.distances(i);
    obstacle_map_.load(model_.obstacles(), {}, distances.goal());
    const bool found =
        finder_.find_cheapest({i, distances, obstacle_map_, distances.free_cost(), &paths_}, path_);
    QUADRILLE_REQUIRE(found, "nothing hinders an agent that is alone");
    paths_.replace(i, path_);
    agents_[i].cap = distances.free_cost();
  }
  constexpr int kRounds = 3;
  for (int round = 0; round < kRounds && !limits.exhausted_now() && bypass(); ++round) {
  }
  for (Agent& agent : agents_) agent.cap = kForever;
}

// ---- the assignment -----------------------------------------------------------------------------

Truth LazyTheory::value(Lit lit) const {
  const auto index = static_cast<std::size_t>(lit.variable());
  const Truth positive = index < values_.size() ? values_[index] : Truth::unassigned;
  if (positive == Truth::unassigned || lit.positive()) return positive;
  return positive == Truth::is_true ? Truth::is_false : Truth::is_true;
}

void LazyTheory::on_assign(std::span<const Lit> newly_true) {
  notice_new_obstacles();
  for (const Lit lit : newly_true) {
    const auto index = static_cast<std::size_t>(lit.variable());
    if (values_.size() <= index) values_.resize(index + 1, Truth::unassigned);
    values_[index] = lit.positive() ? Truth::is_true : Truth::is_false;
    stack_.push_back(lit);
    changes_before_.push_back(changes_.size());
    // Usages are allowed and costs are high while their variables are false.
    if (!lit.positive()) continue;
    const auto meaning = model_.variable(lit);
    if (meaning.kind == LazyModel::VariableKind::auxiliary ||
        meaning.kind == LazyModel::VariableKind::vertex)
      continue;
    if (index < watchers_.size())
      for (const ObstacleId id : watchers_[index]) activate(id);
    if (meaning.kind == LazyModel::VariableKind::cost) lower_cap(meaning.agent, meaning.cost);
  }
}

void LazyTheory::on_retract(std::size_t kept) {
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

void LazyTheory::undo(const Change& change) {
  Agent& agent = agents_[change.agent];
  switch (change.kind) {
    case Change::Kind::activation:
      agent.active.pop_back();
      break;
    case Change::Kind::cap:
      agent.cap = change.cap;
      break;
    case Change::Kind::path:
      paths_.replace(change.agent, replaced_paths_.back());
      replaced_paths_.pop_back();
      // It was violated when it was replaced, and may still be.
      mark_violated(change.agent);
      break;
  }
}

void LazyTheory::notice_new_obstacles() {
  const ObstacleTable& table = model_.obstacles();
  for (; num_noticed_ < table.size(); ++num_noticed_) {
    const ObstacleId id(num_noticed_);
    const Lit allowed = table[id].allowed;
    const auto index = static_cast<std::size_t>(allowed.variable());
    if (watchers_.size() <= index) watchers_.resize(index + 1);
    watchers_[index].push_back(id);
    if (value(allowed) == Truth::is_false) activate(id);
  }
}

void LazyTheory::activate(ObstacleId id) {
  const AgentId i = model_.obstacles()[id].agent;
  Agent& agent = agents_[i];
  agent.active.push_back(id);
  changes_.push_back({Change::Kind::activation, i, id, 0});
  if (!agent.is_violated && model_.obstacles().hits(id, paths_.path(i))) mark_violated(i);
}

void LazyTheory::lower_cap(AgentId i, Timestep cap) {
  Agent& agent = agents_[i];
  if (cap >= agent.cap) return;
  changes_.push_back({Change::Kind::cap, i, ObstacleId(), agent.cap});
  agent.cap = cap;
  if (paths_.cost(i) > cap) mark_violated(i);
}

// ---- paths --------------------------------------------------------------------------------------

bool LazyTheory::is_hit(AgentId i, const Path& path) const {
  const std::vector<ObstacleId>& active = agents_[i].active;
  return std::any_of(active.begin(), active.end(),
                     [&](ObstacleId id) { return model_.obstacles().hits(id, path); });
}

void LazyTheory::set_path(AgentId i, const Path& path) {
  // A dearer path is taken back with what made it necessary; any other one is as good as before.
  if (path.size() > paths_.path(i).size()) {
    changes_.push_back({Change::Kind::path, i, ObstacleId(), 0});
    replaced_paths_.push_back(paths_.path(i));
  }
  paths_.replace(i, path);
}

void LazyTheory::mark_violated(AgentId i) {
  if (agents_[i].is_violated) return;
  agents_[i].is_violated = true;
  violated_.push_back(i);
}

bool LazyTheory::replan_all(ContextWriter& writer) {
  std::sort(violated_.begin(), violated_.end());
  bool all_done = true;
  for (const AgentId i : violated_) {
    if (!is_present(i)) continue;
    all_done = !limits_.exhausted();
    if (!all_done) writer.stop();
    all_done = all_done && replan(i, writer);
    if (!all_done) break;
  }
  std::erase_if(violated_, [&](AgentId i) { return !agents_[i].is_violated; });
  return all_done;
}

bool LazyTheory::replan(AgentId i, FormulaWriter& writer) {
  Agent& agent = agents_[i];
  // What hit it may be gone.
  if (paths_.cost(i) <= agent.cap && !is_hit(i, paths_.path(i))) {
    agent.is_violated = false;
    return true;
  }
  if (const Path* remembered = find_remembered(i)) {
    agent.is_violated = false;
    set_path(i, *remembered);
    return true;
  }
  const AgentDistances& distances = model_.distances(i);
  obstacle_map_.load(model_.obstacles(), agent.active, distances.goal());
  if (!finder_.find_cheapest({i, distances, obstacle_map_, agent.cap, &paths_}, path_)) {
    explain_bound(i, agent.cap, writer);
    return false;
  }
  agent.is_violated = false;
  const auto cost = static_cast<Timestep>(path_.size()) - 1;
  const auto& literals = model_.cost_literals(i);
  Timestep refuted = -1;  // the largest open bound that this search refutes
  for (const auto& literal : literals) {
    if (literal.cost >= cost) break;
    if (value(literal.above) == Truth::unassigned) refuted = literal.cost;
  }
  if (refuted >= 0) explain_bound(i, refuted, writer);
  set_path(i, path_);
  cache_.add(i, path_);
  return true;
}

const Path* LazyTheory::find_remembered(AgentId i) const {
  const Agent& agent = agents_[i];
  Timestep max_cost = agent.cap;  // a dearer path needs the search's proof that it must be
  for (const auto& literal : model_.cost_literals(i)) {
    if (literal.cost >= max_cost) break;
    if (value(literal.above) == Truth::unassigned) max_cost = literal.cost;
  }
  const Path* best = nullptr;
  int fewest = 0;
  for (const Path& path : cache_.paths(i)) {
    if (static_cast<Timestep>(path.size()) - 1 > max_cost || is_hit(i, path)) continue;
    const int collisions = paths_.num_collisions(i, path);
    if (best != nullptr && collisions >= fewest) continue;
    best = &path;
    fewest = collisions;
  }
  return best;
}

void LazyTheory::explain_bound(AgentId i, Timestep cost, FormulaWriter& writer) {
  const Agent& agent = agents_[i];
  slots_.clear();
  explainer_.explain(model_.distances(i), obstacle_map_, finder_.first_hits(), cost, slots_);
  std::vector<Lit> clause{model_.cost_above(i, cost, writer)};
  std::vector<sat::Usage> usages;
  for (const std::size_t slot : slots_) {
    const ObstacleId id = agent.active[slot];
    const Lit allowed = model_.obstacles()[id].allowed;
    usages.push_back({i, id.value()});
    if (std::find(clause.begin(), clause.end(), allowed) == clause.end()) clause.push_back(allowed);
  }
  writer.add({sat::LemmaKind::path, clause, usages, false});
  bump(clause);
  explicit_paths_.on_path_lemma(i, agent.cap, writer);
}

// ---- checks -------------------------------------------------------------------------------------

void LazyTheory::check(sat::Effort effort, sat::TheoryContext& context) {
  ContextWriter writer(context);
  notice_new_obstacles();
  if (effort == sat::Effort::partial)
    static_cast<void>(replan_all(writer));
  else
    check_paths(writer);
}

void LazyTheory::list_present_collisions() {
  collisions_.clear();
  for (const Encounter& e : paths_.collisions())
    if (is_present(e.first) && is_present(e.second)) collisions_.push_back(e);
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
    list_present_collisions();
    if (!has_bypassed) {
      has_bypassed = true;
      while (!limits_.exhausted_now() && bypass()) {
      }
      list_present_collisions();
    }
    if (collisions_.empty()) {
      accept();
      return;
    }
    std::stable_sort(
        collisions_.begin(), collisions_.end(),
        [](const Encounter& a, const Encounter& b) { return a.timestep < b.timestep; });
    for (const Encounter& e : collisions_) clauses_.exclude(e, agents_[e.first].cap, writer);
    notice_new_obstacles();
    explicit_paths_.link_new_obstacles(writer);
    if (writer.has_excluded()) return;
  }
}

void LazyTheory::accept() {
  accepted_.reset();
  for (const AgentId i : model_.instance().agents())
    if (!is_present(i)) return;
  accepted_.emplace();
  for (const AgentId i : model_.instance().agents()) accepted_->paths.push_back(paths_.path(i));
}

Lit LazyTheory::decide(sat::TheoryContext& context) {
  if (!is_part_) return {};
  for (const AgentId i : violated_)  // after a lemma that the solver has not seen yet
    if (is_present(i)) return {};
  list_present_collisions();
  while (!collisions_.empty() &&
         (bypass(collisions_.front().first) || bypass(collisions_.front().second)))
    list_present_collisions();
  if (collisions_.empty()) {
    context.stop();
    return {};
  }
  ContextWriter writer(context);
  for (const Encounter& e : std::vector<Encounter>(collisions_)) {
    const auto usages = clauses_.exclude(e, agents_[e.first].cap, writer);
    notice_new_obstacles();
    explicit_paths_.link_new_obstacles(writer);
    Lit choice;
    for (const ObstacleId id : usages) {
      const Lit allowed = model_.obstacles()[id].allowed;
      if (value(allowed) == Truth::unassigned &&
          (!choice.valid() || activity(allowed) > activity(choice)))
        choice = allowed;
    }
    if (choice.valid()) return ~choice;
  }
  return {};
}

void LazyTheory::bump(std::span<const Lit> clause) {
  constexpr double kGrowth = 1.05, kLimit = 1e100;
  for (const Lit lit : clause) {
    const auto index = static_cast<std::size_t>(lit.variable());
    if (activity_.size() <= index) activity_.resize(index + 1, 0.0);
    activity_[index] += bump_;
  }
  bump_ *= kGrowth;
  if (bump_ < kLimit) return;
  for (double& value : activity_) value /= kLimit;
  bump_ /= kLimit;
}

bool LazyTheory::bypass() {
  list_present_collisions();
  std::vector<AgentId> colliding;
  for (const Encounter& e : collisions_) {
    colliding.push_back(e.first);
    colliding.push_back(e.second);
  }
  std::sort(colliding.begin(), colliding.end());
  colliding.erase(std::unique(colliding.begin(), colliding.end()), colliding.end());
  bool any = false;
  for (const AgentId i : colliding) any = (!limits_.exhausted() && bypass(i)) || any;
  return any;
}

bool LazyTheory::bypass(AgentId i) {
  const int now = paths_.num_collisions(i);
  if (now == 0) return false;
  const AgentDistances& distances = model_.distances(i);
  obstacle_map_.load(model_.obstacles(), agents_[i].active, distances.goal());
  // On open maps a vain search would look at everything within the cap.
  constexpr std::int64_t kStatesPerStep = 10;
  const auto max_effort = kStatesPerStep * static_cast<std::int64_t>(paths_.path(i).size());
  if (!finder_.find_quietest({i, distances, obstacle_map_, agents_[i].cap, &paths_, max_effort},
                             now, path_))
    return false;
  set_path(i, path_);
  return true;
}

sat::Lemma LazyTheory::explain(Lit, std::vector<Lit>&) {
  QUADRILLE_REQUIRE(false, "this theory propagates by clauses only");
  return {};
}

}  // namespace quadrille::discrete
