// SPDX-License-Identifier: MIT
#include "grid/report.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include "quadrille/discrete/plan_formats.hpp"

namespace quadrille::cli {
namespace {

using discrete::SolveOutcome;

Json options_json(const SolveRequest& request) {
  const discrete::SolveOptions& options = request.options;
  Json json;
  json["map"] = text_or_null(request.input.map);
  json["scen"] = text_or_null(request.input.scen);
  json["agents"] = or_null(request.input.agents);
  json["instance"] = text_or_null(request.input.instance);
  json["passable"] = request.input.letters.passable;
  json["blocked"] = request.input.letters.blocked;
  json["objective"] = to_string(options.objective);
  json["system"] = to_string(options.system);
  json["check"] = has_schedule(options.system) ? Json(to_string(options.mdd.check)) : Json(nullptr);
  json["cost_search"] = options.cost_search ? Json(to_string(*options.cost_search)) : Json(nullptr);
  json["mdd_growth"] = to_string(options.mdd.growth);
  json["forbid_first"] = options.lazy.forbid_first;
  json["backtracking"] = Json(nullptr);
  if (options.lazy.chronological)
    json["backtracking"] = *options.lazy.chronological ? "chronological" : "jump";
  json["first_plan"] = options.first_plan;
  json["gap"] = or_null(options.gap_percent);
  json["threads"] = options.threads;
  json["race"] = options.race;
  json["seed"] = options.seed;
  json["time_limit"] = or_null(options.limits.wall_s);
  json["cpu_limit"] = or_null(options.limits.cpu_s);
  json["memory_limit"] = or_null(options.limits.memory_mib);
  json["conflict_limit"] = or_null(options.limits.conflicts);
  json["audit"] = options.debug.audit;
  json["known_plan"] = text_or_null(request.known_plan);
  return json;
}

/// One agent per line: `text` is the plan on one line, a list of lists.
std::string break_lines(std::string_view text) {
  std::string broken;
  int depth = 0;
  bool agent_ended = false;
  for (const char c : text) {
    if (c == '[' && ++depth == 2) {
      // Whatever separates two agents on one line is replaced.
      if (agent_ended) broken.erase(broken.find_last_not_of(", ") + 1);
      broken += agent_ended ? ",\n    " : "\n    ";
    }
    if (c == ']' && depth-- == 2) agent_ended = true;
    if (c == ']' && depth == 0 && agent_ended) broken += "\n  ";
    broken += c;
  }
  return broken;
}

}  // namespace

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
  return json;
}

Json text_or_null(const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); }

std::string dump(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

bool has_schedule(discrete::System system) noexcept { return system == discrete::System::dpll_mdd; }

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

ExitCode exit_code(const SolveOutcome& outcome) {
  return outcome.internal_error ? ExitCode::internal : exit_code(outcome.status);
}

std::string result_json(const discrete::Instance& instance, const SolveRequest& request,
                        const SolveOutcome& outcome) {
  const bool infeasible = outcome.status == Status::infeasible;
  std::string text = "{";
  const auto add = [&text](std::string_view key, const std::string& value) {
    text += fmt::format("{}\n  \"{}\": {}", text == "{" ? "" : ",", key, value);
  };
  add("quadrille", dump("result"));
  add("status", dump(to_string(outcome.status)));
  add("objective", dump(to_string(request.options.objective)));
  add("cost", dump(or_null(outcome.cost)));
  add("lower_bound", infeasible ? "null" : dump(outcome.lower_bound));
  add("stop_reason", dump(to_string(outcome.stop)));
  add("explanation", dump(outcome.explanation));
  add("internal_error",
      outcome.internal_error ? dump(outcome.internal_error->to_string()) : "null");
  add("agents", dump(instance.num_agents()));
  add("statistics", dump(statistics_json(outcome.statistics)));
  add("version", dump(QUADRILLE_VERSION));
  add("seed", dump(request.options.seed));
  add("options", dump(options_json(request)));
  add("plan", outcome.plan ? break_lines(plan_to_json(instance.graph(), *outcome.plan)) : "null");
  return text + "\n}\n";
}

std::string describe_outcome(const SolveRequest& request, const SolveOutcome& outcome,
                             const discrete::VerifyReport* check) {
  const Objective objective = request.options.objective;
  std::string text = fmt::format("result     {}", to_string(outcome.status));
  if (outcome.stop != StopReason::none)
    text += fmt::format(" (stopped: {})", to_string(outcome.stop));
  text += "\n";
  if (!outcome.explanation.empty()) text += fmt::format("why        {}\n", outcome.explanation);
  if (outcome.cost)
    text += fmt::format("cost       {} ({}), lower bound {}\n", *outcome.cost, to_string(objective),
                        outcome.lower_bound);
  else if (outcome.status == Status::unknown)
    text += fmt::format("cost       unknown ({}), lower bound {}\n", to_string(objective),
                        outcome.lower_bound);
  const Statistics& s = outcome.statistics;
  text += fmt::format("search     {:.2f} s, {} SAT calls, {} conflicts, {} collision clauses\n",
                      s.wall_s, s.sat_calls, s.conflicts, s.collision_clauses);
  if (check != nullptr && check->valid())
    text += fmt::format("verified   {} agents, makespan {}, sum of costs {}, no violations\n",
                        outcome.plan->paths.size(), check->makespan, check->sum_of_costs);
  return text;
}

}  // namespace quadrille::cli
