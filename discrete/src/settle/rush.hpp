// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "model/component.hpp"
#include "pibt/pibt.hpp"
#include "quadrille/core/limits.hpp"
#include "quadrille/core/random.hpp"
#include "quadrille/discrete/goal_distances.hpp"
#include "quadrille/discrete/instance.hpp"
#include "quadrille/pebbles/settling.hpp"

namespace quadrille::discrete {

/// Moves agents of a component towards vertices of their own, many at once, by PIBT with priorities
/// that stay the same: the first agent goes straight there where the map lets it, and the others as
/// far as they can beside it. Nobody is sure to arrive.
class Rush final : public pebbles::Crowd {
 public:
  /// Null when a limit was met. `places`: by agent of the component. `order`: all agents, those who
  /// matter most first. All but these two outlive the object. O(agents * (V + E)).
  [[nodiscard]] static std::unique_ptr<Rush> make(
      const Instance& instance, const ComponentNumbering& numbering, const Component& component,
      std::span<const Local> places, std::span<const Local> order, LimitMonitor& limits);

  /// One timestep. The first `num_settled` agents of the order are at their places, and stay there.
  /// O(agents), as a rule.
  void advance(pebbles::Board& board, std::size_t num_settled) override;
  [[nodiscard]] Local distance(Local agent, Local from) const override {
    return static_cast<Local>((*distances_)(AgentId(agent), component_.vertices[from]));
  }
  [[nodiscard]] std::int64_t effort() const override { return effort_; }

 private:
  Rush(Instance instance, std::shared_ptr<const GoalDistances> distances,
       const ComponentNumbering& numbering, const Component& component,
       std::span<const Local> order);

  const Instance instance_;  // Its agents are those of the component, its goals the places.
  const std::shared_ptr<const GoalDistances> distances_;
  const ComponentNumbering& numbering_;
  const Component& component_;
  Random random_;
  Pibt pibt_;
  std::vector<AgentId> order_;
  std::vector<Pibt::Order> stays_;  // Of the first agents of the order.
  std::vector<VertexId> from_, to_;
  std::vector<Local> next_;
  std::int64_t effort_ = 0;
};

}  // namespace quadrille::discrete
