// SPDX-License-Identifier: MIT
#include "full_blocks.hpp"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "full_block.hpp"

namespace quadrille::pebbles {
namespace {

/// A block that is one cycle: as many rotations as it takes.
bool turn_cycle(const LocalGraph& graph, const std::vector<Local>& vertices, const Board& goal,
                Board& board) {
  Cycle cycle{vertices.front()};
  for (Local before = kNoLocal; cycle.size() < vertices.size();) {
    for (const Local w : graph.neighbours(cycle.back()))
      if (w != before && !graph.is_bridge(cycle.back(), w)) {
        before = cycle.back();
        cycle.push_back(w);
        break;
      }
  }
  const auto to = std::find(cycle.begin(), cycle.end(), goal.vertex_of(board.agent_at(cycle[0])));
  const auto forwards = static_cast<std::size_t>(to - cycle.begin());
  const bool is_short = 2 * forwards <= cycle.size();
  for (std::size_t k = is_short ? forwards : cycle.size() - forwards; k > 0; --k)
    turn_once(cycle, is_short, board);
  return std::all_of(cycle.begin(), cycle.end(),
                     [&](Local v) { return board.agent_at(v) == goal.agent_at(v); });
}

}  // namespace

bool rearrange_full_component(const LocalGraph& graph, const Board& goal, Board& board,
                              LimitMonitor& limits, std::int64_t& effort) {
  std::map<Local, std::vector<Local>> blocks;
  for (Local v = 0; v < graph.size(); ++v) blocks[graph.block(v)].push_back(v);
  for (auto& [name, vertices] : blocks) {
    const auto is_settled = [&](Local v) { return board.agent_at(v) == goal.agent_at(v); };
    if (std::all_of(vertices.begin(), vertices.end(), is_settled)) continue;
    const bool all_stay = std::all_of(vertices.begin(), vertices.end(), [&, block = name](Local v) {
      return graph.block(goal.vertex_of(board.agent_at(v))) == block;
    });
    if (!all_stay) return false;
    const bool is_cycle = std::all_of(vertices.begin(), vertices.end(), [&](Local v) {
      const auto near = graph.neighbours(v);
      return std::count_if(near.begin(), near.end(),
                           [&](Local w) { return !graph.is_bridge(v, w); }) == 2;
    });
    const bool done = is_cycle ? turn_cycle(graph, vertices, goal, board)
                               : FullBlock(graph, vertices).sort(goal, board, limits, effort);
    if (!done) return false;
  }
  return true;
}

}  // namespace quadrille::pebbles
