// SPDX-License-Identifier: MIT
#include "mdd/mdd_paths.hpp"

#include <algorithm>

#include "mdd/usages.hpp"

namespace quadrille::discrete {

using sat::Lit;

Lit MddPaths::at(VertexId v, Timestep t) const {
  if (mdd_.to_goal(v) == kUnreachable) return {};
  const Timestep slack = mdd_.slack(v, t);
  if (slack < 0 || slack > cap()) return {};
  const auto& layer = layers_[static_cast<std::size_t>(slack)];
  const std::uint32_t rank = mdd_.rank(v);
  return rank < layer.size() ? layer[rank] : Lit();
}

void MddPaths::make_layer(const Graph& graph, Timestep slack, Formula& formula) {
  auto& layer = layers_.emplace_back();
  const std::size_t size = mdd_.reach(graph, slack);
  layer.reserve(size);
  for (std::size_t rank = 0; rank < size; ++rank) {
    const VertexId v = mdd_.vertex(rank);
    layer.push_back(formula.new_vertex(v, mdd_.timestep(v, slack)));
  }
}

// X(v,t) -> C(slack) unless v is a goal: who is elsewhere at t arrives no earlier than t + h(v).
void MddPaths::add_delay_clauses(Timestep slack, Formula& formula) {
  if (slack == 0 || !formula.charges_delays()) return;
  const Lit late = formula.delay_at_least(slack);
  const auto& layer = layers_[static_cast<std::size_t>(slack)];
  for (std::size_t rank = 0; rank < layer.size(); ++rank) {
    if (mdd_.is_goal(mdd_.vertex(rank))) continue;
    scratch_ = {~layer[rank], late};
    formula.add(scratch_);
  }
}

// Of agents with several goals: X(g,t) -> E(g) or C(slack + 1), since who ends elsewhere arrives
// later; and X(g,t-1) -> X(g,t) or not E(g) or C(slack + 1), since who ends there and leaves comes
// back at t + 1 or later.
void MddPaths::add_end_clauses(Timestep slack, Formula& formula) {
  if (mdd_.task().goals.is_single() || !formula.charges_delays()) return;
  const Lit late = formula.delay_at_least(slack + 1);
  for (const VertexId goal : mdd_.task().goals.vertices()) {
    const Timestep t = mdd_.timestep(goal, slack);
    const Lit here = at(goal, t), ends = formula.end_at(goal);
    if (!here.valid()) continue;
    scratch_ = {~here, ends, late};
    formula.add(scratch_);
    const Lit before = at(goal, t - 1);
    if (!before.valid()) continue;
    scratch_ = {~before, here, ~ends, late};
    formula.add(scratch_);
  }
}

// X(w,t+1) -> one of X(v,t). Final, because predecessors have no larger slack.
void MddPaths::add_predecessor_clauses(const Graph& graph, Timestep slack, Formula& formula) {
  const auto& layer = layers_[static_cast<std::size_t>(slack)];
  for (std::size_t rank = 0; rank < layer.size(); ++rank) {
    const VertexId w = mdd_.vertex(rank);
    const Timestep t = mdd_.timestep(w, slack);
    if (t == 0) continue;
    scratch_ = {~layer[rank]};
    const auto add = [&](VertexId v) {
      if (const Lit before = at(v, t - 1); before.valid()) scratch_.push_back(before);
    };
    add(w);
    for (const VertexId v : graph.predecessors(w)) add(v);
    formula.add(scratch_);
  }
}

// X(v,t) -> one of X(w,t+1) or C(cap+1), without the guard if no successor lies beyond the cap.
// For v in an old layer only if its clause had the guard of the old cap. At the goal only once it
// is complete: an agent at rest needs no successors, and a guard would forbid it to finish. Where
// ways out of the goal and back are long, from the last timestep but one on: there the agent can
// wait, and clauses about rests that are shorter would leave gaps. At one of several goals an agent
// that does not end there needs them always.
void MddPaths::add_successor_clauses(const Graph& graph, Timestep slack, Timestep old_cap,
                                     Formula& formula) {
  const Timestep new_cap = cap();
  const Timestep last_step = graph.is_directed() ? 1 : 2;
  const Lit guard = formula.delay_at_least(new_cap + 1);
  const auto& layer = layers_[static_cast<std::size_t>(slack)];
  for (std::size_t rank = 0; rank < layer.size(); ++rank) {
    const VertexId v = mdd_.vertex(rank);
    const bool is_goal = mdd_.is_goal(v);
    const bool may_rest = is_goal && slack + last_step > new_cap;
    if (may_rest && mdd_.task().goals.is_single()) continue;
    const Timestep t = mdd_.timestep(v, slack);
    scratch_ = {~layer[rank]};
    if (may_rest) scratch_.push_back(formula.end_at(v));
    Timestep largest = 0;
    const auto add = [&](VertexId w) {
      if (mdd_.to_goal(w) == kUnreachable) return;
      const Timestep next_slack = mdd_.slack(w, t + 1);
      largest = std::max(largest, next_slack);
      if (next_slack <= new_cap) scratch_.push_back(at(w, t + 1));
    };
    add(v);
    for (const VertexId w : graph.neighbours(v)) add(w);
    const bool is_short_goal = is_goal && last_step == 2;
    const bool was_complete = slack <= old_cap && (is_short_goal ? slack + 2 : largest) <= old_cap;
    if (was_complete) continue;
    if (largest > new_cap) scratch_.push_back(guard);
    formula.add(scratch_);
  }
}

bool MddPaths::extend(const Graph& graph, Timestep new_cap, Formula& formula,
                      LimitMonitor* limits) {
  const auto stopped = [&] { return limits != nullptr && limits->exhausted_now(); };
  const Timestep old_cap = cap();
  if (new_cap <= old_cap) return true;
  if (mdd_.distance() + new_cap >= kMaxTimestep) return false;
  for (Timestep slack = old_cap + 1; slack <= new_cap; ++slack) {
    if (stopped()) return false;
    make_layer(graph, slack, formula);
  }
  const Lit guard = formula.delay_at_least(new_cap + 1);
  const Goals& goals = mdd_.task().goals;
  if (old_cap < 0) {
    scratch_ = {at(mdd_.task().start, 0)};
    formula.add(scratch_);
  }
  if (old_cap < 0 && !goals.is_single()) {
    scratch_.clear();
    for (const VertexId goal : goals.vertices()) scratch_.push_back(formula.end_at(goal));
    formula.add(scratch_);
  }
  for (const VertexId goal : goals.vertices()) {
    scratch_ = {guard};
    if (!goals.is_single()) scratch_.push_back(~formula.end_at(goal));
    if (const Lit last = at(goal, mdd_.distance() + new_cap); last.valid())
      scratch_.push_back(last);
    formula.add(scratch_);
  }
  // Older ones cannot step beyond the old cap.
  const Timestep first = old_cap + 1 - mdd_.largest_step();
  for (Timestep slack = std::max(0, first); slack <= new_cap; ++slack) {
    if (stopped()) return false;
    if (slack > old_cap) {
      add_delay_clauses(slack, formula);
      add_predecessor_clauses(graph, slack, formula);
      add_end_clauses(slack, formula);
    }
    add_successor_clauses(graph, slack, old_cap, formula);
  }
  return true;
}

}  // namespace quadrille::discrete
