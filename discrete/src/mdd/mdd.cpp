// SPDX-License-Identifier: MIT
#include "mdd/mdd.hpp"

#include <algorithm>

namespace quadrille::discrete {

Mdd::Mdd(const Graph& graph, const Agent& task)
    : task_(task),
      to_goal_(distances_to_nearest(graph, task.goals)),
      rank_(graph.num_vertices(), kNoRank),
      frontier_{{{task.start, 0}}} {
  QUADRILLE_REQUIRE(to_goal_[task.start] != kUnreachable, "the goal is reachable");
  if (!graph.is_directed()) return;
  for (const VertexId v : IdRange<VertexId>(graph.num_vertices()))
    for (const VertexId w : graph.neighbours(v))
      if (to_goal_[v] != kUnreachable && to_goal_[w] != kUnreachable)
        largest_step_ = std::max(largest_step_, 1 + to_goal_[w] - to_goal_[v]);
}

// Dijkstra's algorithm on the slack. With h fixed, the least slack of a vertex comes with its least
// distance from the start; a step adds 0 to largest_step() to the slack.
std::size_t Mdd::reach(const Graph& graph, Timestep slack) {
  QUADRILLE_REQUIRE(slack >= reached_, "layers are asked for in order");
  const auto most = static_cast<std::size_t>(slack + largest_step_) + 1;
  if (most > frontier_.size()) frontier_.resize(most);
  for (reached_ = std::max(0, reached_); reached_ <= slack; ++reached_) {
    auto& layer = frontier_[static_cast<std::size_t>(reached_)];
    for (std::size_t i = 0; i < layer.size(); ++i) {
      const auto [v, from_start] = layer[i];
      if (rank_[v] != kNoRank) continue;
      rank_[v] = static_cast<std::uint32_t>(found_.size());
      found_.push_back(v);
      for (const VertexId w : graph.neighbours(v))
        if (rank_[w] == kNoRank && to_goal_[w] != kUnreachable)
          frontier_[static_cast<std::size_t>(from_start + 1 + to_goal_[w] - distance())]
              .emplace_back(w, from_start + 1);
    }
    layer = {};
  }
  reached_ = slack;
  return found_.size();
}

}  // namespace quadrille::discrete
