// SPDX-License-Identifier: MIT
#include "fleets/dispatch_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "answers/report.hpp"

namespace quadrille::cli {
namespace {

constexpr double kShare = 0.95;

/// Of numbers: nothing of none.
std::optional<double> mean(const std::vector<double>& numbers) {
  if (numbers.empty()) return std::nullopt;
  double sum = 0;
  for (const double number : numbers) sum += number;
  return sum / static_cast<double>(numbers.size());
}
/// The least one that is no less than this share of them.
std::optional<double> quantile(std::vector<double> numbers, double share) {
  if (numbers.empty()) return std::nullopt;
  std::sort(numbers.begin(), numbers.end());
  const double at = std::ceil(share * static_cast<double>(numbers.size())) - 1;
  return numbers[static_cast<std::size_t>(std::max(at, 0.0))];
}
std::optional<double> milliseconds(const std::optional<double>& seconds) {
  return seconds ? std::optional(1e3 * *seconds) : std::nullopt;
}
std::string number(const std::optional<double>& value) {
  return value ? fmt::format("{:.4g}", *value) : std::string("-");
}

}  // namespace

std::string DispatchReport::text() const {
  const std::string idle = number(static_cast<double>(waiting) / static_cast<double>(calls()));
  const std::string waits =
      is_on_grid ? fmt::format(
                       "waiting    {} robots that do not arrive in the window, in the mean\n", idle)
                 : fmt::format(
                       "waiting    {} robots without a path in the mean\n"
                       "origins    {} times planned anew for late robots; {} plans came too late\n",
                       idle, origins, too_late);
  return fmt::format(
      "time       {:g}, in {} calls; seed {}\n"
      "tasks      {} done, {} per unit of time\n"
      "service    mean {}, 95 % within {}\n"
      "calls      mean {} ms, 95 % within {} ms, longest {} ms, with the simulation\n"
      "{}"
      "gap        mean {} %, median {} %, 95 % within {} %\n"
      "contacts   {}\n",
      time, calls(), seed, served, number(static_cast<double>(served) / time),
      number(mean(service_times)), number(quantile(service_times, kShare)),
      number(milliseconds(mean(call_seconds))),
      number(milliseconds(quantile(call_seconds, kShare))),
      number(milliseconds(quantile(call_seconds, 1))), waits, number(mean(gaps)),
      number(quantile(gaps, 0.5)), number(quantile(gaps, kShare)), contacts);
}

std::string DispatchReport::json() const {
  const Json report = {
      {"quadrille", "dispatch"},
      {"version", 1},
      {"dispatcher", is_on_grid ? "grid" : "roadmap"},
      {"robots", robots},
      {"seed", seed},
      {"time", time},
      {"calls", calls()},
      {"tasks_done", served},
      {"throughput", static_cast<double>(served) / time},
      {"service_time_mean", or_null(mean(service_times))},
      {"service_time_95", or_null(quantile(service_times, kShare))},
      {"call_s_mean", or_null(mean(call_seconds))},
      {"call_s_95", or_null(quantile(call_seconds, kShare))},
      {"call_s_longest", or_null(quantile(call_seconds, 1))},
      {"waiting_mean", static_cast<double>(waiting) / static_cast<double>(calls())},
      {"new_origins", origins},
      {"plans_too_late", too_late},
      {"gap_percent_mean", or_null(mean(gaps))},
      {"gap_percent_median", or_null(quantile(gaps, 0.5))},
      {"gap_percent_95", or_null(quantile(gaps, kShare))},
      {"contacts", contacts},
      {"service_times", service_times},
      {"each_call", {{"gap_percent", call_gaps}, {"seconds", call_seconds}}}};
  return report.dump(2) + "\n";
}

}  // namespace quadrille::cli
