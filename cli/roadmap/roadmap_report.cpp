// SPDX-License-Identifier: MIT
#include "roadmap/roadmap_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "grid/report.hpp"
#include "quadrille/continuous/quantise.hpp"

namespace quadrille::cli {
namespace {

using continuous::in_input_units;
using continuous::Instance;
using continuous::SolveOutcome;
using continuous::VerifyReport;
using Json = nlohmann::ordered_json;

/// In two lines.
constexpr std::string_view kClaim[] = {
    "exact in ticks and length units: coordinates and durations rounded to the nearest,",
    "radii down; departures at whole ticks; touching allowed"};

std::optional<continuous::Clearance> least_clearance(const VerifyReport& check) {
  const auto least = std::min_element(check.clearances.begin(), check.clearances.end(),
                                      [](const auto& a, const auto& b) { return a.gap < b.gap; });
  if (least == check.clearances.end()) return std::nullopt;
  return *least;
}

/// To a thousandth of a length unit or a tick; the digits after that are noise.
double rounded(double units, double resolution) {
  return in_input_units(std::llround(units * 1e3), resolution / 1e3);
}

Json options_json(const RoadmapSolveRequest& request) {
  const continuous::SolveOptions& options = request.options;
  Json json;
  json["roadmap"] = text_or_null(request.roadmap.roadmap);
  json["task"] = text_or_null(request.roadmap.task);
  json["agents"] = or_null(request.input.agents);
  json["instance"] = text_or_null(request.input.instance);
  json["passable"] = request.input.letters.passable;
  json["blocked"] = request.input.letters.blocked;
  json["radius"] = or_null(request.roadmap.radius);
  json["speed"] = or_null(request.roadmap.speed);
  json["neighbourhood"] = or_null(request.roadmap.neighbourhood);
  json["resolution"] = or_null(request.roadmap.resolution);
  json["objective"] = to_string(options.objective);
  json["system"] = to_string(options.system);
  json["gap"] = or_null(options.gap_percent);
  json["seed"] = options.seed;
  json["time_limit"] = or_null(options.limits.wall_s);
  json["cpu_limit"] = or_null(options.limits.cpu_s);
  json["memory_limit"] = or_null(options.limits.memory_mib);
  json["conflict_limit"] = or_null(options.limits.conflicts);
  json["audit"] = options.debug.audit;
  json["known_plan"] = text_or_null(request.known_plan);
  return json;
}

}  // namespace

ExitCode exit_code(const SolveOutcome& outcome) {
  return outcome.internal_error ? ExitCode::internal : exit_code(outcome.status);
}

std::string result_json(const Instance* instance, const RoadmapSolveRequest& request,
                        const SolveOutcome& outcome, const VerifyReport& check) {
  const double resolution = instance != nullptr ? instance->resolution() : 1;
  const bool infeasible = outcome.status == Status::infeasible;
  const auto time = [&](Cost ticks) { return Json(in_input_units(ticks, resolution)); };
  std::string text = "{";
  const auto add = [&text](std::string_view key, const std::string& value) {
    text += fmt::format("{}\n  \"{}\": {}", text == "{" ? "" : ",", key, value);
  };
  add("quadrille", dump("result"));
  add("status", dump(to_string(outcome.status)));
  add("objective", dump(to_string(request.options.objective)));
  add("cost", outcome.cost ? dump(time(*outcome.cost)) : "null");
  add("cost_ticks", dump(or_null(outcome.cost)));
  add("lower_bound", infeasible ? "null" : dump(time(outcome.lower_bound)));
  add("lower_bound_ticks", infeasible ? "null" : dump(outcome.lower_bound));
  add("resolution", instance != nullptr ? dump(resolution) : "null");
  add("claim", dump(fmt::format("{} {}", kClaim[0], kClaim[1])));
  add("stop_reason", dump(to_string(outcome.stop)));
  add("explanation", dump(outcome.explanation));
  add("internal_error",
      outcome.internal_error ? dump(outcome.internal_error->to_string()) : "null");
  Json radii;  // null
  if (instance != nullptr) {
    radii = Json::array();
    for (const continuous::Agent& agent : instance->agents())
      radii.push_back(in_input_units(agent.radius, resolution));
  }
  add("agents", instance != nullptr ? dump(instance->num_agents()) : "null");
  add("radii", dump(radii));
  const auto clearance = least_clearance(check);
  add("least_clearance",
      outcome.plan && clearance ? dump(rounded(clearance->gap, resolution)) : "null");
  add("statistics", dump(statistics_json(outcome.statistics)));
  add("version", dump(QUADRILLE_VERSION));
  add("seed", dump(request.options.seed));
  add("options", dump(options_json(request)));
  add("plan", outcome.plan ? plan_to_json(*instance, *outcome.plan) : "null");
  return text + "\n}\n";
}

std::string describe_clearance(const Instance& instance, const VerifyReport& check) {
  const auto least = least_clearance(check);
  if (!least) return "";
  const double resolution = instance.resolution();
  return fmt::format("least clearance {}, between agents {} and {} at {}",
                     rounded(least->gap, resolution), least->agent.index(), least->other.index(),
                     rounded(least->tick, resolution));
}

std::string describe_check(const Instance& instance, const VerifyReport& check) {
  const double resolution = instance.resolution();
  std::string text = fmt::format("verified   {} agents, makespan {}, sum of costs {}, ",
                                 instance.num_agents(), in_input_units(check.makespan, resolution),
                                 in_input_units(check.sum_of_costs, resolution));
  const std::string clearance = describe_clearance(instance, check);
  return text + "no violations\n" + (clearance.empty() ? "" : "           " + clearance + "\n");
}

std::string describe_outcome(const Instance& instance, const RoadmapSolveRequest& request,
                             const SolveOutcome& outcome, const VerifyReport& check) {
  const Objective objective = request.options.objective;
  const auto time = [&](Cost ticks) { return in_input_units(ticks, instance.resolution()); };
  std::string text = fmt::format("result     {}", to_string(outcome.status));
  if (outcome.stop != StopReason::none)
    text += fmt::format(" (stopped: {})", to_string(outcome.stop));
  text += "\n";
  if (!outcome.explanation.empty()) text += fmt::format("why        {}\n", outcome.explanation);
  if (outcome.cost)
    text += fmt::format("cost       {} ({}), lower bound {}\n", time(*outcome.cost),
                        to_string(objective), time(outcome.lower_bound));
  else if (outcome.status == Status::unknown)
    text += fmt::format("cost       unknown ({}), lower bound {}\n", to_string(objective),
                        time(outcome.lower_bound));
  const Statistics& s = outcome.statistics;
  text += fmt::format("search     {:.2f} s, {} SAT calls, {} conflicts, {} collision clauses\n",
                      s.wall_s, s.sat_calls, s.conflicts, s.collision_clauses);
  if (outcome.plan) text += describe_check(instance, check);
  if (outcome.plan || outcome.status == Status::infeasible)
    text += fmt::format("claim      {}\n           {}\n", kClaim[0], kClaim[1]);
  return text;
}

std::string describe_refused(const SolveOutcome& outcome) {
  return fmt::format("result     {}\nwhy        {}\n", to_string(outcome.status),
                     outcome.explanation);
}

std::string list_paths(const Instance& instance, const continuous::Plan& plan) {
  constexpr std::size_t kMaxAgents = 26, kMaxStops = 60;
  const auto is_long = [](const continuous::Path& path) { return path.size() > kMaxStops; };
  if (plan.paths.size() > kMaxAgents || std::any_of(plan.paths.begin(), plan.paths.end(), is_long))
    return "\nThe plan is too large to be shown here; --plan FILE writes it.\n";
  if (plan.paths.empty()) return "";
  const auto time = [&](continuous::Ticks ticks) {
    return in_input_units(ticks, instance.resolution());
  };
  std::string text = "\nagent      cost  vertices (waits)\n";
  for (const AgentId i : instance.agent_ids()) {
    const continuous::Path& path = plan.paths[i];
    text += fmt::format("{:5} {:9}  ", i.index(), time(cost(path)));
    for (std::size_t k = 0; k < path.size(); ++k) {
      text += fmt::format("{}{}", k == 0 ? "" : " ", path[k].vertex.index());
      if (path[k].depart > path[k].arrive)
        text += fmt::format(" ({})", time(path[k].depart - path[k].arrive));
    }
    text += "\n";
  }
  return text;
}

}  // namespace quadrille::cli
