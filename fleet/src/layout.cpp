// SPDX-License-Identifier: MIT
#include "quadrille/fleet/layout.hpp"

#include <utility>
#include <variant>

#include "map_file.hpp"
#include "quadrille/continuous/lif.hpp"

namespace quadrille::fleet {

Result<Layout> add_layout(RoadmapBuilder& roads, const std::filesystem::path& file,
                          const LayoutOptions& options) {
  auto reading = map_file_options(roads, options.speed);
  if (!reading) return reading.error();
  reading->level = options.layout;
  reading->vehicle_type = options.vehicle_type;
  reading->has_headings = true;
  auto read = continuous::read_lif(file, *reading);
  if (!read) return read.error();
  Layout layout;
  layout.vertices =
      add_roadmap(roads, std::get<continuous::Roadmap>(read->map), read->names.of_vertices);
  const auto place = [&](VertexId vertex) { return layout.vertices[vertex.index()]; };
  for (const auto& [name, vertex] : read->names.places)
    layout.stations.emplace_back(name, place(vertex));
  layout.headings = std::move(read->headings);
  for (continuous::HeadingRules::Lane& lane : layout.headings.lanes) {
    lane.from = place(lane.from);
    lane.to = place(lane.to);
  }
  for (auto& told : layout.headings.stands) told.place = place(told.place);
  for (auto& told : layout.headings.turns) told.place = place(told.place);
  layout.notes = std::move(read->notes);
  return layout;
}

}  // namespace quadrille::fleet
