// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "answers/explanation.hpp"
#include "answers/search_notes.hpp"
#include "asked/solve_arguments.hpp"
#include "quadrille/discrete/solver.hpp"
#include "quadrille/discrete/verify.hpp"

namespace quadrille::cli {

/// Whether `--check` means something to a system; the others check when they have to.
[[nodiscard]] bool has_schedule(discrete::System system) noexcept;

/// The result as JSON, documented in docs/cli.md: one key per line, the plan one agent per line.
/// `instance`: null if it was not read, which takes an outcome without a plan. `notes`: what else
/// was asked for.
[[nodiscard]] std::string result_json(const discrete::Instance* instance,
                                      const SolveArguments& arguments,
                                      const discrete::SolveOutcome& outcome,
                                      const SearchNotes& notes);
/// Of the vertices and timesteps of an instance, which outlives them.
[[nodiscard]] Names names_of(const discrete::Instance& instance);

/// The lines "result", "cost", "search" and "verified" of the human output. `check`: the replay of
/// the outcome's plan, if it has one.
[[nodiscard]] std::string describe_outcome(Objective objective,
                                           const discrete::SolveOutcome& outcome,
                                           const discrete::VerifyReport& check);
/// The line "verified" of a valid plan.
[[nodiscard]] std::string describe_check(const discrete::Plan& plan,
                                         const discrete::VerifyReport& check);

}  // namespace quadrille::cli
