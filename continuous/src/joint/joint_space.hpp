// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "joint/joint_clock.hpp"
#include "paths/timed_path.hpp"
#include "paths/unsafe_starts.hpp"
#include "traffic/scene.hpp"

namespace quadrille::continuous {

/// Of a joint search.
inline constexpr std::size_t kMaxJointAgents = 8;

/// Which rules a joint search knows.
enum class JointRules {
  timeless,  ///< None of releases, deadlines, moving obstacles and moves in progress.
  all,
};

/// What some agents do at a moment, without the times.
struct JointPlaces {
  /// By position among the agents: an edge, or a vertex after all edges, or, beyond these, that it
  /// has left.
  std::array<std::uint32_t, kMaxJointAgents> place{};
  /// Of those that stand, in which of the stays that the clock allows there.
  std::array<std::uint32_t, kMaxJointAgents> stay{};
  /// A set of pairs (mover, stander): the stander's place is in contact with the mover's move, and
  /// the stander arrived there during this move, when the contact was over. Any other stander that
  /// is in contact with a move has to leave before the contact begins.
  std::uint64_t late = 0;
  friend bool operator==(const JointPlaces&, const JointPlaces&) = default;
};

/// An event: an agent begins a move or ends it.
struct JointStep {
  std::uint32_t agent = 0;  ///< Position among the agents.
  std::uint32_t edge = 0;   ///< Begun or ended.
  bool begins = false;
  /// For each agent that is moving: whether its move is so old that it is no longer in the way, or
  /// so young that it is not yet (if it can be in the way at all). One bit per agent.
  std::uint32_t old_moves = 0;
  /// In which of the clock's spans it happens: of the starts of the edge, or of the stays at its
  /// end.
  std::uint32_t span = 0;
};

/// A limit on how old the move of `agent` is: on the difference between now and its begin.
struct AgeLimit {
  std::uint32_t agent;
  bool is_least;  ///< At least this age, otherwise at most.
  Ticks age;
};

/// The places of some agents and the events that lead from one to the next, with the limits on the
/// times at which these may happen. Every plan is a sequence of such events, ordered by time, and
/// every sequence with times that keep the limits, from the starts to the goals, is a plan.
/// docs/soundness/continuous.md, 11.20
class JointSpace {
 public:
  /// At most kMaxJointAgents agents. The scene outlives this.
  JointSpace(Scene& scene, std::vector<AgentId> agents, JointRules rules);

  [[nodiscard]] std::size_t size() const noexcept { return agents_.size(); }
  [[nodiscard]] AgentId agent(std::size_t k) const { return agents_[k]; }
  [[nodiscard]] bool is_moving(const JointPlaces& places, std::size_t k) const {
    return places.place[k] < num_edges_;
  }
  /// Of one that stands.
  [[nodiscard]] VertexId vertex(const JointPlaces& places, std::size_t k) const {
    return VertexId(places.place[k] - num_edges_);
  }
  /// Of one that moves.
  [[nodiscard]] EdgeId edge(const JointPlaces& places, std::size_t k) const {
    return EdgeId(places.place[k]);
  }
  [[nodiscard]] Ticks duration(std::size_t k, EdgeId e) const {
    return instance_.duration(class_of(k), e);
  }
  /// It has left at its goal.
  [[nodiscard]] bool has_left(const JointPlaces& places, std::size_t k) const {
    return places.place[k] == left_;
  }
  /// It may stay there for ever, or it has left.
  [[nodiscard]] bool is_at_goal(const JointPlaces& places, std::size_t k) const;
  /// Whether times count, and not only their differences.
  [[nodiscard]] bool has_clock() const noexcept { return clock_.matters(); }

  /// Nullopt: an agent cannot even be at its start at tick 0.
  [[nodiscard]] std::optional<JointPlaces> starts() const;
  [[nodiscard]] bool are_goals(const JointPlaces& places) const;
  /// The events that may come next, as far as one can say without times.
  void list_steps(const JointPlaces& places, std::vector<JointStep>& steps);
  /// When the clock allows the event.
  [[nodiscard]] ClockSpan when(const JointStep& step) const;
  /// When something has to happen, by the clock, at the latest.
  [[nodiscard]] Ticks latest(const JointPlaces& places) const;
  /// What the ages of moves have to be when the event happens.
  void list_limits(const JointPlaces& places, const JointStep& step, std::vector<AgeLimit>& limits);
  [[nodiscard]] JointPlaces after(const JointPlaces& places, const JointStep& step);
  /// How old each move may become before something else has to happen. Upper limits only.
  void list_deadlines(const JointPlaces& places, std::vector<AgeLimit>& limits);

 private:
  [[nodiscard]] bool stands(const JointPlaces& places, std::size_t k) const {
    return places.place[k] >= num_edges_ && places.place[k] != left_;
  }
  /// Whether an agent that ends the move vanishes.
  [[nodiscard]] bool leaves_after(const JointStep& step) const;
  [[nodiscard]] ClassId class_of(std::size_t k) const { return instance_.class_of(agents_[k]); }
  [[nodiscard]] static std::uint64_t bit(std::size_t mover, std::size_t stander) {
    return std::uint64_t{1} << (mover * kMaxJointAgents + stander);
  }
  /// The ages of the move of agent `mover` at which the event must not happen: a stretch, so that
  /// begin and end are ages at which it may.
  [[nodiscard]] std::optional<TickInterval> bad_ages(const JointPlaces& places,
                                                     const JointStep& step, std::size_t mover);
  /// Until when agent k may stand where it does after the begin of another's move; kForever: for
  /// ever.
  [[nodiscard]] Ticks latest_leave(const JointPlaces& places, std::size_t mover, std::size_t k);
  /// The step in each of the first spans, and with each set of moves that can be old then.
  void add_variants(const JointPlaces& places, JointStep step, std::size_t num_spans,
                    std::vector<JointStep>& steps);

  const Instance& instance_;
  Contacts& contacts_;
  const std::vector<AgentId> agents_;
  const std::size_t num_edges_, left_;
  const JointClock clock_;
};

}  // namespace quadrille::continuous
