// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
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
  /// Called before each solve. `all_present`: the assumptions bound every agent's cost, one by one
  /// or all together.
  virtual void on_solve(bool all_present) = 0;
  /// Looks at the engine's model for all agents. False: it is no plan, clauses that exclude it were
  /// added.
  [[nodiscard]] virtual bool accept_model() = 0;
};

/// Keeps the best plan that is known, whoever found it, while a search from below goes on.
class PlanStore {
 public:
  virtual ~PlanStore() = default;
  /// Cost of the best plan; nullopt if there is none.
  [[nodiscard]] virtual std::optional<Cost> best_cost() const = 0;
  /// What an agent costs in that plan. Requires one.
  [[nodiscard]] virtual Cost best_cost_of(AgentId agent) const = 0;
  /// Takes the plan of the model that the problem has accepted last.
  virtual void take_accepted() = 0;
};

struct CoreGuidedOptions {
  bool minimise_cores = true;  ///< Drop what a core does not need, under a budget.
  /// How often that is tried again in a random order during the passes, for the smallest core; at
  /// least 0. If not 0, all tries are shorter.
  int core_tries = 0;
  /// For whom plans are looked for from above too, once cores take long; null: nobody. Only for
  /// problems whose `cost_above` adds little and never fails, and with an engine that keeps its
  /// clauses, for nobody else. Must outlive the search.
  PlanStore* plans = nullptr;
  std::int64_t first_turn = 8000;  ///< Conflicts that make a core hard, 1 .. 2^31 - 1.
  /// How often at most cores are extracted from the start: again when a core is hard, with all that
  /// was learned, which makes for smaller ones; two times in a row without gain are the last. At
  /// least 1. Measured: 2 to 6 make little difference, one is up to four times as slow.
  int passes = 3;
  /// The first turn after the passes is so many times as long as `first_turn`: cores alone often
  /// come to the end in it. At least 1.
  std::int64_t head_start = 1;
  /// So many conflicts from above for each one from below. At least 1.
  std::int64_t descent_share = 1;
  /// How close the best plan has to be to the lower bound before an offline solver, without the
  /// theory, chooses costs for the engine to look at; 0: never.
  Cost candidates_within = 8;
};

/// Finds a plan of least sum of costs from below: assumes that nobody costs more than its share of
/// the lower bound, and relaxes the bounds that a core names by one unit in all (OLL: Andres et al.
/// 2012, ICLP; Morgado et al. 2014, CP). When a core is hard, it starts again, and goes on from the
/// best of its passes. With `options.plans` and hard cores after that it takes turns with a
/// search from above, which asks for plans that are cheaper than the best one by a bound on the sum
/// of what the cores have left open (core-boosted search: Berg et al. 2019, CPAIOR). When the lower
/// bound comes to the cost of the best plan, it ends, `stopped`: that plan is optimal. Never ends
/// by itself if no plan exists. Deterministic as long as no limit is met. Adds to
/// `statistics.cores`.
[[nodiscard]] SearchReport search_by_cores(Engine& engine, AgentCostProblem& problem,
                                           const CoreGuidedOptions& options, LimitMonitor& limits,
                                           Statistics& statistics, const BoundListener& on_bound);

}  // namespace quadrille::sat
