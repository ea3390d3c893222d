// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "quadrille/core/random.hpp"
#include "quadrille/sat/cost_search.hpp"

namespace quadrille::sat {

/// Drops from cores what they do not need, by deletion: each try solves a part of the core, under a
/// budget counted in conflicts and decisions, so that all is deterministic. Agents that the part
/// does not bound are absent. What is learned on the way is kept in any case.
class CoreMinimiser {
 public:
  struct Options {
    bool enabled = true;
    /// How often minimisation is tried again in a random order, for the smallest core; at least 0.
    /// If not 0, each try ends sooner.
    int retries = 0;
  };
  CoreMinimiser(const CostSearchContext& context, const Options& options)
      : context_(context), options_(options) {}

  /// A part of `core` that cannot hold either. `searched`: conflicts of the search so far; those of
  /// the minimiser exceed them by little. `retry`: as often as the options say. Conflicts of
  /// retries do not count against later cores.
  [[nodiscard]] std::vector<Lit> minimise(const std::vector<Lit>& core, std::int64_t searched,
                                          bool retry);

 private:
  [[nodiscard]] std::vector<Lit> drop(std::vector<Lit> core, std::int64_t searched);
  /// Unsat: `part` cannot hold. Passes the yield point.
  [[nodiscard]] Verdict solve_part(const std::vector<Lit>& part);

  const CostSearchContext context_;
  const Options options_;
  Random random_{1};
  std::int64_t conflicts_ = 0;
};

}  // namespace quadrille::sat
