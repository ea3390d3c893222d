// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "paths/timed_path.hpp"
#include "traffic/scene.hpp"

namespace quadrille::continuous {

/// From a tick until another one, both included.
struct ClockSpan {
  Ticks from = 0, until = kForever;
  friend bool operator==(const ClockSpan&, const ClockSpan&) = default;
};

/// What the clock says about the agents of a joint search, whatever the others do: when moving
/// obstacles, moves in progress, releases and deadlines let them stay, set out and arrive.
class JointClock {
 public:
  /// Of no rules: everything may happen at any time.
  JointClock() = default;
  JointClock(Scene& scene, const std::vector<AgentId>& agents);

  /// Whether there is such a rule.
  [[nodiscard]] bool matters() const noexcept { return !agents_.empty(); }
  /// Stays of agent k at the vertex that nothing forbids, as long as they can be, increasing. None
  /// contains another one.
  [[nodiscard]] std::span<const ClockSpan> stays(std::size_t k, VertexId v) const {
    return matters() ? agents_[k].stays[v.index()] : std::span(&kAlways, 1);
  }
  /// When agent k may begin the move, in runs of ticks, increasing.
  [[nodiscard]] std::span<const ClockSpan> starts(std::size_t k, EdgeId e) const {
    return matters() ? agents_[k].starts[e.index()] : std::span(&kAlways, 1);
  }
  /// When agent k arrives at the vertex at the latest, to be at its goal in time.
  [[nodiscard]] Ticks latest(std::size_t k, VertexId v) const {
    return matters() ? agents_[k].latest[v.index()] : kForever;
  }

 private:
  static constexpr ClockSpan kAlways{};
  using Spans = std::vector<ClockSpan>;
  struct Rules {
    std::vector<Spans> stays;   // by vertex
    std::vector<Spans> starts;  // by edge
    std::vector<Ticks> latest;  // by vertex
  };
  [[nodiscard]] static Rules rules_of(Scene& scene, AgentId i);

  std::vector<Rules> agents_;  // by position; none: nothing matters
};

}  // namespace quadrille::continuous
