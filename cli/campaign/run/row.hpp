// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "campaign/jobs/job.hpp"
#include "campaign/run/child.hpp"
#include "quadrille/core/result.hpp"

namespace quadrille::cli::campaign {

/// What a job has found: one line of the file of results. docs/campaign.md describes its keys.
struct Row {
  std::string job;
  /// As in a result; or "failed": no result at all; `explanation` says why; or "open": the failed
  /// row before it counts no more, and the job is to be run again.
  std::string status;
  std::string stop_reason;
  bool enforced = false;  ///< The limit had to be enforced from outside.
  std::string explanation;
  /// As in the result (in continuous time in the unit of the instance); null without.
  nlohmann::ordered_json cost, lower_bound;
  /// The same as whole numbers: timesteps or ticks.
  std::optional<std::int64_t> exact_cost, exact_bound;
  double process_cpu_s = 0, wall_s = 0;
  nlohmann::ordered_json statistics;  ///< Of the result; null without.
  std::string version, host;
  nlohmann::ordered_json history;  ///< [[seconds, lower bound, cost or null], ...] or null.
  /// What its seconds are: "cpu" or "wall", which is also what they are where nothing says so.
  std::string history_clock = "wall";
  nlohmann::ordered_json certificate;  ///< Room for the name of one; null.
  /// On grids a list of texts (plan_text.hpp); else the result that has the plan; or null.
  nlohmann::ordered_json plan;

  [[nodiscard]] bool opens() const { return status == "open"; }
  [[nodiscard]] bool solved() const { return status == "optimal" || status == "infeasible"; }
};

/// One line, without its end.
[[nodiscard]] std::string to_line(const Row& row);
/// Errors (syntax): a line that is no row; one that is can be used without further checks.
[[nodiscard]] Result<Row> read_row(std::string_view line);

/// What a job's end says. A job that a signal has ended, other than for a limit, has no row:
/// nullopt; it is worth another try.
[[nodiscard]] std::optional<Row> make_row(const Job& job, const Ended& ended);
/// The row of a job that is not tried again.
[[nodiscard]] Row failed_row(const Job& job, const Ended& ended, const std::string& why);
/// The row that makes a failed job open again.
[[nodiscard]] Row open_row(const Job& job);

}  // namespace quadrille::cli::campaign
