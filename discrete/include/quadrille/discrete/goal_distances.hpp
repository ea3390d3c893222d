// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "quadrille/core/export.hpp"
#include "quadrille/core/limits.hpp"
#include "quadrille/discrete/instance.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::discrete {

/// The number of moves from every vertex to every agent's goal. Immutable, to be shared by all who
/// search the same instance. Takes 2 bytes per agent and vertex on graphs with fewer than 65,535
/// vertices, 4 on larger ones.
class GoalDistances {
 public:
  /// One breadth-first search per agent: O(agents * (V + E)). Null when a limit was met.
  [[nodiscard]] static std::shared_ptr<const GoalDistances> make(const Instance& instance,
                                                                 LimitMonitor& limits);

  /// The distances to one goal. Valid as long as the table.
  class Row {
   public:
    [[nodiscard]] Timestep operator[](VertexId vertex) const {
      if (small_ == nullptr) return large_[vertex.index()];
      return small_[vertex.index()] == kNoWay ? kUnreachable : Timestep{small_[vertex.index()]};
    }

   private:
    friend class GoalDistances;
    Row(const std::uint16_t* small, const Timestep* large) : small_(small), large_(large) {}
    const std::uint16_t* small_;  // One of the two is null.
    const Timestep* large_;
  };
  [[nodiscard]] Row row(AgentId agent) const {
    const std::size_t at = agent.index() * num_vertices_;
    return large_.empty() ? Row(small_.data() + at, nullptr) : Row(nullptr, large_.data() + at);
  }

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

QUADRILLE_API_END
