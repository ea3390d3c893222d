// SPDX-License-Identifier: MIT
#include "mdd/fewest_moves.hpp"

#include <algorithm>

#include "quadrille/core/internal_error.hpp"

namespace quadrille::discrete {

using sat::Lit;

namespace {

/// Every edge leads from one of two parts of the graph to the other. O(V + E).
bool has_two_parts(const Graph& graph) {
  enum class Part : std::uint8_t { none, one, other };
  IdVector<VertexId, Part> part(graph.num_vertices(), Part::none);
  std::vector<VertexId> open;
  for (const VertexId root : IdRange<VertexId>(graph.num_vertices())) {
    if (part[root] != Part::none) continue;
    part[root] = Part::one;
    open = {root};
    while (!open.empty()) {
      const VertexId v = open.back();
      open.pop_back();
      const Part across = part[v] == Part::one ? Part::other : Part::one;
      const auto look = [&](VertexId w) {
        if (part[w] == Part::none) open.push_back(w);
        if (part[w] == Part::none) part[w] = across;
        return part[w] == across;
      };
      for (const VertexId w : graph.neighbours(v))
        if (!look(w)) return false;
      for (const VertexId w : graph.predecessors(v))
        if (!look(w)) return false;
    }
  }
  return true;
}

}  // namespace

FewestMoves::FewestMoves(MddModel& model, MddProblem& problem, sat::Engine& engine, Cost cost)
    : model_(model),
      problem_(problem),
      engine_(engine),
      cost_(cost),
      unit_(has_two_parts(model.instance().graph()) ? 2 : 1) {
  std::size_t inputs = 0;
  Timestep largest = 2;
  for (const AgentId i : model.instance().agent_ids()) {
    const Mdd& mdd = model.mdd(i);
    first_input_.push_back(inputs);
    seen_cap_.push_back(-1);
    least_ += mdd.distance();
    largest = std::max(largest, mdd.largest_step());
    // A path that never waits and costs its distance has no choice.
    const Timestep delay = problem.allowed_delay(i, cost);
    if (delay > 0) inputs += static_cast<std::size_t>(mdd.distance() + delay);
  }
  most_ = largest / unit_;
  more_.resize(inputs);
  total_.emplace(engine, inputs,
                 [this](std::size_t input, int amount) { return more(input, amount); });
}

Lit FewestMoves::more(std::size_t input, int amount) {
  if (amount > most_) return {};
  auto& lits = more_[input];
  while (lits.size() < static_cast<std::size_t>(amount)) {
    lits.push_back(engine_.new_lit());
    if (lits.size() == 1) continue;
    const Lit clause[] = {~lits.back(), lits[lits.size() - 2]};
    engine_.add_clause({sat::why::Counter{}, clause, {}, false});
  }
  return lits[static_cast<std::size_t>(amount) - 1];
}

void FewestMoves::extend(AgentId agent) {
  const Mdd& mdd = model_.mdd(agent);
  const Graph& graph = model_.instance().graph();
  const Timestep cap = model_.cap(agent);
  for (Timestep slack = std::max(0, seen_cap_[agent] + 1); slack <= cap; ++slack)
    for (const VertexId w : IdRange<VertexId>(graph.num_vertices())) {
      if (mdd.to_goal(w) == kUnreachable) continue;
      const Timestep t = mdd.timestep(w, slack);
      if (t == 0) continue;
      const Lit to = model_.at(agent, w, t);
      if (!to.valid()) continue;
      // Slack does not fall: where a move comes from was there before.
      for (const VertexId v : graph.predecessors(w)) {
        if (mdd.to_goal(v) == kUnreachable) continue;
        const Timestep amount = (1 + mdd.to_goal(w) - mdd.to_goal(v)) / unit_;
        const Lit from = model_.at(agent, v, t - 1);
        if (amount == 0 || !from.valid()) continue;
        const std::size_t input = first_input_[agent] + static_cast<std::size_t>(t) - 1;
        const Lit clause[] = {~from, ~to, more(input, amount)};
        engine_.add_clause({sat::why::Counter{}, clause, {}, false});
      }
    }
  seen_cap_[agent] = cap;
}

bool FewestMoves::assume_at_most(Cost bound, LimitMonitor& limits, std::vector<Lit>& assumptions) {
  if (!problem_.assume_at_most(cost_, limits, assumptions)) return false;
  for (const AgentId i : model_.instance().agent_ids()) {
    if (limits.exhausted()) return false;
    if (model_.cap(i) > seen_cap_[i]) extend(i);
  }
  too_many_ = total_->at_least(static_cast<int>((bound - least_) / unit_) + 1);
  if (too_many_.valid()) assumptions.push_back(~too_many_);
  return true;
}

Cost FewestMoves::next_bound(Cost refuted, std::span<const Lit> core) {
  if (problem_.next_bound(cost_, core) == cost_) return refuted;
  if (std::find(core.begin(), core.end(), ~too_many_) == core.end())
    throw InternalError{"no plan costs what a plan costs"};
  return refuted + unit_;
}

}  // namespace quadrille::discrete
