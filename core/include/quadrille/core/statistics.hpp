// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

#include "quadrille/core/export.hpp"

QUADRILLE_API_BEGIN

namespace quadrille {

/// What one search did. All numbers start at zero and only grow.
struct Statistics {
  double cpu_s = 0;         ///< CPU time of the search.
  double wall_s = 0;        ///< Wall-clock time of the search.
  double peak_rss_mib = 0;  ///< Largest resident set of the process.
  std::int64_t sat_calls = 0;
  std::int64_t conflicts = 0;  ///< Clauses learned by the SAT solver.
  std::int64_t decisions = 0;  ///< Decision levels opened by the SAT solver.
  std::int64_t variables = 0;
  std::int64_t clauses = 0;  ///< All clauses given to the SAT solver, lemmas included.
  std::int64_t collision_clauses =
      0;                            ///< Of these, clauses that rule out a conflict of two agents.
  std::int64_t checks = 0;          ///< Times the consistency of an assignment was checked.
  std::int64_t models_checked = 0;  ///< Of these, checks of complete assignments.
  /// Complete assignments with collisions that the SAT solver had called satisfying.
  std::int64_t rejected_models = 0;
  std::int64_t cores = 0;  ///< Unsatisfiable cores that raised the lower bound.
  /// Where the first plan came from: "given" by the user, "search" for the least cost, or a name of
  /// the domain's (docs/cli.md). Empty: there is none.
  std::string first_plan;

  /// Those of one search more: counts, neither times nor where plans came from.
  void add_counts(const Statistics& more) noexcept {
    sat_calls += more.sat_calls;
    conflicts += more.conflicts;
    decisions += more.decisions;
    variables += more.variables;
    clauses += more.clauses;
    collision_clauses += more.collision_clauses;
    checks += more.checks;
    models_checked += more.models_checked;
    rejected_models += more.rejected_models;
    cores += more.cores;
  }
};

}  // namespace quadrille

QUADRILLE_API_END
