// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "answers/explanation.hpp"
#include "answers/report.hpp"
#include "answers/search_notes.hpp"
#include "asked/solve_arguments.hpp"
#include "quadrille/continuous/solver.hpp"
#include "quadrille/continuous/verify.hpp"

namespace quadrille::cli {

/// The result as JSON, documented in docs/cli.md. `instance`: null if it was refused, which takes
/// an outcome without a plan. `check`: the replay of the plan, if there is one. `notes`: what
/// else was asked for.
[[nodiscard]] std::string result_json(const continuous::Instance* instance,
                                      const SolveArguments& arguments,
                                      const continuous::SolveOptions& options,
                                      const continuous::SolveOutcome& outcome,
                                      const continuous::VerifyReport& check,
                                      const SearchNotes& notes);
/// Of the vertices and ticks of an instance, which outlives them.
[[nodiscard]] Names names_of(const continuous::Instance& instance);

/// The lines "result", "cost", "search", "verified" and "claim" of the human output.
[[nodiscard]] std::string describe_outcome(const continuous::Instance& instance,
                                           Objective objective,
                                           const continuous::SolveOutcome& outcome,
                                           const continuous::VerifyReport& check);

/// The lines "result" and "why" for an instance that was refused because it has no plan.
[[nodiscard]] std::string describe_refused(const continuous::SolveOutcome& outcome);

/// The line "verified" of a valid plan.
[[nodiscard]] std::string describe_check(const continuous::Instance& instance,
                                         const continuous::VerifyReport& check);
/// "least clearance 0.25, between agents 0 and 3 at 1.5"; empty for fewer than two sound paths.
[[nodiscard]] std::string describe_clearance(const continuous::Instance& instance,
                                             const continuous::VerifyReport& check);
/// The least clearance in the length unit of the input; null for fewer than two sound paths.
[[nodiscard]] Json clearance_json(const continuous::Instance& instance,
                                  const continuous::VerifyReport& check);

/// One line per agent: start, goal, cost, and the vertices with the waits between them. A line that
/// says why not for a plan too large to read.
[[nodiscard]] std::string list_paths(const continuous::Instance& instance,
                                     const continuous::Plan& plan);

}  // namespace quadrille::cli
