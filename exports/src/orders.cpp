// SPDX-License-Identifier: MIT
#include "quadrille/exports/orders.hpp"

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "quadrille/continuous/quantise.hpp"
#include "quadrille/execution/node_order.hpp"
#include "quadrille/execution/releaser.hpp"
#include "quadrille/exports/exports.hpp"
#include "quadrille/exports/samples.hpp"

namespace quadrille::exports {
namespace {

using continuous::Instance;
using continuous::Stop;
using Json = nlohmann::ordered_json;

struct KnownVersion {
  std::string_view name, in_messages;
};
/// In the order of the enumeration.
constexpr std::array<KnownVersion, 3> kVersions = {
    {{"2.0", "2.0.0"}, {"2.1", "2.1.0"}, {"3.0", "3.0.0"}}};

/// The speed of a move, in units of length per unit of time; 0 if it only turns.
double speed_of(const Instance& instance, const Stop& from, const Stop& to) {
  const auto& p = instance.roadmap().position(from.vertex);
  const auto& q = instance.roadmap().position(to.vertex);
  const double way = std::hypot(static_cast<double>((q.x - p.x).value()),
                                static_cast<double>((q.y - p.y).value()));
  return way * instance.resolution().length /
         (static_cast<double>((to.arrive - from.depart).value()) * instance.resolution().time);
}

Json position(const Instance& instance, const Yaws* yaws, VertexId v, const std::string& map) {
  const auto& p = instance.roadmap().position(v);
  Json json = {{"x", continuous::in_input_units(p.x, instance.resolution())},
               {"y", continuous::in_input_units(p.y, instance.resolution())}};
  if (yaws != nullptr) json["theta"] = (*yaws)[v];
  json["mapId"] = map;
  return json;
}

}  // namespace

std::optional<VdaVersion> parse_vda_version(std::string_view text) noexcept {
  for (std::size_t k = 0; k < kVersions.size(); ++k)
    if (kVersions[k].name == text) return static_cast<VdaVersion>(k);
  return std::nullopt;
}

std::string OrderWriter::order(AgentId agent, const OrderState& state) const {
  const bool is_v2 = version_ != VdaVersion::v3_0;
  const continuous::Path& path = plan_.paths[agent];
  Json nodes = Json::array(), edges = Json::array();
  for (std::size_t k = state.first; k < path.size(); ++k) {
    const std::string& node = names_.nodes[path[k].vertex];
    nodes.push_back({{"nodeId", node},
                     {"sequenceId", 2 * k},
                     {"released", k <= state.released},
                     {"nodePosition", position(instance_, yaws_, path[k].vertex, names_.map)},
                     {"actions", Json::array()}});
    if (k + 1 == path.size()) break;
    const std::string& next = names_.nodes[path[k + 1].vertex];
    Json edge = {
        {"edgeId", node + "-" + next}, {"sequenceId", 2 * k + 1}, {"released", k < state.released}};
    if (is_v2) {
      edge["startNodeId"] = node;
      edge["endNodeId"] = next;
    }
    if (const double speed = speed_of(instance_, path[k], path[k + 1]); speed > 0)
      edge[is_v2 ? "maxSpeed" : "maximumSpeed"] = speed;
    edge["actions"] = Json::array();
    edges.push_back(edge);
  }
  return Json({{"headerId", state.update},
               {"timestamp", names_.time_stamp},
               {"version", kVersions[static_cast<std::size_t>(version_)].in_messages},
               {"manufacturer", names_.manufacturer},
               {"serialNumber", names_.robots[agent]},
               {"orderId", names_.orders[agent]},
               {"orderUpdateId", state.update},
               {"nodes", nodes},
               {"edges", edges}})
      .dump();
}

std::string OrderWriter::orders(const execution::Precedences& order_of_moves) const {
  const execution::Releaser releaser(order_of_moves);
  JsonLines lines;
  for (const AgentId agent : instance_.agent_ids())
    lines.add(order(agent, {0, releaser.released(agent), 0}));
  return lines.text();
}

std::vector<std::string> describe_lock_up(const execution::Precedences& order,
                                          const OrderNames& names) {
  const execution::NodeOrder nodes = execution::node_order(order);
  std::vector<std::string> lines;
  for (std::size_t k = 0; k < nodes.cycle.size(); ++k) {
    const execution::MoveId& leader = nodes.cycle[k == 0 ? nodes.cycle.size() - 1 : k - 1];
    const execution::MoveId& follower = nodes.cycle[k];
    if (leader.agent == follower.agent) continue;  // Its own next move.
    const execution::TimedMove &led = order.at(follower), &leads = order.at(leader);
    lines.push_back(names.robots[follower.agent] + " waits at " + names.nodes[led.from] +
                    ", on its way to " + names.nodes[led.to] + ", for " +
                    names.robots[leader.agent] + " to come from " + names.nodes[leads.from] +
                    " to " + names.nodes[leads.to]);
  }
  if (nodes.num_knots > 1)
    lines.push_back("and so on: " + std::to_string(nodes.num_knotted_moves) + " moves wait in " +
                    std::to_string(nodes.num_knots) + " separate circles");
  return lines;
}

}  // namespace quadrille::exports
