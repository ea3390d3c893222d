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
class CoreMinimiser {
 public:
  explicit CoreMinimiser(const CostSearchContext& context) : context_(context) {}

  /// A part of `core` that cannot hold either. `searched`: conflicts of the search so far; those of
  /// the minimiser exceed them by little.
  [[nodiscard]] std::vector<Lit> minimise(std::vector<Lit> core, std::int64_t searched);
  /// The largest number of units found, at most `max_lift` >= 1, that some soft of the core has to
  /// be violated by: twice as many again and again, as long as less is refuted, then by halves.
  /// Drops softs that it does without. `searched`: as above.
  [[nodiscard]] Cost raise(Relaxation& relaxation, std::vector<Lit>& core, Cost max_lift,
                           std::int64_t searched);

 private:
  /// Unsat: `part` cannot hold. Counts the conflicts. Passes the yield point.
  [[nodiscard]] Verdict solve_part(const std::vector<Lit>& part, std::int64_t& conflicts);

  const CostSearchContext context_;
  std::int64_t conflicts_ = 0;        // to make cores smaller
  std::int64_t raise_conflicts_ = 0;  // to raise them
};

}  // namespace quadrille::sat
