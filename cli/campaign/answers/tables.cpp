// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <array>
#include <map>
#include <utility>

#include "campaign/answers/merged.hpp"

namespace quadrille::cli::campaign {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array kStatistics = {"cpu_s",     "conflicts", "decisions",
                                    "variables", "clauses",   "collision_clauses",
                                    "checks",    "sat_calls", "peak_rss_mib"};

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string text_of(const Json& json) {
  if (json.is_null()) return "";
  return json.is_string() ? json.get<std::string>() : json.dump();
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

/// The columns of a job and its row, in the order of the CSV file.
std::vector<std::pair<const char*, Json>> columns(const Merged& merged, const Job& job,
                                                  const Row& row) {
  const auto limit = [&](const auto& value) { return value ? Json(*value) : Json(nullptr); };
  std::vector<std::pair<const char*, Json>> result = {
      {"objective", to_string(job.objective)},
      {"map", job.family},
      {"scenario", job.scenario},
      {"variant", job.variant},
      {"share_goals", job.share_goals},
      {"agents", job.agents},
      {"system", job.system},
      {"cpu_limit", limit(merged.list.limits.cpu_s)},
      {"seed", job.seed},
      {"job", job.name},
      {"status", row.status},
      {"stop_reason", row.stop_reason},
      {"enforced", row.enforced},
      {"cost", row.cost},
      {"lower_bound", row.lower_bound},
      {"process_cpu_s", row.process_cpu_s},
      {"wall_s", row.wall_s}};
  for (const char* name : kStatistics) {
    const bool has = row.statistics.is_object() && row.statistics.contains(name);
    result.emplace_back(name, has ? row.statistics.at(name) : Json(nullptr));
  }
  result.emplace_back("version", row.version);
  result.emplace_back("host", row.host);
  result.emplace_back("certificate", row.certificate);
  result.emplace_back("options", joined(job.options));
  result.emplace_back("explanation", row.explanation);
  return result;
}

template <class Use>
void for_each_row(const Merged& merged, const Use& use) {
  for (std::size_t job = 0; job < merged.rows.size(); ++job)
    if (merged.rows[job]) use(columns(merged, merged.list.jobs[job], *merged.rows[job]));
}

/// "even-12" -> {"even", "12"}
std::optional<std::pair<std::string, std::string>> scenario_type(const std::string& scenario) {
  const auto dash = scenario.rfind('-');
  if (dash == std::string::npos || dash + 1 == scenario.size() ||
      scenario.find_first_not_of("0123456789", dash + 1) != std::string::npos)
    return std::nullopt;
  return std::pair(scenario.substr(0, dash), scenario.substr(dash + 1));
}

}  // namespace

std::string csv_table(const Merged& merged) {
  std::string text;
  const auto line = [&](const auto& row, const auto& field) {
    std::string joined;
    for (const auto& column : row) joined += (joined.empty() ? "" : ",") + csv_field(field(column));
    text += joined + "\n";
  };
  line(columns(merged, {}, {}), [](const auto& column) { return std::string(column.first); });
  for_each_row(merged, [&](const auto& row) {
    line(row, [](const auto& column) { return text_of(column.second); });
  });
  return text;
}

std::string jsonl_table(const Merged& merged) {
  std::string text;
  for_each_row(merged, [&](const auto& row) {
    Json json;
    for (const auto& [name, value] : row) json[name] = value;
    text += json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
  });
  return text;
}

std::string tracker_table(const Merged& merged) {
  struct Best {
    std::optional<std::int64_t> bound;
    std::optional<std::size_t> plan;  // The job that has it.
  };
  std::map<std::string, Best> instances;
  std::vector<std::string> order;
  for (std::size_t job = 0; job < merged.rows.size(); ++job) {
    const Job& asked = merged.list.jobs[job];
    if (!merged.rows[job] || asked.objective != Objective::sum_of_costs) continue;
    if (!asked.share_goals.empty() || !asked.variant.empty())
      continue;  // Another problem than the tracker's.
    const Row& row = *merged.rows[job];
    const auto [at, is_new] = instances.try_emplace(asked.instance_id);
    if (is_new) order.push_back(asked.instance_id);
    Best& best = at->second;
    if (row.exact_bound && (!best.bound || *row.exact_bound > *best.bound))
      best.bound = row.exact_bound;
    const bool has_plan = row.exact_cost && merged.motions.contains(job);
    if (has_plan && (!best.plan || *row.exact_cost < *merged.rows[*best.plan]->exact_cost))
      best.plan = job;
  }
  std::string text = "map_name,scen_type,type_id,agents,lower_cost,solution_cost,solution_plan\n";
  for (const std::string& id : order) {
    const Best& best = instances[id];
    if (!best.plan || !best.bound) continue;
    const Job& job = merged.list.jobs[*best.plan];
    const auto type = scenario_type(job.scenario);
    if (!type) continue;
    text += fmt::format("{},{},{},{},{},{},\"{}\"\n", csv_field(job.family), csv_field(type->first),
                        type->second, job.agents, *best.bound, *merged.rows[*best.plan]->exact_cost,
                        merged.motions.at(*best.plan));
  }
  return text;
}

}  // namespace quadrille::cli::campaign
