// SPDX-License-Identifier: MIT
#include "exports/orders.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "exports/exports.hpp"
#include "quadrille/continuous/quantise.hpp"
#include "quadrille/execution/node_order.hpp"
#include "quadrille/execution/releaser.hpp"

namespace quadrille::cli {
namespace {

using continuous::Instance;
using continuous::Path;
using Json = nlohmann::ordered_json;

Json order_message(const Instance& instance, AgentId agent, const Path& path,
                   const OrderState& state) {
  const double length = instance.resolution().length, time = instance.resolution().time;
  Json nodes = Json::array(), edges = Json::array();
  for (std::size_t k = state.first; k < path.size(); ++k) {
    const auto& p = instance.roadmap().position(path[k].vertex);
    nodes.push_back({{"nodeId", fmt::format("v{}", path[k].vertex.value())},
                     {"sequenceId", 2 * k},
                     {"released", k <= state.released},
                     {"nodePosition",
                      {{"x", continuous::in_input_units(p.x, instance.resolution())},
                       {"y", continuous::in_input_units(p.y, instance.resolution())},
                       {"mapId", "map"}}},
                     {"actions", Json::array()}});
    if (k + 1 == path.size()) break;
    const auto& q = instance.roadmap().position(path[k + 1].vertex);
    const double way = std::hypot(static_cast<double>((q.x - p.x).value()),
                                  static_cast<double>((q.y - p.y).value())) *
                       length;
    Json edge = {
        {"edgeId", fmt::format("v{}-v{}", path[k].vertex.value(), path[k + 1].vertex.value())},
        {"sequenceId", 2 * k + 1},
        {"released", k < state.released}};
    if (way > 0)
      edge["maximumSpeed"] =
          way / (static_cast<double>((path[k + 1].arrive - path[k].depart).value()) * time);
    edge["actions"] = Json::array();
    edges.push_back(edge);
  }
  return {{"headerId", state.update},
          {"timestamp", "1970-01-01T00:00:00.000Z"},
          {"version", "3.0.0"},
          {"manufacturer", "quadrille"},
          {"serialNumber", order_name(agent)},
          {"orderId", order_name(agent)},
          {"orderUpdateId", state.update},
          {"nodes", nodes},
          {"edges", edges}};
}

}  // namespace

std::string order_name(AgentId agent) { return fmt::format("agent{}", agent.value()); }

std::string export_order(const Instance& instance, AgentId agent, const Path& path,
                         const OrderState& state) {
  return order_message(instance, agent, path, state).dump();
}

std::string export_orders(const Instance& instance, const continuous::Plan& plan,
                          const execution::Precedences& order) {
  const execution::Releaser releaser(order);
  JsonLines lines;
  for (const AgentId agent : instance.agent_ids())
    lines.add(export_order(instance, agent, plan.paths[agent], {0, releaser.released(agent), 0}));
  return lines.text();
}

std::vector<std::string> describe_lock_up(const execution::Precedences& order) {
  const execution::NodeOrder nodes = execution::node_order(order);
  std::vector<std::string> lines;
  for (std::size_t k = 0; k < nodes.cycle.size(); ++k) {
    const execution::MoveId& leader = nodes.cycle[k == 0 ? nodes.cycle.size() - 1 : k - 1];
    const execution::MoveId& follower = nodes.cycle[k];
    if (leader.agent == follower.agent) continue;  // Its own next move.
    const execution::TimedMove &led = order.at(follower), &leads = order.at(leader);
    lines.push_back(
        fmt::format("{} waits at v{}, on its way to v{}, for {} to come from v{} to v{}",
                    order_name(follower.agent), led.from.value(), led.to.value(),
                    order_name(leader.agent), leads.from.value(), leads.to.value()));
  }
  if (nodes.num_knots > 1)
    lines.push_back(fmt::format("and so on: {} moves wait in {} separate circles",
                                nodes.num_knotted_moves, nodes.num_knots));
  return lines;
}

}  // namespace quadrille::cli
