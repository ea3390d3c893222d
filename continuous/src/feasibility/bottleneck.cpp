// SPDX-License-Identifier: MIT
#include "feasibility/bottleneck.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>

namespace quadrille::continuous {
namespace {

constexpr std::size_t kNamed = 12;

/// A way of few moves to some goal that leaves out one vertex; empty if there is none.
std::vector<VertexId> find_way(const Instance& instance, AgentId agent,
                               std::optional<VertexId> left_out) {
  const Roadmap& roadmap = instance.roadmap();
  const VertexId start = instance.agent(agent).start;
  const Goals& goals = instance.agent(agent).goals;
  IdVector<VertexId, std::optional<VertexId>> before(roadmap.num_vertices());
  std::vector<VertexId> queue{start};
  before[start] = start;
  std::size_t at = 0;
  for (; at < queue.size() && !goals.contains(queue[at]); ++at)
    for (const EdgeId e : roadmap.out_edges(queue[at])) {
      const VertexId w = roadmap.to(e);
      if (before[w] || w == left_out) continue;
      before[w] = queue[at];
      queue.push_back(w);
    }
  if (at == queue.size()) return {};
  std::vector<VertexId> way{queue[at]};
  while (way.back() != start) way.push_back(*before[way.back()]);
  std::reverse(way.begin(), way.end());
  return way;
}

}  // namespace

std::vector<VertexId> inevitable_vertices(const Instance& instance, AgentId agent) {
  const std::vector<VertexId> way = find_way(instance, agent, std::nullopt);
  std::vector<VertexId> inevitable;
  for (const VertexId v : way)
    if (v == way.front() || find_way(instance, agent, v).empty()) inevitable.push_back(v);
  return inevitable;
}

std::vector<VertexId> find_bottleneck(const Instance& instance,
                                      const std::vector<AgentId>& agents) {
  std::vector<VertexId> common = inevitable_vertices(instance, agents.front());
  for (auto other = agents.begin() + 1; other != agents.end(); ++other) {
    const std::vector<VertexId> order = inevitable_vertices(instance, *other);
    std::erase_if(common, [&](VertexId v) {
      return std::find(order.begin(), order.end(), v) == order.end();
    });
  }
  return common;
}

std::string describe_bottleneck(const Instance& instance, const std::vector<AgentId>& agents,
                                const std::vector<VertexId>& bottleneck) {
  const std::size_t count = bottleneck.size();
  if (count == 0) return "";
  std::string text = agents.size() == 2 ? "both have" : "all of them have";
  text += count == 1 ? " to pass vertex " : " to pass vertices ";
  for (std::size_t k = 0; k < std::min(count, kNamed); ++k) {
    if (k > 0) text += k + 1 == count ? " and " : ", ";
    text += std::to_string(bottleneck[k].index());
  }
  if (count > kNamed) text += " and " + std::to_string(count - kNamed) + " more";
  if (agents.size() != 2 || count == 1) return text;
  // The second of two comes to the same vertices in the same order or in the opposite one.
  const std::vector<VertexId> order = inevitable_vertices(instance, agents.back());
  if (std::find(order.begin(), order.end(), bottleneck.back()) <
      std::find(order.begin(), order.end(), bottleneck.front()))
    text += ", in opposite directions";
  return text;
}

}  // namespace quadrille::continuous
