// SPDX-License-Identifier: MIT
#include "grid/grid_info.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <utility>
#include <vector>

#include "answers/graph_shape.hpp"
#include "frame/output.hpp"
#include "grid/grid_text.hpp"
#include "quadrille/discrete/feasibility.hpp"
#include "quadrille/input/grid.hpp"

namespace quadrille::cli {
namespace {

using discrete::Graph;
using discrete::GridMap;
using discrete::Instance;
using discrete::kUnreachable;

GraphShape shape_of(const Graph& graph) {
  GraphShape shape;
  IdVector<VertexId, bool> seen(graph.num_vertices(), false);
  std::vector<VertexId> queue;
  for (const VertexId root : IdRange<VertexId>(graph.num_vertices())) {
    ++shape.degrees[graph.neighbours(root).size()];
    if (seen[root]) continue;
    queue.assign(1, root);
    seen[root] = true;
    for (std::size_t head = 0; head < queue.size(); ++head)
      for (const VertexId next : graph.neighbours(queue[head]))
        if (!seen[next]) {
          seen[next] = true;
          queue.push_back(next);
        }
    shape.components.push_back(queue.size());
  }
  return shape;
}

/// The same of the 4-connected graph of a map, from its cells: a bit or two for each, and the cells
/// at the rim of the search.
class MapShape {
 public:
  explicit MapShape(const GridMap& map)
      : width_(static_cast<std::size_t>(map.width)), map_(map), rest_(map.passable) {}

  GraphShape run() {
    std::array<std::size_t, 5> degrees{};
    for (std::size_t cell = 0; cell < rest_.size(); ++cell) {
      if (map_.passable[cell]) {
        std::size_t degree = 0;
        for_neighbours(cell, [&](std::size_t next) { degree += map_.passable[next] ? 1u : 0u; });
        ++degrees[degree];
      }
      if (rest_[cell]) shape_.components.push_back(take_component(cell));
    }
    for (std::size_t degree = 0; degree < degrees.size(); ++degree)
      if (degrees[degree] > 0) shape_.degrees[degree] = degrees[degree];
    return std::move(shape_);
  }

 private:
  template <class Visit>
  void for_neighbours(std::size_t cell, const Visit& visit) const {
    const std::size_t column = cell % width_;
    if (cell >= width_) visit(cell - width_);
    if (column > 0) visit(cell - 1);
    if (column + 1 < width_) visit(cell + 1);
    if (cell + width_ < map_.passable.size()) visit(cell + width_);
  }

  std::size_t take_component(std::size_t root) {
    std::size_t size = 0;
    rim_.assign(1, static_cast<std::uint32_t>(root));
    rest_[root] = false;
    while (!rim_.empty()) {
      size += rim_.size();
      next_rim_.clear();
      for (const std::uint32_t cell : rim_)
        for_neighbours(cell, [&](std::size_t next) {
          if (!rest_[next]) return;
          rest_[next] = false;
          next_rim_.push_back(static_cast<std::uint32_t>(next));
        });
      std::swap(rim_, next_rim_);
    }
    return size;
  }

  const std::size_t width_;
  const GridMap& map_;
  std::vector<bool> rest_;  // Passable cells in no component yet.
  std::vector<std::uint32_t> rim_, next_rim_;
  GraphShape shape_;
};

/// What each agent needs when it is alone.
std::string describe_distances(const Instance& instance) {
  Cost sum = 0, largest = 0;
  std::size_t unreachable = 0;
  for (const discrete::Agent& task : instance.agents()) {
    const Timestep distance = distances_to_nearest(instance.graph(), task.goals)[task.start];
    if (distance == kUnreachable) {
      ++unreachable;
      continue;
    }
    sum += distance;
    largest = std::max<Cost>(largest, distance);
  }
  if (unreachable > 0)
    return fmt::format("distances  {} agents cannot reach their goal\n", unreachable);
  return fmt::format("distances  sum {}, largest {} (lower bounds of sum of costs, makespan)\n",
                     sum, largest);
}

ExitCode finish(const Console& console) {
  if (console.failure() == 0) return ExitCode::success;
  report_write_failure("-", console.failure());
  return ExitCode::output;
}

ExitCode print_map_info(const InputOptions& options) {
  const auto map = discrete::read_map(std::filesystem::path(options.map), options.letters);
  if (!map) {
    report_error(input::with_letters_hint(map.error()));
    return ExitCode::bad_input;
  }
  const GraphShape shape = MapShape(*map).run();
  std::size_t vertices = 0, ends = 0;
  for (const auto& [degree, count] : shape.degrees) vertices += count, ends += degree * count;
  Console console(false, false);
  console.print(fmt::format("map        {}: {} x {} grid, {} vertices, {} edges\n", options.map,
                            map->width, map->height, vertices, ends / 2));
  console.print(describe_letters(map->other_letters));
  console.print(describe_shape(shape));
  return finish(console);
}

}  // namespace

ExitCode print_grid_info(const InputOptions& options) {
  if (options.instance.empty() && options.scen.empty()) return print_map_info(options);
  const auto input = load_grid_input(options);
  if (!input) {
    report_error(input.error());
    return ExitCode::bad_input;
  }
  const Instance& instance = input->instance;
  Console console(false, false);
  console.print(describe_input(*input));
  console.print(describe_shape(shape_of(instance.graph())));
  console.print(describe_distances(instance));
  const discrete::Feasibility verdict = check_feasibility(instance);
  console.print(!instance.is_plain()  ? "feasible   not known: the instance has rules\n"
                : !verdict.is_decided ? "feasible   not known: too many choices of goals\n"
                : verdict.feasible    ? "feasible   yes, some plan exists\n"
                                      : fmt::format("feasible   no: {}\n", verdict.reason));
  return finish(console);
}

}  // namespace quadrille::cli
