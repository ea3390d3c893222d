// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "quadrille/continuous/plan.hpp"
#include "traffic/scene.hpp"

namespace quadrille::continuous {

/// One agent goes along one edge, from rest to rest, while all others stand.
struct SerialMove {
  AgentId agent;
  EdgeId edge;
  friend bool operator==(const SerialMove&, const SerialMove&) = default;
};

/// What is in the way of an agent that moves while all others stand.
class StandingBodies {
 public:
  /// `scene` outlives it.
  explicit StandingBodies(Scene& scene);

  /// Whether an agent of class b that stands at v is in the way of one of class a on the edge e.
  [[nodiscard]] bool block(ClassId a, EdgeId e, ClassId b, VertexId v) {
    return scene_.contacts().window(a, e, b, v).has_value();
  }
  /// The vertices at which agents that stand may be in the way of one of class a on the edge,
  /// ascending; its ends are among them. Valid as long as this lives.
  [[nodiscard]] const std::vector<VertexId>& near(ClassId a, EdgeId e);
  /// Whether obstacles that stay for ever leave the edge open to agents of the class, and its end
  /// as a place to stand.
  [[nodiscard]] bool may_use(ClassId c, EdgeId e) const {
    return scene_.instance().may_use(c, e) && !is_closed_[c.index()][e.index()];
  }
  /// From this tick on no obstacle moves, everybody is released, and who was under way at tick 0
  /// has ended that move.
  [[nodiscard]] Ticks begin() const noexcept { return begin_; }

  [[nodiscard]] Scene& scene() noexcept { return scene_; }

 private:
  Scene& scene_;
  Ticks begin_ = 0;
  std::vector<std::vector<bool>> is_closed_;         // by class, by edge
  std::vector<std::vector<std::uint32_t>> near_at_;  // by class, by edge: in near_, or kUnknown
  std::deque<std::vector<VertexId>> near_;
  static constexpr std::uint32_t kUnknown = 0xffffffffu;
};

/// Where the agents are, each at rest at a vertex of its own.
class Standing {
 public:
  /// At their starts; who is under way at tick 0 at the end of that move.
  explicit Standing(StandingBodies& bodies);

  [[nodiscard]] VertexId vertex_of(AgentId i) const { return vertex_of_[i]; }
  /// It has left at its goal.
  [[nodiscard]] bool is_gone(AgentId i) const { return is_gone_[i]; }
  /// It is where it has to be in the end.
  [[nodiscard]] bool is_home(AgentId i) const;
  [[nodiscard]] bool are_all_home() const;
  /// Whether each is at a vertex of its own. Not so if one who is under way ends where another one
  /// stands.
  [[nodiscard]] bool are_apart() const;
  /// Whether nobody is in the way. Requires an edge from where the agent is. Adds to `effort`.
  [[nodiscard]] bool can_move(const SerialMove& move, std::int64_t& effort);
  /// Without a look at who is in the way.
  void move(const SerialMove& move);
  /// Puts an agent somewhere else; `gone`: it is nowhere.
  void put(AgentId i, VertexId v, bool gone = false);
  /// kNobody, or the agent's index.
  [[nodiscard]] std::uint32_t agent_at(VertexId v) const { return agent_at_[v]; }
  static constexpr std::uint32_t kNobody = 0xffffffffu;

 private:
  StandingBodies& bodies_;
  const Instance& instance_;
  IdVector<AgentId, VertexId> vertex_of_;
  IdVector<AgentId, bool> is_gone_;
  IdVector<VertexId, std::uint32_t> agent_at_;
};

/// Whether the moves lead from `Standing` to the goals, each with nobody in the way.
[[nodiscard]] bool is_serial_plan(StandingBodies& bodies, std::span<const SerialMove> moves);

/// Leaves out what an agent does between two visits of a vertex if it can stand there all the
/// while. Requires a serial plan; so is the result. Ends early after about `effort` elementary
/// steps.
[[nodiscard]] std::vector<SerialMove> without_loops(StandingBodies& bodies,
                                                    std::vector<SerialMove> moves,
                                                    std::int64_t effort);

/// The plan in which each move begins as early as its agent, and the moves before it that collide
/// with it at some offset, allow: in the order of any two such moves nothing changes. Requires a
/// serial plan. O(moves * edges that are near to one). The plan is valid but for deadlines, moving
/// obstacles and what those do who are under way at tick 0: `verify` says. Throws LimitReached.
[[nodiscard]] Plan earliest_plan(StandingBodies& bodies, std::span<const SerialMove> moves);

}  // namespace quadrille::continuous
