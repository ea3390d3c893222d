// SPDX-License-Identifier: MIT
#include "quadrille/fleet/nav_graph.hpp"

#include <utility>
#include <variant>

#include "quadrille/continuous/nav_graph.hpp"
#include "quadrille/continuous/quantise.hpp"

namespace quadrille::fleet {

Result<NavGraph> add_nav_graph(RoadmapBuilder& roads, const std::filesystem::path& file,
                               const NavGraphOptions& options) {
  const continuous::Resolution sizes(roads.resolution().length.value(),
                                     roads.resolution().time.value());
  const auto speed = continuous::quantise_speed(options.speed.value(), sizes);
  if (!speed)
    return Error{ErrorCode::out_of_range,
                 "a speed of " + to_string(options.speed) + " is not supported",
                 {}};
  auto read = continuous::read_nav_graph(file, {sizes, *speed, options.level});
  if (!read) return read.error();
  const auto& graph = std::get<continuous::Roadmap>(read->map);
  const auto metres = [&](continuous::Length length) {
    return Metres(continuous::in_input_units(length, sizes));
  };
  // The reader's ids of vertices are their numbers.
  std::vector<std::string> names(graph.num_vertices());
  for (const auto& [name, vertex] : read->names.places) names[vertex.index()] = name;
  NavGraph added;
  added.notes = std::move(read->notes);
  for (std::size_t v = 0; v < graph.num_vertices(); ++v) {
    const continuous::Point& p = graph.position(VertexId(v));
    added.vertices.push_back(roads.vertex({metres(p.x), metres(p.y), metres(p.z)}, names[v]));
  }
  for (const VertexId v : graph.no_waiting()) roads.no_waiting(added.vertices[v.index()]);
  for (const continuous::Edge& edge : graph.edges()) {
    LaneSpec spec;
    if (edge.speed_limit)
      spec.speed_limit =
          MetresPerSecond(continuous::speed_in_input_units(*edge.speed_limit, sizes));
    if (edge.duration) spec.duration = Seconds(continuous::in_input_units(*edge.duration, sizes));
    roads.lane(added.vertices[edge.from.index()], added.vertices[edge.to.index()], std::move(spec));
  }
  return added;
}

}  // namespace quadrille::fleet
