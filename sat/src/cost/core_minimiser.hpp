// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

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

 private:
  /// Unsat: `part` cannot hold. Passes the yield point.
  [[nodiscard]] Verdict solve_part(const std::vector<Lit>& part);

  const CostSearchContext context_;
  std::int64_t conflicts_ = 0;
};

}  // namespace quadrille::sat
