// SPDX-License-Identifier: MIT
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "quadrille/input/roadmap.hpp"

namespace quadrille::input {

using continuous::GridRoadmap;

Result<RoadmapInput> as_roadmap(const GridInput& grid) {
  // A move of one cell takes 100 ticks at that speed.
  constexpr continuous::Resolution kSizes{0.01, 0.01};
  constexpr continuous::Length kRadius{35};
  constexpr int kNeighbourhood = 2;
  const auto& layout = grid.instance.graph().layout();
  const auto refuse = [&](const char* what) {
    return Error{ErrorCode::invalid_instance, what, {grid.source, 0}};
  };
  if (!layout) return refuse("a graph has no places, and robots need some: a grid, or a roadmap");
  if (auto error = refuse_rules(grid)) return *error;
  continuous::OccupancyGrid cells{layout->height(), layout->width(), {}};
  for (std::int32_t y = 0; y < cells.height; ++y)
    for (std::int32_t x = 0; x < cells.width; ++x)
      cells.passable.push_back(layout->vertex_at({x, y}).has_value());
  auto made = GridRoadmap::make(cells, kNeighbourhood, kRadius, kSizes);
  if (!made) return Error{made.error().code, made.error().message, {grid.source, 0}};
  const auto vertex = [&](VertexId v) {
    const discrete::Cell cell = layout->cell_of(v);
    return made->vertex({cell.x, cell.y}).value();
  };
  std::vector<continuous::Agent> agents;
  for (const discrete::Agent& agent : grid.instance.agents()) {
    continuous::Agent& robot = agents.emplace_back();
    robot.start = vertex(agent.start);
    std::vector<VertexId> goals;
    for (const VertexId goal : agent.goals.vertices()) goals.push_back(vertex(goal));
    robot.goals = Goals(std::move(goals));
    robot.body = continuous::Disc{kRadius};
    robot.speed = continuous::kUnitSpeed;
  }
  auto instance = continuous::Instance::make(made->roadmap(), std::move(agents), kSizes);
  if (!instance) return Error{instance.error().code, instance.error().message, {grid.source, 0}};
  RoadmapInput read{std::move(instance).value(), std::move(made).value()};
  read.source = grid.source;
  read.task_source = grid.task_source;
  read.rows = grid.rows;
  read.kind = std::to_string(cells.width) + " x " + std::to_string(cells.height) + " grid, ";
  read.names.agents = grid.names.agents;
  return read;
}

}  // namespace quadrille::input
