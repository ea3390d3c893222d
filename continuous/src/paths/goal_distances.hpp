// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "paths/timed_path.hpp"

namespace quadrille::continuous {

/// How far each vertex is from the nearest goal of one agent.
class GoalDistances {
 public:
  GoalDistances(const Instance& instance, AgentId agent);
  /// Known already, by vertex.
  explicit GoalDistances(std::vector<Ticks> ticks) : ticks_(std::move(ticks)) {}
  /// Ticks; kForever if no goal can be reached.
  [[nodiscard]] Ticks operator[](VertexId v) const { return ticks_[v.index()]; }

  [[nodiscard]] const std::vector<Ticks>& ticks() const noexcept { return ticks_; }

 private:
  std::vector<Ticks> ticks_;
};

/// The moves of one agent, by what they add to the shortest way to its goal.
class Detours {
 public:
  /// Both arguments outlive this.
  Detours(const Instance& instance, AgentId agent, const GoalDistances& distances);

  struct Detour {
    EdgeId edge;
    VertexId to;
    Ticks duration = 0;
    Ticks extra = 0;  ///< How much longer the way is that begins with this move; not negative.
  };
  /// The moves out of a vertex from which the goal can be reached, by rising `extra`, equals by
  /// edge. Valid until the next call. The first call for a vertex sorts them: O(d log d).
  [[nodiscard]] std::span<const Detour> from(VertexId v);

 private:
  const Instance& instance_;
  const AgentId agent_;
  const GoalDistances& distances_;
  static constexpr std::uint32_t kUnknown = 0xffffffffu;
  struct Range {
    std::uint32_t begin = kUnknown, end = 0;
  };
  std::vector<Range> ranges_;  // by vertex, once one is asked for
  std::vector<Detour> detours_;
};

}  // namespace quadrille::continuous
