// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "cost/excess_counter.hpp"
#include "engine/offline_solver.hpp"
#include "quadrille/sat/cost_search.hpp"
#include "quadrille/sat/strategy.hpp"

namespace quadrille::sat {

/// Closes the last gap: an offline solver, which knows all clauses but not the theory, chooses
/// costs for all agents that are cheaper in sum than the incumbent. The engine refutes the choice
/// or makes a plan of it. When there is no choice left, the incumbent is optimal.
class CandidateSearch final : public Strategy {
 public:
  /// All outlive it.
  CandidateSearch(const CostSearchContext& context, OfflineSolver& offline, ExcessCounter& counter)
      : context_(context), offline_(offline), counter_(counter) {}

  /// Requires an incumbent within reach of the counter, and a slice with conflicts. Those of the
  /// offline solver take an eighth of the time each, so that a slice has more of them.
  [[nodiscard]] Outcome advance(Slice slice) override;

 private:
  /// What agents cost at most in the offline solver's model, as assumptions.
  [[nodiscard]] std::vector<Lit> caps_of_candidate();

  const CostSearchContext context_;
  OfflineSolver& offline_;
  ExcessCounter& counter_;
};

}  // namespace quadrille::sat
