// SPDX-License-Identifier: MIT
#include "quadrille/fleet/nav_graph.hpp"

#include <utility>
#include <variant>

#include "map_file.hpp"
#include "quadrille/continuous/nav_graph.hpp"

namespace quadrille::fleet {

Result<NavGraph> add_nav_graph(RoadmapBuilder& roads, const std::filesystem::path& file,
                               const NavGraphOptions& options) {
  auto reading = map_file_options(roads, options.speed);
  if (!reading) return reading.error();
  reading->level = options.level;
  auto read = continuous::read_nav_graph(file, *reading);
  if (!read) return read.error();
  const auto& graph = std::get<continuous::Roadmap>(read->map);
  // The reader's ids of vertices are their numbers.
  std::vector<std::string> names(graph.num_vertices());
  for (const auto& [name, vertex] : read->names.places) names[vertex.index()] = name;
  return NavGraph{add_roadmap(roads, graph, names), std::move(read->notes)};
}

}  // namespace quadrille::fleet
