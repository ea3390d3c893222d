// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "answers/delivery.hpp"
#include "answers/report.hpp"
#include "commands/executing.hpp"
#include "frame/arguments.hpp"
#include "frame/subcommands.hpp"
#include "quadrille/execution/node_order.hpp"

namespace quadrille::cli {
namespace {

using execution::MoveId;
using execution::NodeOrder;
using execution::Precedence;
using execution::Precedences;
using execution::TimedMove;

constexpr const char* kFooter =
    "The order of the moves of a plan: who follows whom, and how closely (docs/execution.md). "
    "Exit\n"
    "code 1 where whole moves cannot be released one after the other, because that order has a\n"
    "cycle.\n"
    "\n"
    "Example:\n"
    "  quadrille execute-check --instance discs.json --json order.json plan.json\n"
    "\n";

std::string count(std::size_t number, const std::string& what) {
  return fmt::format("{} {}{}", number, what, number == 1 ? "" : "s");
}

std::string describe_order(const ExecutionCase& c, const NodeOrder& nodes) {
  std::size_t num_moves = 0;
  for (const auto& moves : c.order.moves) num_moves += moves.size();
  std::string text =
      fmt::format("moves      {} of {}\n", num_moves, count(c.order.num_agents(), "agent"));
  std::set<std::pair<AgentId, AgentId>> pairs;
  std::vector<Ticks> slacks;
  for (const Precedence& p : c.order.list) {
    pairs.emplace(std::min(p.leader.agent, p.follower.agent),
                  std::max(p.leader.agent, p.follower.agent));
    slacks.push_back(p.slack);
  }
  text += fmt::format("order      {} between {} of agents, {} of moves that overlap in time\n",
                      count(slacks.size(), "precedence"), count(pairs.size(), "pair"),
                      nodes.num_overlaps);
  if (slacks.empty()) return text;
  std::sort(slacks.begin(), slacks.end());
  return text + fmt::format("slack      least {}, median {}\n", c.time(slacks.front()),
                            c.time(slacks[slacks.size() / 2]));
}

std::string describe_nodes(const ExecutionCase& c, const NodeOrder& nodes) {
  if (nodes.acyclic()) return "nodes      no cycle: whole moves can be released one by one\n";
  std::string text = fmt::format(
      "nodes      {} in {}: released as a whole, these moves wait for each other for ever:\n",
      count(nodes.num_knotted_moves, "move"), nodes.num_knots == 1 ? "a cycle" : "cycles");
  for (std::size_t k = 0; k < nodes.cycle.size(); ++k) {
    const TimedMove& move = c.order.at(nodes.cycle[k]);
    text += fmt::format("           {}agent {} from {} to {}, {} to {}\n", k == 0 ? "" : "before ",
                        nodes.cycle[k].agent.value(), c.place(move.from), c.place(move.to),
                        c.time(move.begin), c.time(move.end));
  }
  return text + "           before the first one\n";
}

Json move_json(const MoveId& id) { return {{"agent", id.agent.value()}, {"move", id.move}}; }

/// One line per agent and precedence.
std::string order_json(const ExecutionCase& c, const NodeOrder& nodes) {
  Json cycle = Json::array();
  for (const MoveId& id : nodes.cycle) cycle.push_back(move_json(id));
  std::string text = fmt::format(
      "{{\n  \"quadrille\": \"precedences\",\n  \"version\": 1,\n  \"unit\": \"{}\",\n"
      "  \"tick\": {},\n  \"acyclic\": {},\n  \"cycle\": {},\n  \"overlaps\": {},\n  \"moves\": [",
      c.has_timesteps ? "timestep" : "tick", Json(c.tick).dump(), nodes.acyclic(), cycle.dump(),
      nodes.num_overlaps);
  const char* separator = "\n    ";
  for (const auto& path : c.order.moves) {
    Json moves = Json::array();
    for (const TimedMove& move : path) {
      moves.push_back({{"from", move.from.value()},
                       {"to", move.to.value()},
                       {"begin", move.begin.value()},
                       {"end", move.end.value()}});
      if (move.goes_on) moves.back()["goes_on"] = true;
    }
    text += separator + moves.dump();
    separator = ",\n    ";
  }
  text += "\n  ],\n  \"precedences\": [";
  separator = "\n    ";
  for (const Precedence& p : c.order.list) {
    text += separator + Json{{"leader", move_json(p.leader)},
                             {"follower", move_json(p.follower)},
                             {"slack", p.slack.value()}}
                            .dump();
    separator = ",\n    ";
  }
  return text + "\n  ]\n}\n";
}

ExitCode execute_check(const CLI::App& app, ExecutionArguments& arguments) {
  const auto loaded = load_execution(app, arguments);
  if (const auto* code = std::get_if<ExitCode>(&loaded)) return *code;
  const auto& c = std::get<ExecutionCase>(loaded);
  Delivery delivery(arguments.quiet, "", arguments.json);
  if (!delivery.probe()) return ExitCode::output;
  const NodeOrder nodes = node_order(c.order);
  if (delivery.has_json_file()) delivery.write_json(order_json(c, nodes));
  delivery.print_summary(c.description + describe_order(c, nodes) + describe_nodes(c, nodes), "");
  return delivery.finish(nodes.acyclic() ? ExitCode::success : ExitCode::violations);
}

}  // namespace

Subcommand add_execute_check(CLI::App& program) {
  CLI::App* app = program.add_subcommand(
      "execute-check", "Say who follows whom in a plan, and whether moves can be released whole");
  const auto arguments = std::make_shared<ExecutionArguments>();
  add_execution_options(*app, *arguments);
  app->footer(std::string(kFooter) + kExitCodesHelp);
  return {app, [app, arguments] { return execute_check(*app, *arguments); }};
}

}  // namespace quadrille::cli
