// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
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
[[nodiscard]] ExitCode exit_code(Status status);
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
template <class VerifyReport>
[[nodiscard]] std::string describe_violations(const VerifyReport& check) {
  constexpr std::size_t kShown = 100;
  std::string text;
  const std::size_t shown = std::min(kShown, check.violations.size());
  for (std::size_t i = 0; i < shown; ++i) text += check.violations[i].message + "\n";
  if (shown < check.violations.size())
    text += "... and " + std::to_string(check.violations.size() - shown) + " more\n";
  return text;
}

// Parts of the results in JSON.

using Json = nlohmann::ordered_json;

template <class T>
[[nodiscard]] Json or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}
/// null for an empty text.
[[nodiscard]] Json text_or_null(const std::string& text);
[[nodiscard]] Json statistics_json(const Statistics& statistics);
/// On one line. Bytes that are not UTF-8, as file names may have, are replaced.
[[nodiscard]] std::string dump(const Json& json);

}  // namespace quadrille::cli
