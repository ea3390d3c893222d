// SPDX-License-Identifier: MIT
#include "solve_roadmap.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "output.hpp"
#include "quadrille/continuous/plan_files.hpp"
#include "quadrille/continuous/verify.hpp"
#include "signals.hpp"

namespace quadrille::cli {
namespace {

using continuous::Instance;
using continuous::Path;
using continuous::Plan;
using continuous::SolveOutcome;
using Json = nlohmann::ordered_json;

constexpr const char* kClaim =
    "exact for the instance in ticks and length units: durations rounded to the nearest tick, "
    "radii rounded down, departures at whole ticks, touching allowed";

double in_time(const Instance& instance, Cost ticks) {
  return static_cast<double>(ticks) * instance.resolution();
}

Json plan_json(const RoadmapInput& input, const Plan& plan) {
  Json paths = Json::array();
  for (const Path& path : plan.paths) {
    Json stops = Json::array();
    for (std::size_t k = 0; k < path.size(); ++k) {
      Json stop = {{"vertex", path[k].vertex.index()}};
      if (input.grid) {
        stop["row"] = input.grid->cell(path[k].vertex).row;
        stop["column"] = input.grid->cell(path[k].vertex).column;
      }
      stop["arrive"] = in_time(input.instance, path[k].arrive);
      stop["arrive_ticks"] = path[k].arrive;
      if (k + 1 < path.size()) {
        stop["depart"] = in_time(input.instance, path[k].depart);
        stop["depart_ticks"] = path[k].depart;
      }
      stops.push_back(std::move(stop));
    }
    paths.push_back(std::move(stops));
  }
  return paths;
}

std::optional<continuous::Clearance> least_clearance(const continuous::VerifyReport& report) {
  const auto least = std::min_element(report.clearances.begin(), report.clearances.end(),
                                      [](const auto& a, const auto& b) { return a.gap < b.gap; });
  if (least == report.clearances.end()) return std::nullopt;
  return *least;
}

std::string result_json(const RoadmapInput& input, const RoadmapSolveRequest& request,
                        const SolveOutcome& outcome, const continuous::VerifyReport& report) {
  const Instance& instance = input.instance;
  Json json;
  json["status"] = to_string(outcome.status);
  json["objective"] = to_string(request.options.objective);
  json["cost"] = outcome.cost ? Json(in_time(instance, *outcome.cost)) : Json();
  json["cost_ticks"] = outcome.cost ? Json(*outcome.cost) : Json();
  json["lower_bound"] = in_time(instance, outcome.lower_bound);
  json["lower_bound_ticks"] = outcome.lower_bound;
  json["agents"] = instance.num_agents();
  json["resolution"] = instance.resolution();
  json["claim"] = kClaim;
  Json radii = Json::array();
  for (const auto& agent : instance.agents())
    radii.push_back(static_cast<double>(agent.radius) * instance.resolution());
  json["radii"] = std::move(radii);
  json["explanation"] = outcome.explanation;
  const auto clearance = least_clearance(report);
  json["least_clearance"] = clearance ? Json(clearance->gap * instance.resolution()) : Json();
  json["plan"] = outcome.plan ? plan_json(input, *outcome.plan) : Json();
  const Statistics& s = outcome.statistics;
  json["statistics"] = {{"cpu_s", s.cpu_s},
                        {"wall_s", s.wall_s},
                        {"peak_rss_mib", s.peak_rss_mib},
                        {"sat_calls", s.sat_calls},
                        {"conflicts", s.conflicts},
                        {"decisions", s.decisions},
                        {"variables", s.variables},
                        {"clauses", s.clauses},
                        {"collision_clauses", s.collision_clauses},
                        {"checks", s.checks},
                        {"cores", s.cores}};
  json["version"] = QUADRILLE_VERSION;
  json["seed"] = request.options.seed;
  json["options"] = {{"system", to_string(request.options.system)},
                     {"roadmap", request.input.roadmap},
                     {"task", request.input.task}};
  return json.dump(1) + "\n";
}

std::string describe(const Instance& instance, const RoadmapSolveRequest& request,
                     const SolveOutcome& outcome, const continuous::VerifyReport& report) {
  std::string text = fmt::format("result     {}{}{}\n", to_string(outcome.status),
                                 outcome.explanation.empty() ? "" : ": ", outcome.explanation);
  if (outcome.cost)
    text += fmt::format("cost       {} {:.6f} ({} ticks)\n", to_string(request.options.objective),
                        in_time(instance, *outcome.cost), *outcome.cost);
  if (outcome.status != Status::infeasible)
    text += fmt::format("bound      {:.6f} ({} ticks) proven\n",
                        in_time(instance, outcome.lower_bound), outcome.lower_bound);
  text += fmt::format("search     {:.3f} s CPU, {} conflicts, {} cores, {} collision clauses\n",
                      outcome.statistics.cpu_s, outcome.statistics.conflicts,
                      outcome.statistics.cores, outcome.statistics.collision_clauses);
  if (outcome.plan) {
    text += "verified   no collisions";
    if (const auto clearance = least_clearance(report))
      text += fmt::format(", least clearance {:.6f} (agents {} and {})",
                          clearance->gap * instance.resolution(), clearance->agent.index(),
                          clearance->other.index());
    text += fmt::format("\nclaim      {}\n", kClaim);
  }
  return text;
}

Result<std::string> plan_text(const RoadmapInput& input, const std::string& file,
                              const SolveOutcome& outcome) {
  std::ostringstream text;
  const auto error =
      std::string_view(file).ends_with(".xml")
          ? write_ccbs_log(text, file, input.instance, *outcome.plan,
                           input.grid ? &*input.grid : nullptr, outcome.statistics.cpu_s)
          : write_plan_json(text, file, *outcome.plan, input.instance.resolution());
  if (error) return *error;
  return text.str();
}

ExitCode exit_code(const SolveOutcome& outcome) {
  if (outcome.internal_error) return ExitCode::internal;
  switch (outcome.status) {
    case Status::optimal:
      return ExitCode::success;
    case Status::feasible:
      return ExitCode::feasible;
    case Status::infeasible:
      return ExitCode::infeasible;
    case Status::unknown:
      break;
  }
  return ExitCode::unknown;
}

bool probe(const std::string& path, std::optional<OutputFile>& file) {
  if (path.empty()) return true;
  auto probed = OutputFile::probe(path);
  if (probed)
    file = std::move(probed.value());
  else
    report_error(probed.error());
  return probed.has_value();
}

}  // namespace

ExitCode solve_roadmap(RoadmapSolveRequest request) {
  request.options.limits.interrupt = &catch_interrupts();
  const auto input = load_roadmap_input(request.input, request.agents);
  if (!input) {
    report_error(input.error());
    return ExitCode::bad_input;
  }
  std::optional<OutputFile> plan_file, json_file;
  if (!probe(request.plan, plan_file) || !probe(request.json, json_file)) return ExitCode::output;
  Console console(request.quiet, request.json == "-" || request.plan == "-");
  console.print(input->description);
  console.print(fmt::format("system     {}, objective {}, seed {}\n",
                            to_string(request.options.system), to_string(request.options.objective),
                            request.options.seed));
  const SolveOutcome outcome = continuous::solve(input->instance, request.options);
  if (outcome.internal_error)
    report_error({ErrorCode::internal, "internal check failed: " + outcome.internal_error->message,
                  outcome.internal_error->where});
  continuous::VerifyReport report;
  if (outcome.plan) report = continuous::verify(input->instance, *outcome.plan);
  bool is_written = true;
  if (plan_file && outcome.plan) {
    const auto text = plan_text(*input, request.plan, outcome);
    is_written = text && write_or_report(*plan_file, *text);
  } else if (plan_file) {
    console.print(fmt::format("plan       none; {} is not written\n", plan_file->path()));
  }
  if (json_file)
    is_written =
        write_or_report(*json_file, result_json(*input, request, outcome, report)) && is_written;
  console.print(describe(input->instance, request, outcome, report));
  if (console.failure() != 0) {
    report_write_failure("-", console.failure());
    is_written = false;
  }
  const ExitCode code = exit_code(outcome);
  return !is_written && code != ExitCode::internal ? ExitCode::output : code;
}

}  // namespace quadrille::cli
