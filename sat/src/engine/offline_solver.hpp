// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "quadrille/sat/engine.hpp"

namespace quadrille::sat {

/// Solves what an engine has been told so far, without its theory (an "offline" SMT solver:
/// Nieuwenhuis et al. 2006, JACM, section 3). What it refutes is refuted, because the theory only
/// excludes more; its models are candidates, for the engine to look at. It takes an eighth of the
/// engine's time for a conflict: it asks nobody, and it may rewrite the formula between conflicts.
class OfflineSolver {
 public:
  /// The engine records its clauses for this solver alone, and outlives it.
  explicit OfflineSolver(Engine& engine);

  /// Learns first what the engine has been given since the last call.
  [[nodiscard]] Verdict solve(std::span<const Lit> assumptions, LimitMonitor& limits,
                              const SolveBudget& budget);
  /// Requires that the last verdict was unsat: whether it did not take the assumptions.
  [[nodiscard]] bool refutes_everything() const { return solver_.core().empty(); }
  /// Requires that the last verdict was sat. False for a literal that is younger than it.
  [[nodiscard]] bool candidate_has(Lit lit) const;
  /// Adds sat_calls, conflicts and decisions: the clauses are the engine's.
  void add_statistics(Statistics& statistics) const;

 private:
  void catch_up();

  Engine& source_;
  Engine solver_;
};

}  // namespace quadrille::sat
