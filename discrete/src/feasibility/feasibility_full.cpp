// SPDX-License-Identifier: MIT
// Components without a free vertex: agents can only rotate along cycles and never cross a bridge,
// so that each block is a problem of its own.
#include <algorithm>
#include <numeric>

#include "feasibility/feasibility_parts.hpp"

namespace quadrille::discrete::feasibility {
namespace {

/// What decides which rearrangements the rotations of a block generate.
struct BlockShape {
  Local num_cycles = 0;      ///< Fundamental cycles of the search tree: tree path + back edge.
  bool even_cycle = false;   ///< One of them has even length.
  bool shared_edge = false;  ///< Two of them share an edge.
};

/// By the smallest vertex of the block.
std::vector<BlockShape> find_shapes(const Component& component) {
  const Local size = component.size();
  std::vector<BlockShape> shapes(size);
  std::vector<Local> depth(size, 0);
  for (Local v = 1; v < size; ++v) depth[v] = depth[component.parent[v]] + 1;
  // First differences, then the number of fundamental cycles over the edge above each vertex.
  std::vector<std::int64_t> cycles_above(size, 0);
  for (const auto& [v, ancestor] : component.back_edges) {
    BlockShape& shape = shapes[component.block[v]];
    ++shape.num_cycles;
    if ((depth[v] - depth[ancestor] + 1) % 2 == 0) shape.even_cycle = true;
    ++cycles_above[v];
    --cycles_above[ancestor];
  }
  for (Local v = size; v-- > 1;) {
    if (cycles_above[v] > 1) shapes[component.block[v]].shared_edge = true;
    cycles_above[component.parent[v]] += cycles_above[v];
  }
  return shapes;
}

/// Whether the agents of these vertices reach their goals by an odd permutation of the vertices.
bool is_odd(std::span<const Local> vertices, const Arrangement& start, const Arrangement& goal,
            std::vector<bool>& visited) {
  bool odd = false;
  for (const Local first : vertices) {
    std::size_t length = 0;
    for (Local v = first; !visited[v]; v = goal.vertex_of[start.agent_at[v]]) {
      visited[v] = true;
      ++length;
    }
    if (length > 0 && length % 2 == 0) odd = !odd;
  }
  return odd;
}

/// One that every way between vertices of two blocks uses: that above the lower block, if one is
/// below the other.
std::vector<Local> bridge_between(const Component& component, Local a, Local b) {
  const Local block = component.block[a];
  const bool is_below = b >= block && b < component.subtree_end[block];
  const Local lower = is_below ? component.block[b] : block;
  return {lower, component.parent[lower]};
}

/// All vertices, block after block, in increasing order inside each block.
std::vector<Local> sorted_by_block(const Component& component) {
  std::vector<Local> order(component.size());
  std::iota(order.begin(), order.end(), Local{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](Local a, Local b) { return component.block[a] < component.block[b]; });
  return order;
}

}  // namespace

std::optional<Obstruction> check_full(const Component& component, const Arrangement& start,
                                      const Arrangement& goal) {
  for (Local agent = 0; agent < component.agents.size(); ++agent) {
    const Local from = start.vertex_of[agent], to = goal.vertex_of[agent];
    if (component.block[from] != component.block[to])
      return Obstruction{
          "agent " + component.agent_name(agent) + " cannot get from " + component.name_of(from) +
              " to " + component.name_of(to) +
              ": their component has no free vertex, so that agents can only rotate along cycles, "
              "and no chain of cycles leads there",
          {agent},
          {from, to},
          Invariant::Kind::bridge,
          bridge_between(component, from, to)};
  }
  const std::vector<BlockShape> shapes = find_shapes(component);
  const std::vector<Local> order = sorted_by_block(component);
  std::vector<bool> visited(component.size(), false);
  for (auto first = order.begin(); first != order.end();) {
    const Local block = component.block[*first];
    const auto last =
        std::find_if(first, order.end(), [&](Local v) { return component.block[v] != block; });
    const std::span<const Local> vertices(first, last);
    const BlockShape& shape = shapes[block];
    first = last;
    if (shape.num_cycles == 1) {
      if (auto reason = check_cycle(component, vertices, start, goal)) return reason;
    } else if (!shape.shared_edge && !shape.even_cycle && is_odd(vertices, start, goal, visited)) {
      const Local agent = *std::min_element(
          vertices.begin(), vertices.end(),
          [&](Local a, Local b) { return start.agent_at[a] < start.agent_at[b]; });
      return Obstruction{
          "agent " + component.agent_name(start.agent_at[agent]) + " and the others around " +
              component.name_of(agent) +
              " cannot be rearranged as asked: no vertex is free there and all cycles have odd "
              "length, so that exchanging only two agents, or any other odd permutation, is "
              "impossible",
          {start.agent_at[agent]},
          {vertices.begin(), vertices.end()},
          Invariant::Kind::parity,
          {}};
    }
  }
  return std::nullopt;
}

}  // namespace quadrille::discrete::feasibility
