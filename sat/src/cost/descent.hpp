// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/offline_solver.hpp"
#include "quadrille/core/random.hpp"
#include "quadrille/sat/core_guided_search.hpp"
#include "quadrille/sat/totalizer.hpp"

namespace quadrille::sat {

/// The search from above of a core-guided search (core-boosted linear search: Berg et al. 2019,
/// CPAIOR): bounds the sum of what the cores found so far leave open, and lowers that bound with
/// each plan. First it tries to improve the best plan by large neighbourhoods of costs, not of
/// paths: all but some agents may cost what they cost there. Its only assumptions are bounds of
/// costs, so what is learned stays true for the search from below and the other way round.
class Descent {
 public:
  /// A plan costs `base` and the sum of the inputs of `excess` (see Totalizer), every agent's cost
  /// among them. All must outlive the descent. `max_gap`: how close the bounds have to be before
  /// the offline solver looks at everything between them.
  Descent(Engine& engine, OfflineSolver& offline, AgentCostProblem& problem, PlanStore& plans,
          LimitMonitor& limits, Cost base, std::size_t num_inputs, Totalizer::Input excess,
          Cost max_gap);

  [[nodiscard]] Cost base() const noexcept { return base_; }
  /// Goes on for so many conflicts of the engine, and, if the bounds are close, twice as long with
  /// candidates of the offline solver, or until no plan can be cheaper than the best one. Requires
  /// the proven lower bound and returns what it is after that. Asks for nothing far above the base:
  /// adds about a million clauses at most.
  [[nodiscard]] Cost advance(Cost lower_bound, std::int64_t conflicts);
  /// Ends the use of its counter, for good. Only destruction may follow.
  void retire() { excess_.retire(); }

 private:
  /// Asks for a plan with these assumptions and takes it.
  [[nodiscard]] Verdict look(std::span<const Lit> assumptions, std::int64_t conflicts);
  /// Until conflicts end or neighbourhoods seem to hold no cheaper plan.
  [[nodiscard]] Cost try_neighbourhoods(Cost lower_bound, std::int64_t end);
  /// Bounds the sum alone.
  [[nodiscard]] Cost try_all(Cost lower_bound, std::int64_t end);
  /// The same, for a plan that is cheaper than the best one, with candidates.
  [[nodiscard]] Cost try_candidates(Cost lower_bound, std::int64_t conflicts);
  /// What agents cost at most in the offline solver's model, as assumptions.
  [[nodiscard]] std::vector<Lit> caps_of_candidate();
  [[nodiscard]] Lit cost_above(AgentId agent, Cost cost);
  /// That a plan costs more than `cost`, base <= cost < base + max_excess_.
  [[nodiscard]] Lit plan_above(Cost cost);

  Engine& engine_;
  OfflineSolver& offline_;
  AgentCostProblem& problem_;
  PlanStore& plans_;
  LimitMonitor& limits_;
  const Cost base_;
  const Cost max_gap_;
  const Cost max_excess_;  // more would make the counter too large
  Totalizer excess_;
  Random random_{1};
  std::size_t num_free_;  // agents of a neighbourhood that may cost anything
  Cost max_step_;         // how far above the lower bound a plan is asked for
};

}  // namespace quadrille::sat
