// SPDX-License-Identifier: MIT
#include "model/poses.hpp"

#include <vector>

namespace quadrille::discrete {

std::shared_ptr<const Graph> make_poses(const Graph& grid, Timestep turn) {
  const GridLayout& layout = *grid.layout();
  const std::size_t size = grid.num_vertices(), num_headings = kHeadings.size();
  const std::size_t first_turn = kParked + 1;
  const auto steps_within = static_cast<std::size_t>(turn) - 1;
  const auto pose = [&](std::size_t layer, VertexId v) {
    return VertexId(layer * size + v.index());
  };
  std::vector<Graph::Edge> arcs;
  for (const VertexId v : IdRange<VertexId>(size)) {
    for (const VertexId w : grid.neighbours(v)) {
      const Cell from = layout.cell_of(v), to = layout.cell_of(w);
      const auto ahead = static_cast<std::size_t>(heading_of_move(to.x - from.x, to.y - from.y));
      arcs.emplace_back(pose(ahead, v), pose(ahead, w));
      arcs.emplace_back(pose(ahead, v), pose(kParked, w));
    }
    for (const Heading from : kHeadings)
      for (const bool right : {false, true}) {
        const Heading to = right ? right_of(from) : left_of(from);
        const std::size_t begin = 2 * static_cast<std::size_t>(from) + (right ? 1 : 0);
        std::size_t layer = static_cast<std::size_t>(from);
        for (std::size_t k = 0; k < steps_within; ++k) {
          const std::size_t next = first_turn + begin * steps_within + k;
          arcs.emplace_back(pose(layer, v), pose(next, v));
          layer = next;
        }
        arcs.emplace_back(pose(layer, v), pose(static_cast<std::size_t>(to), v));
      }
  }
  const std::size_t num_layers = first_turn + 2 * num_headings * steps_within;
  return std::make_shared<const Graph>(Graph::make_directed(num_layers * size, arcs).value());
}

}  // namespace quadrille::discrete
