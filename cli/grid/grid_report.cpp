// SPDX-License-Identifier: MIT
#include "grid/grid_report.hpp"

#include <fmt/format.h>

#include <string_view>

#include "answers/report.hpp"
#include "asked/request_json.hpp"
#include "quadrille/discrete/plan_formats.hpp"

namespace quadrille::cli {
namespace {

using discrete::SolveOutcome;

Json options_json(const SolveArguments& arguments) {
  const discrete::SolveOptions& options = arguments.options;
  Json json;
  json["map"] = text_or_null(arguments.input.map);
  json["scen"] = text_or_null(arguments.input.scen);
  json["agents"] = or_null(arguments.input.agents);
  json["instance"] = text_or_null(arguments.input.instance);
  json["passable"] = arguments.input.letters.passable;
  json["blocked"] = arguments.input.letters.blocked;
  json["objective"] = to_string(options.objective);
  json["system"] = to_string(options.system);
  json["check"] = has_schedule(options.system) ? Json(to_string(options.mdd.check)) : Json(nullptr);
  json["cost_search"] = options.cost_search ? Json(to_string(*options.cost_search)) : Json(nullptr);
  json["mdd_growth"] = to_string(options.mdd.growth);
  json["tie"] = to_string(options.tie);
  json["forbid_first"] = options.lazy.forbid_first;
  json["backtracking"] = Json(nullptr);
  if (options.lazy.chronological)
    json["backtracking"] = *options.lazy.chronological ? "chronological" : "jump";
  json["first_plan"] = options.first_plan;
  add_request(json, arguments, options);
  return json;
}

Json moves_json(const std::optional<discrete::Moves>& moves) {
  if (!moves) return nullptr;
  Json json;
  json["number"] = moves->number;
  json["lower_bound"] = moves->lower_bound;
  json["proved"] = moves->is_proved;
  return json;
}

std::string describe_moves(const discrete::Moves& moves) {
  const std::string text = fmt::format("moves      {}", moves.number);
  if (moves.is_proved) return text + ", no plan of this cost has fewer\n";
  return text + fmt::format(", plans of least cost have at least {}\n", moves.lower_bound);
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

bool has_schedule(discrete::System system) noexcept { return system == discrete::System::dpll_mdd; }

std::string result_json(const discrete::Instance* instance, const SolveArguments& arguments,
                        const SolveOutcome& outcome, const SearchNotes& notes) {
  const discrete::SolveOptions& options = arguments.options;
  const bool infeasible = outcome.status == Status::infeasible;
  ResultJson json(outcome.status, options.objective);
  json.add("cost", or_null(outcome.cost));
  json.add("lower_bound", infeasible ? Json(nullptr) : Json(outcome.lower_bound));
  json.add_gap(outcome);
  if (arguments.known_bound) json.add("rests_on_known_bound", outcome.rests_on_known_bound);
  if (options.tie != discrete::Tie::any) json.add("moves", moves_json(outcome.moves));
  json.add_end_of_search(outcome);
  json.add("agents", instance != nullptr ? Json(instance->num_agents()) : Json(nullptr));
  if (options.explain && instance != nullptr)
    add_explanation(json, outcome.attribution, notes.reasons, names_of(*instance));
  if (options.proof)
    json.add("proof", proof_json(outcome, [](const std::optional<Cost>& claim) {
               return Json{{"claim", or_null(claim)}};
             }));
  if (outcome.plan && outcome.plan->now > 0) json.add("now", outcome.plan->now);
  if (arguments.history) add_history(json, notes.history);
  return json.finish(
      outcome.statistics, options.seed, options_json(arguments),
      outcome.plan ? break_lines(plan_to_json(instance->graph(), *outcome.plan)) : "null");
}

Names names_of(const discrete::Instance& instance) {
  const discrete::Graph& graph = instance.graph();
  Names names;
  names.vertex = [&graph](VertexId v) { return vertex_name(graph, v); };
  names.vertex_json = [&graph](VertexId v) {
    if (!graph.layout()) return Json(v.index());
    const discrete::Cell cell = graph.layout()->cell_of(v);
    return Json{cell.x, cell.y};
  };
  names.cost = [](Cost cost) { return std::to_string(cost); };
  return names;
}

std::string describe_check(const discrete::Plan& plan, const discrete::VerifyReport& check) {
  return fmt::format("verified   {} agents, makespan {}, sum of costs {}, no violations\n",
                     plan.paths.size(), check.makespan, check.sum_of_costs);
}

std::string describe_outcome(Objective objective, const SolveOutcome& outcome,
                             const discrete::VerifyReport& check) {
  std::string text =
      describe_result(outcome, objective, [](Cost cost) { return fmt::format("{}", cost); });
  if (outcome.moves) text += describe_moves(*outcome.moves);
  return outcome.plan ? text + describe_check(*outcome.plan, check) : text;
}

}  // namespace quadrille::cli
