// SPDX-License-Identifier: MIT
#include "cost/cost_neighbourhoods.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "cost/plan_query.hpp"

namespace quadrille::sat {

CostNeighbourhoods::CostNeighbourhoods(const CostSearchContext& context, ExcessCounter& counter)
    : context_(context), counter_(counter), num_free_(context.problem.num_agents() / 5 + 1) {}

Outcome CostNeighbourhoods::advance(Slice slice) {
  Bounds& bounds = context_.bounds;
  LimitMonitor& limits = context_.limits;
  const Settings& settings = context_.settings;
  const std::int64_t end = slice.conflicts ? limits.conflicts() + *slice.conflicts
                                           : std::numeric_limits<std::int64_t>::max();
  std::vector<AgentId> agents;
  for (const AgentId i : IdRange<AgentId>(context_.problem.num_agents())) agents.push_back(i);
  std::int64_t failures = 0;
  while (limits.conflicts() < end && !limits.exhausted_now()) {
    const auto best = bounds.upper();
    if (!best || *best <= bounds.lower() || *best > counter_.largest()) break;
    const bool are_candidates_next = *best - bounds.lower() <= settings.above_candidates_within;
    if (failures >= settings.above_patience / (are_candidates_next ? 2 : 1)) break;
    random_.shuffle_front(agents, agents.size());
    std::vector<Lit> assumptions;
    for (std::size_t at = num_free_; at < agents.size(); ++at)
      assumptions.push_back(
          ~context_.problem.cost_above(agents[at], bounds.incumbent_cost_of(agents[at])));
    // Last: with the others in front, most agents have their caps before it says anything.
    const Lit not_cheaper = counter_.above(*best - 1);
    assumptions.push_back(~not_cheaper);
    const Verdict verdict =
        find_plan(context_, assumptions,
                  std::min(settings.above_neighbourhood_conflicts, end - limits.conflicts()));
    failures = verdict == Verdict::sat ? 0 : failures + 1;
    if (verdict == Verdict::unsat) {
      const std::vector<Lit> core = context_.engine.core();
      if (core.empty()) return Outcome::exhausted;
      // A core of the sum alone holds for all plans: none is cheaper than the incumbent.
      if (core.size() == 1 && core.front() == ~not_cheaper) {
        counter_.note_bound(*best);
        bounds.raise(*best);
        break;
      }
      num_free_ = std::min(agents.size(), num_free_ + num_free_ / 20 + 1);
    } else if (verdict == Verdict::unknown) {
      num_free_ = std::max<std::size_t>(1, num_free_ - num_free_ / 14);
    }
  }
  return limits.exhausted() ? Outcome::stopped : Outcome::working;
}

}  // namespace quadrille::sat
