// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "quadrille/core/ids.hpp"
#include "quadrille/core/limits.hpp"
#include "quadrille/core/statistics.hpp"
#include "quadrille/sat/cost_search.hpp"
#include "quadrille/sat/engine.hpp"

namespace quadrille::sat {

/// A problem whose plans cost the sum of their agents' costs, each of which can be bounded by an
/// assumption. An agent whose bound is not assumed is *absent*: it need not have a path, and nobody
/// collides with it.
class AgentCostProblem {
 public:
  virtual ~AgentCostProblem() = default;
  [[nodiscard]] virtual std::size_t num_agents() const = 0;
  /// Cost of the agent's cheapest path when it is alone.
  [[nodiscard]] virtual Cost free_cost(AgentId agent) const = 0;
  /// The literal "the agent costs more than `cost`", cost >= free_cost, after adding what paths up
  /// to `cost` need. Implied by the literals for larger costs. nullopt if `limits` ended that
  /// early. Not during solve.
  [[nodiscard]] virtual std::optional<Lit> cost_above(AgentId agent, Cost cost,
                                                      LimitMonitor& limits) = 0;
  /// Called before each solve. `all_present`: every agent has a bound among the assumptions.
  virtual void on_solve(bool all_present) = 0;
  /// Looks at the engine's model for all agents. False: it is no plan, clauses that exclude it were
  /// added.
  [[nodiscard]] virtual bool accept_model() = 0;
};

struct CoreGuidedOptions {
  bool minimise_cores = true;  ///< Drop what a core does not need, under a budget.
};

/// Finds a plan of least sum of costs from below: assumes that nobody costs more than its share of
/// the lower bound, and relaxes the bounds that a core names by one unit in all (OLL: Andres et al.
/// 2012, ICLP; Morgado et al. 2014, CP). Never ends by itself if no plan exists. Deterministic as
/// long as no limit is met. Adds to `statistics.cores`.
[[nodiscard]] SearchReport search_by_cores(Engine& engine, AgentCostProblem& problem,
                                           const CoreGuidedOptions& options, LimitMonitor& limits,
                                           Statistics& statistics, const BoundListener& on_bound);

}  // namespace quadrille::sat
