// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "formats/octile.hpp"
#include "model/independent_groups.hpp"
#include "quadrille/core/random.hpp"
#include "quadrille/discrete/generator.hpp"

namespace quadrille::discrete {
namespace {

std::vector<VertexId> all_vertices(const Graph& graph) {
  std::vector<VertexId> vertices;
  vertices.reserve(graph.num_vertices());
  for (const VertexId v : IdRange<VertexId>(graph.num_vertices())) vertices.push_back(v);
  return vertices;
}

/// The number of the component of each vertex; components are numbered by their first vertex.
IdVector<VertexId, std::uint32_t> components(const Graph& graph, std::uint32_t& count) {
  const Grouping grouping = components_of(graph);
  IdVector<VertexId, std::uint32_t> component;
  count = 0;
  for (const VertexId v : IdRange<VertexId>(graph.num_vertices())) {
    const std::size_t first = grouping.root(v.index());
    component.push_back(first == v.index() ? count++ : component[VertexId(first)]);
  }
  return component;
}

/// Distinct goals, each in the component of its start. A component has room for as many goals as
/// it has starts, so this never fails.
std::vector<VertexId> reachable_goals(const Graph& graph, const std::vector<VertexId>& starts,
                                      Random& random) {
  std::uint32_t count = 0;
  const auto component = components(graph, count);
  std::vector<std::vector<VertexId>> pools(count);
  for (const VertexId v : IdRange<VertexId>(graph.num_vertices())) pools[component[v]].push_back(v);
  std::vector<std::size_t> wanted(count), taken(count);
  for (const VertexId start : starts) ++wanted[component[start]];
  for (std::uint32_t c = 0; c < count; ++c) random.shuffle_front(pools[c], wanted[c]);
  std::vector<VertexId> goals;
  for (const VertexId start : starts) {
    const std::uint32_t c = component[start];
    goals.push_back(pools[c][taken[c]++]);
  }
  return goals;
}

}  // namespace

Result<Scenario> random_scenario(const GridMap& map, std::size_t num_agents, std::uint64_t seed,
                                 const ScenarioOptions& options) {
  if (options.map_name.empty() || options.map_name.find_first_of(" \t\r\n") != std::string::npos)
    return Error{ErrorCode::out_of_range, "the name of the map is empty or has white space", {}};
  const Graph graph = map.graph();
  if (graph.num_vertices() < num_agents)
    return Error{ErrorCode::invalid_instance,
                 "the map has " + std::to_string(graph.num_vertices()) +
                     " passable cells, too few for " + std::to_string(num_agents) + " agents",
                 {}};
  Random random(seed);
  std::vector<VertexId> starts = all_vertices(graph);
  std::vector<VertexId> goals = starts;
  random.shuffle_front(starts, num_agents);
  starts.resize(num_agents);
  if (options.reachable)
    goals = reachable_goals(graph, starts, random);
  else
    random.shuffle_front(goals, num_agents);

  Scenario scenario;
  OctileDistance octile(map);
  for (std::size_t i = 0; i < num_agents; ++i) {
    ScenarioRow row;
    row.map = options.map_name;
    row.width = map.width;
    row.height = map.height;
    row.start = graph.layout()->cell_of(starts[i]);
    row.goal = graph.layout()->cell_of(goals[i]);
    const double length = octile.between(row.start, row.goal);
    row.optimal = std::isfinite(length) ? length : 0;
    row.bucket = static_cast<std::int64_t>(row.optimal / 4);
    scenario.rows.push_back(std::move(row));
  }
  return scenario;
}

}  // namespace quadrille::discrete
