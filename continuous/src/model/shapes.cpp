// SPDX-License-Identifier: MIT
#include "model/shapes.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "quadrille/geometry/turning.hpp"

namespace quadrille::continuous {

std::vector<Body> bodies_of(const Agent& agent) {
  std::vector<Body> bodies{agent.body};
  bodies.insert(bodies.end(), agent.shapes.begin(), agent.shapes.end());
  return bodies;
}

Length reach_of(const Agent& agent) {
  Length reach = geometry::enclosing_radius(agent.body);
  for (const Body& body : agent.shapes) reach = std::max(reach, geometry::enclosing_radius(body));
  return reach;
}

std::optional<std::string> find_wrong_shape(const Roadmap& roadmap, const Agent& agent) {
  if (agent.shapes.empty()) return std::nullopt;
  if (agent.shapes.size() + 1 < roadmap.num_shapes())
    return " has shapes up to " + std::to_string(agent.shapes.size()) + ", but there is one " +
           std::to_string(roadmap.num_shapes() - 1) + " on the roadmap";
  for (std::size_t k = 0; k < agent.shapes.size(); ++k)
    if (geometry::enclosing_radius(agent.shapes[k]) < 1)
      return " has nothing in its shape " + std::to_string(k + 1);
  std::set<std::pair<ShapeId, ShapeId>> known;
  for (std::size_t e = 0; e < roadmap.num_edges(); ++e) {
    const Edge& edge = roadmap.edge(EdgeId(e));
    if (!edge.open_to.contains(agent.group)) continue;
    for (const VertexId end : {edge.from, edge.to}) {
      const ShapeId at = roadmap.shape(end);
      if (at == edge.shape || !known.emplace(edge.shape, at).second) continue;
      if (geometry::contains(agent.body_as(edge.shape), agent.body_as(at))) continue;
      return " sticks out: its shape " + std::to_string(at.index()) + " at vertex " +
             std::to_string(end.index()) + " is not inside of its shape " +
             std::to_string(edge.shape.index()) + " on edge " + std::to_string(e) +
             ", which begins or ends there";
    }
  }
  return std::nullopt;
}

}  // namespace quadrille::continuous
