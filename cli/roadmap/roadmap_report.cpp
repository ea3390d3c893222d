// SPDX-License-Identifier: MIT
#include "roadmap/roadmap_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <variant>

#include "answers/report.hpp"
#include "asked/request_json.hpp"
#include "quadrille/continuous/duration_error.hpp"
#include "quadrille/continuous/plan_files.hpp"
#include "quadrille/continuous/quantise.hpp"

namespace quadrille::cli {
namespace {

using continuous::in_input_units;
using continuous::Instance;
using continuous::SolveOutcome;
using continuous::VerifyReport;

/// What an answer says exactly, in two lines.
std::string claim(const Instance* instance, const char* separator) {
  const bool has_polygons =
      instance != nullptr &&
      std::any_of(instance->agents().begin(), instance->agents().end(), [](const auto& agent) {
        return std::holds_alternative<continuous::ConvexPolygon>(agent.body);
      });
  std::string text = fmt::format(
      "exact in ticks and length units: coordinates and durations rounded to the nearest,{}"
      "radii down{}; departures at whole ticks; touching allowed",
      separator, has_polygons ? ", corners of polygons towards zero" : "");
  if (instance != nullptr && !instance->parked_pairs().empty())
    text += fmt::format(
        ";{}{} pairs of agents overlap at their starts, until one of the two has made its first "
        "move",
        separator, instance->parked_pairs().size());
  return text;
}

Json body_json(const continuous::Body& body, const continuous::Resolution& resolution) {
  Json json;
  if (const auto* disc = std::get_if<continuous::Disc>(&body)) {
    json["radius"] = in_input_units(disc->radius, resolution);
    return json;
  }
  for (const auto& corner : std::get<continuous::ConvexPolygon>(body).vertices())
    json["polygon"].push_back(
        {in_input_units(corner.x, resolution), in_input_units(corner.y, resolution)});
  return json;
}

std::optional<continuous::Clearance> least_clearance(const VerifyReport& check) {
  if (check.clearances.empty()) return std::nullopt;
  return check.clearances.front();
}

/// To a thousandth of a unit of this size; the digits after that are noise.
double rounded(double units, double size) {
  return in_input_units(Cost{std::llround(units * 1e3)}, size / 1e3);
}

Json resolution_json(const continuous::Resolution& resolution) {
  if (resolution.is_uniform()) return resolution.length;
  return {{"length", resolution.length}, {"time", resolution.time}};
}

Json options_json(const SolveArguments& arguments, const continuous::SolveOptions& options) {
  Json json;
  if (arguments.roadmap.headings) {
    json["map"] = text_or_null(arguments.input.map);
    json["scen"] = text_or_null(arguments.input.scen);
    json["headings"] = *arguments.roadmap.headings;
    json["turn"] = arguments.roadmap.turn.value_or(1);
  }
  json["roadmap"] = text_or_null(arguments.roadmap.roadmap);
  json["task"] = text_or_null(arguments.roadmap.task);
  json["agents"] = or_null(arguments.input.agents);
  json["instance"] = text_or_null(arguments.input.instance);
  json["passable"] = arguments.input.letters.passable;
  json["blocked"] = arguments.input.letters.blocked;
  json["radius"] = or_null(arguments.roadmap.radius);
  json["speed"] = or_null(arguments.roadmap.speed);
  json["neighbourhood"] = or_null(arguments.roadmap.neighbourhood);
  json["resolution"] = or_null(arguments.roadmap.resolution);
  json["objective"] = to_string(options.objective);
  json["system"] = to_string(options.system);
  add_request(json, arguments, options);
  return json;
}

/// One body, or those by shape.
Json bodies_json(const continuous::Agent& agent, const continuous::Resolution& resolution) {
  Json first = body_json(agent.body, resolution);
  if (agent.shapes.empty()) return first;
  Json all = Json::array({std::move(first)});
  for (const continuous::Body& body : agent.shapes) all.push_back(body_json(body, resolution));
  return all;
}

}  // namespace

std::string result_json(const Instance* instance, const SolveArguments& arguments,
                        const continuous::SolveOptions& options, const SolveOutcome& outcome,
                        const VerifyReport& check, const SearchNotes& notes) {
  const auto resolution = instance != nullptr ? instance->resolution() : continuous::Resolution(1);
  const bool has_bound = outcome.status != Status::infeasible;
  const auto time = [&](Cost ticks) { return Json(in_input_units(ticks, resolution)); };
  ResultJson json(outcome.status, options.objective);
  json.add("cost", outcome.cost ? time(*outcome.cost) : Json(nullptr));
  json.add("cost_ticks", or_null(outcome.cost));
  json.add("lower_bound", has_bound ? time(outcome.lower_bound) : Json(nullptr));
  json.add("lower_bound_ticks", has_bound ? Json(outcome.lower_bound) : Json(nullptr));
  json.add_gap(outcome);
  if (arguments.known_bound) json.add("rests_on_known_bound", outcome.rests_on_known_bound);
  json.add("resolution", instance != nullptr ? resolution_json(resolution) : Json(nullptr));
  json.add("claim", claim(instance, " "));
  json.add_end_of_search(outcome);
  json.add("agents", instance != nullptr ? Json(instance->num_agents()) : Json(nullptr));
  if (options.explain && instance != nullptr)
    add_explanation(json, outcome.attribution, notes.reasons, names_of(*instance));
  Json bodies;  // null
  if (instance != nullptr) {
    bodies = Json::array();
    for (const continuous::Agent& agent : instance->agents())
      bodies.push_back(bodies_json(agent, resolution));
  }
  json.add("bodies", bodies);
  const auto error =
      instance != nullptr ? continuous::largest_duration_error(*instance) : std::nullopt;
  json.add("duration_error", error ? Json(error->relative) : Json(nullptr));
  json.add("least_clearance", outcome.plan ? clearance_json(*instance, check) : Json(nullptr));
  if (!notes.second_opinion.is_null()) json.add("second_opinion", notes.second_opinion);
  if (options.proof)
    json.add("proof", proof_json(outcome, [&](const std::optional<Cost>& ticks) {
               return Json{{"claim", ticks ? time(*ticks) : Json(nullptr)},
                           {"claim_ticks", or_null(ticks)},
                           {"without", {"bounds of joint search", "bounds of routes"}}};
             }));
  if (arguments.history) add_history(json, notes.history);
  return json.finish(outcome.statistics, options.seed, options_json(arguments, options),
                     outcome.plan ? plan_to_json(*instance, *outcome.plan) : "null");
}

Json clearance_json(const Instance& instance, const VerifyReport& check) {
  const auto least = least_clearance(check);
  return least ? Json(rounded(least->gap, instance.resolution().length)) : Json(nullptr);
}

Names names_of(const Instance& instance) {
  Names names;
  names.vertex = [](VertexId v) { return "vertex " + std::to_string(v.index()); };
  names.vertex_json = [](VertexId v) { return Json(v.index()); };
  names.cost = [&instance](Cost ticks) {
    return fmt::format("{}", in_input_units(ticks, instance.resolution()));
  };
  names.has_timesteps = false;
  return names;
}

std::string describe_clearance(const Instance& instance, const VerifyReport& check) {
  const auto least = least_clearance(check);
  if (!least) return "";
  const continuous::Resolution& resolution = instance.resolution();
  return fmt::format("least clearance {}, between agents {} and {} at {}",
                     rounded(least->gap, resolution.length), least->agent.index(),
                     least->other.index(), rounded(least->tick, resolution.time));
}

std::string describe_check(const Instance& instance, const VerifyReport& check) {
  const continuous::Resolution& resolution = instance.resolution();
  std::string text = fmt::format("verified   {} agents, makespan {}, sum of costs {}, ",
                                 instance.num_agents(), in_input_units(check.makespan, resolution),
                                 in_input_units(check.sum_of_costs, resolution));
  const std::string clearance = describe_clearance(instance, check);
  return text + "no violations\n" + (clearance.empty() ? "" : "           " + clearance + "\n");
}

std::string describe_outcome(const Instance& instance, Objective objective,
                             const SolveOutcome& outcome, const VerifyReport& check) {
  std::string text = describe_result(outcome, objective, [&](Cost ticks) {
    return fmt::format("{}", in_input_units(ticks, instance.resolution()));
  });
  if (outcome.plan) text += describe_check(instance, check);
  if (outcome.plan || outcome.status == Status::infeasible)
    text += fmt::format("claim      {}\n", claim(&instance, "\n           "));
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
  const auto time = [&](auto ticks) { return in_input_units(ticks, instance.resolution()); };
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
