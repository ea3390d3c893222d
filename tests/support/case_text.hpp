// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "quadrille/core/result.hpp"
#include "quadrille/discrete/instance.hpp"
#include "quadrille/discrete/solver.hpp"
#include "support/tuned_options.hpp"

namespace quadrille::discrete::support {

/// An instance as a text that people and tests read, the form of the files in tests/regressions:
///
///     # a comment
///     map                                  vertices 3
///     .@.                                  edge 0 1
///     ...                                  edge 1 2
///     task 0 0 -> 2 0                      task 0 -> 2
///     task 2 0 -> 0 0 or 1 1               task 1 -> 0 or 1
///     expect sum-of-costs 4                expect infeasible
///     options objective=makespan system=dpll-mdd check=1/3,2/3 seed=7 audit known-plan
///
/// A map ends where its rows of `.` and `@` end; tasks are x y -> x y there and vertex -> vertex
/// on graphs. `expect` and `options` may be left out.
struct Case {
  Instance instance;
  std::optional<Cost> sum_of_costs;  ///< Expected.
  std::optional<Cost> makespan;      ///< Expected.
  bool infeasible = false;           ///< Expected.
  std::optional<TunedOptions> options;
  bool known_plan = false;    ///< Give the solver an optimal plan to check its clauses against.
  bool initial_plan = false;  ///< Give the solver a plan to begin with.
};

/// The lines of a graph and its tasks, with a picture of a grid as a comment.
[[nodiscard]] std::string instance_text(const Instance& instance);
/// The `options` line.
[[nodiscard]] std::string options_text(const TunedOptions& options);

/// Errors (syntax, invalid_instance) name `file` and the line.
[[nodiscard]] Result<Case> parse_case(const std::string& text, const std::string& file);

}  // namespace quadrille::discrete::support
