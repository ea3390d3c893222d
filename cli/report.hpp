// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "exit_codes.hpp"
#include "input.hpp"
#include "quadrille/discrete/solver.hpp"
#include "quadrille/discrete/verify.hpp"

namespace quadrille::cli {

/// What `solve` was asked, for the reports.
struct SolveRequest {
  InputOptions input;
  discrete::SolveOptions options;
  std::string known_plan;  ///< File name; empty without one.
};

/// Whether `--check` means something to a system; the others check when they have to.
[[nodiscard]] bool has_schedule(discrete::System system) noexcept;

/// The exit code that says what the outcome says.
[[nodiscard]] ExitCode exit_code(const discrete::SolveOutcome& outcome);

/// The result as JSON, documented in docs/cli.md: one key per line, the plan one agent per line.
[[nodiscard]] std::string result_json(const discrete::Instance& instance,
                                      const SolveRequest& request,
                                      const discrete::SolveOutcome& outcome);

/// The lines "result", "cost", "search" and "verified" of the human output. `check` is the replay
/// of the outcome's plan, if it has one.
[[nodiscard]] std::string describe_outcome(const SolveRequest& request,
                                           const discrete::SolveOutcome& outcome,
                                           const discrete::VerifyReport* check);

/// The first violations, one per line, and how many more there are.
[[nodiscard]] std::string describe_violations(const discrete::VerifyReport& check);

}  // namespace quadrille::cli
