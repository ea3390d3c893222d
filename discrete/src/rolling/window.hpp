// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "quadrille/core/ids.hpp"
#include "quadrille/discrete/plan.hpp"

namespace quadrille::discrete {

/// Where agents are from now on until some timesteps later: paths of one length without collisions,
/// by agent, and who is in which vertex when. Times count from now, and time goes on.
class Window {
 public:
  static constexpr std::uint32_t kNobody = UINT32_MAX;

  /// To begin with there is nothing but where the agents are, all in vertices of their own. Never
  /// longer than `most` timesteps, at least one. Memory: timesteps * (vertices + agents).
  Window(std::size_t num_vertices, std::span<const VertexId> places, Timestep most);

  [[nodiscard]] std::size_t num_agents() const noexcept { return num_agents_; }
  [[nodiscard]] Timestep length() const noexcept { return length_; }
  /// 0 <= t <= length.
  [[nodiscard]] VertexId at(AgentId agent, Timestep t) const {
    return places_[slot(t) * num_agents_ + agent.index()];
  }
  /// By agent.
  [[nodiscard]] std::span<const VertexId> configuration(Timestep t) const {
    return std::span(places_).subspan(slot(t) * num_agents_, num_agents_);
  }
  /// An agent, or kNobody.
  [[nodiscard]] std::uint32_t who(VertexId vertex, Timestep t) const {
    return occupants_[slot(t) * num_vertices_ + vertex.index()];
  }
  /// Whether nobody is in the way of a move, or of waiting, that ends at t + 1 < = length.
  [[nodiscard]] bool is_free(VertexId from, VertexId to, Timestep t) const {
    if (who(to, t + 1) != kNobody) return false;
    const std::uint32_t other = who(to, t);
    return other == kNobody || who(from, t + 1) != other;
  }

  /// One timestep more. Requires a configuration that can follow the last one, and room.
  void push(std::span<const VertexId> configuration);
  /// What was at 1 is at 0. Requires a length of at least one.
  void pop();
  /// The agent is in nobody's way, until it is put back.
  void take_out(AgentId agent);
  /// Requires an agent that was taken out, and a path of this length that collides with nobody's.
  void put(AgentId agent, const Path& path);
  [[nodiscard]] Path path(AgentId agent) const;

 private:
  [[nodiscard]] std::size_t slot(Timestep t) const {
    const std::size_t at = first_ + static_cast<std::size_t>(t);
    return at < num_slots_ ? at : at - num_slots_;
  }

  const std::size_t num_vertices_, num_agents_, num_slots_;
  std::size_t first_ = 0;  // Slot of time 0.
  Timestep length_ = 0;
  std::vector<VertexId> places_;          // By slot, then agent.
  std::vector<std::uint32_t> occupants_;  // By slot, then vertex.
};

}  // namespace quadrille::discrete
