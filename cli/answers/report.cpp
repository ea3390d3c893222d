// SPDX-License-Identifier: MIT
#include "answers/report.hpp"

#include <fmt/format.h>

#include <cmath>

namespace quadrille::cli {

Json text_or_null(const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); }

namespace {

Json statistics_json(const Statistics& statistics) {
  Json json;
  // Digits beyond a microsecond are noise.
  const auto round = [](double value) { return std::round(value * 1e6) / 1e6; };
  json["cpu_s"] = round(statistics.cpu_s);
  json["wall_s"] = round(statistics.wall_s);
  json["peak_rss_mib"] = round(statistics.peak_rss_mib);
  json["sat_calls"] = statistics.sat_calls;
  json["conflicts"] = statistics.conflicts;
  json["decisions"] = statistics.decisions;
  json["variables"] = statistics.variables;
  json["clauses"] = statistics.clauses;
  json["collision_clauses"] = statistics.collision_clauses;
  json["checks"] = statistics.checks;
  json["models_checked"] = statistics.models_checked;
  json["cores"] = statistics.cores;
  json["first_plan"] = text_or_null(statistics.first_plan);
  return json;
}

}  // namespace

ExitCode exit_code(Status status) {
  switch (status) {
    case Status::optimal:
      return ExitCode::success;
    case Status::feasible:
      return ExitCode::feasible;
    case Status::infeasible:
      return ExitCode::infeasible;
    case Status::unknown:
      return ExitCode::unknown;
  }
  return ExitCode::internal;
}

std::string gap_text(double gap_percent) {
  if (!(gap_percent > 0 && std::isfinite(gap_percent))) return "";
  return fmt::format(", gap {:.2f} %", gap_percent);
}

std::string describe(const OutcomeText& outcome) {
  std::string text = fmt::format("result     {}", to_string(outcome.status));
  if (outcome.stop != StopReason::none)
    text += fmt::format(" (stopped: {})", to_string(outcome.stop));
  text += "\n";
  if (!outcome.explanation.empty()) text += fmt::format("why        {}\n", outcome.explanation);
  if (outcome.cost || outcome.status == Status::unknown)
    text += fmt::format("cost       {} ({}), lower bound {}{}\n", outcome.cost.value_or("unknown"),
                        to_string(outcome.objective), outcome.lower_bound,
                        gap_text(outcome.gap_percent));
  if (outcome.rests_on_known_bound) text += "bound      as it was given, not proved here\n";
  const Statistics& s = outcome.statistics;
  return text +
         fmt::format("search     {:.2f} s, {} SAT calls, {} conflicts, {} collision clauses\n",
                     s.wall_s, s.sat_calls, s.conflicts, s.collision_clauses);
}

void add_limits(Json& options, const Limits& limits) {
  options["time_limit"] = or_null(limits.wall_s);
  options["cpu_limit"] = or_null(limits.cpu_s);
  options["memory_limit"] = or_null(limits.memory_mib);
  options["conflict_limit"] = or_null(limits.conflicts);
}

ResultJson::ResultJson(Status status, Objective objective) : JsonLines("result") {
  add("status", to_string(status));
  add("objective", to_string(objective));
}

std::string JsonLines::on_one_line(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

void JsonLines::add(std::string_view key, const Json& value) { add_text(key, on_one_line(value)); }

void JsonLines::add_text(std::string_view key, std::string_view json) {
  text_ += fmt::format("{}\n  \"{}\": {}", text_ == "{" ? "" : ",", key, json);
}

std::string ResultJson::finish(const Statistics& statistics, std::uint32_t seed,
                               const Json& options, const std::string& plan) {
  add("statistics", statistics_json(statistics));
  add("version", QUADRILLE_VERSION);
  add("seed", seed);
  add("options", options);
  add_text("plan", plan);
  return JsonLines::finish();
}

}  // namespace quadrille::cli
