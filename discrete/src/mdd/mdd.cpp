// SPDX-License-Identifier: MIT
#include "mdd/mdd.hpp"

#include <algorithm>

namespace quadrille::discrete {

Mdd::Mdd(const Graph& graph, const Agent& task)
    : task_(task),
      to_goal_(distances_from(graph, task.goal())),
      rank_(graph.num_vertices(), kNoRank),
      frontier_{{{task.start, 0}}} {
  QUADRILLE_REQUIRE(to_goal_[task.start] != kUnreachable, "the goal is reachable");
}

// Dijkstra's algorithm on the slack. With h fixed, the least slack of a vertex comes with its least
// distance from the start; a step adds 0, 1 or 2 to the slack.
std::size_t Mdd::reach(const Graph& graph, Timestep slack) {
  QUADRILLE_REQUIRE(slack >= reached_, "layers are asked for in order");
  if (static_cast<std::size_t>(slack) + 3 > frontier_.size())
    frontier_.resize(static_cast<std::size_t>(slack) + 3);
  for (reached_ = std::max(0, reached_); reached_ <= slack; ++reached_) {
    auto& layer = frontier_[static_cast<std::size_t>(reached_)];
    for (std::size_t i = 0; i < layer.size(); ++i) {
      const auto [v, from_start] = layer[i];
      if (rank_[v] != kNoRank) continue;
      rank_[v] = static_cast<std::uint32_t>(found_.size());
      found_.push_back(v);
      for (const VertexId w : graph.neighbours(v))
        if (rank_[w] == kNoRank)
          frontier_[static_cast<std::size_t>(from_start + 1 + to_goal_[w] - distance())]
              .emplace_back(w, from_start + 1);
    }
    layer = {};
  }
  reached_ = slack;
  return found_.size();
}

}  // namespace quadrille::discrete
