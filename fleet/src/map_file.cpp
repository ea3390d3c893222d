// SPDX-License-Identifier: MIT
#include "map_file.hpp"

#include <utility>

#include "conversions.hpp"
#include "quadrille/continuous/quantise.hpp"

namespace quadrille::fleet {

Result<continuous::MapFileOptions> map_file_options(const RoadmapBuilder& roads,
                                                    MetresPerSecond speed) {
  const continuous::Resolution sizes(roads.resolution().length.value(),
                                     roads.resolution().time.value());
  const auto most = continuous::quantise_speed(speed.value(), sizes);
  if (!most)
    return Error{
        ErrorCode::out_of_range, "a speed of " + to_string(speed) + " is not supported", {}};
  return continuous::MapFileOptions{sizes, *most};
}

std::vector<VertexId> add_roadmap(RoadmapBuilder& roads, const continuous::Roadmap& graph,
                                  const std::vector<std::string>& names) {
  const continuous::Resolution sizes(roads.resolution().length.value(),
                                     roads.resolution().time.value());
  std::vector<VertexId> added;
  for (std::size_t v = 0; v < graph.num_vertices(); ++v)
    added.push_back(roads.vertex(in_metres(graph.position(VertexId(v)), sizes), names[v]));
  for (const VertexId v : graph.no_waiting()) roads.no_waiting(added[v.index()]);
  for (const continuous::Edge& edge : graph.edges()) {
    LaneSpec spec;
    if (edge.speed_limit)
      spec.speed_limit =
          MetresPerSecond(continuous::speed_in_input_units(*edge.speed_limit, sizes));
    if (edge.duration) spec.duration = in_seconds(*edge.duration, sizes);
    roads.lane(added[edge.from.index()], added[edge.to.index()], std::move(spec));
  }
  return added;
}

}  // namespace quadrille::fleet
