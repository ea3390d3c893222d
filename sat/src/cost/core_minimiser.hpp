// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "cost/relaxation.hpp"
#include "quadrille/sat/cost_search.hpp"

namespace quadrille::sat {

/// Drops from cores what they do not need, by deletion: each try solves a part of the core, under a
/// budget counted in conflicts and decisions, so that all is deterministic. Agents that the part
/// does not bound are absent. What is learned on the way is kept in any case.
///
/// All tries of one kind may take about as many conflicts as the search had, `searched`, and about
/// as much effort as the engine spent on everything else.
class CoreMinimiser {
 public:
  explicit CoreMinimiser(const CostSearchContext& context) : context_(context) {}

  /// A part of `core` that cannot hold either.
  [[nodiscard]] std::vector<Lit> minimise(std::vector<Lit> core, std::int64_t searched);
  /// The largest `lift` found, at most `max_lift` >= 1, such that not all softs of the core can be
  /// violated by less than `lift` units. It is doubled as long as that is refuted, then found by
  /// bisection. Drops softs that a refutation does not need. Tries that refute are free.
  [[nodiscard]] Cost raise(Relaxation& relaxation, std::vector<Lit>& core, Cost max_lift,
                           std::int64_t searched);

 private:
  /// What the engine has done for one purpose.
  struct Spent {
    std::int64_t conflicts = 0;
    Effort effort = {};
  };
  /// Whether `spent` is within its budget, and no limit is met. `other`: for the other purpose.
  [[nodiscard]] bool may_spend(const Spent& spent, const Spent& other, std::int64_t searched) const;
  /// Unsat: `part` cannot hold. Adds to `spent`. Passes the yield point.
  [[nodiscard]] Verdict solve_part(const std::vector<Lit>& part, Spent& spent);

  const CostSearchContext context_;
  Spent minimising_, raising_;
};

}  // namespace quadrille::sat
