// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "quadrille/core/limits.hpp"
#include "quadrille/discrete/instance.hpp"

namespace quadrille::discrete {

/// The number of moves from every vertex to every agent's goal. Immutable, to be shared by all who
/// search the same instance. Takes 2 bytes per agent and vertex on graphs with fewer than 65,535
/// vertices, 4 on larger ones.
class GoalDistances {
 public:
  /// One breadth-first search per agent: O(agents * (V + E)). Null when a limit was met.
  [[nodiscard]] static std::shared_ptr<const GoalDistances> make(const Instance& instance,
                                                                 LimitMonitor& limits);

  /// kUnreachable where there is no way.
  [[nodiscard]] Timestep operator()(AgentId agent, VertexId vertex) const {
    const std::size_t at = agent.index() * num_vertices_ + vertex.index();
    if (!large_.empty()) return large_[at];
    return small_[at] == kNoWay ? kUnreachable : Timestep{small_[at]};
  }

 private:
  static constexpr std::uint16_t kNoWay = UINT16_MAX;
  GoalDistances() = default;
  std::size_t num_vertices_ = 0;
  std::vector<std::uint16_t> small_;  // One of the two is empty.
  std::vector<Timestep> large_;
};

}  // namespace quadrille::discrete
