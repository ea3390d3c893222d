// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "quadrille/continuous/session.hpp"
#include "quadrille/core/export.hpp"
#include "quadrille/core/result.hpp"
#include "quadrille/fleet/fleet.hpp"
#include "quadrille/fleet/solver.hpp"
#include "quadrille/fleet/timed_plan.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::fleet {

/// A fleet that changes, and is solved again after each change: what earlier answers rest on lives
/// on, see continuous::Session. Costs and proofs are those of `solve` for `fleet()`; among plans of
/// the same cost it may be another one, which depends on what was solved before.
///
/// Robots are called by their names, as ids move up when somebody is removed. For one thread at a
/// time; several sessions may solve at once. Moves, is not copied; `fleet()` can be.
class Session {
 public:
  /// The robots as they are, their roads, obstacles and rules, and the time at which they begin.
  /// Those without a name get one, "robot 3" by their number. Errors: those of Fleet::instance
  /// about one robot or obstacle, but that it cannot reach its goals, and those of `add`.
  [[nodiscard]] static Result<Session> make(Fleet fleet);

  // Changes. One that is refused changes nothing. Whether robots are in each other's way, or can
  // reach their goals, is found out when it is solved: between two changes they need not.

  /// What a robot is to do, told as in a Fleet: [&](Robot robot) { robot.from(a).to(b); }.
  using Told = std::function<void(Robot)>;
  /// Another robot. Errors: those of Fleet::instance about one robot; invalid_instance for a name
  /// that another one has, and a robot in the middle of a move that may wait there, or along no
  /// lane that is for it.
  [[nodiscard]] std::optional<Error> add(RobotSpec spec, const Told& told);
  /// All of these: invalid_instance if no robot is called so. The rest of what it has been told
  /// stays as it is. Errors as for `add`.
  [[nodiscard]] std::optional<Error> change(std::string_view robot, const Told& told);
  [[nodiscard]] std::optional<Error> remove(std::string_view robot);
  /// Any one of these goals, from where it is. Errors: invalid_instance for no goals, or vertices
  /// that there are not.
  [[nodiscard]] std::optional<Error> assign(std::string_view robot, std::vector<VertexId> goals);
  [[nodiscard]] std::optional<Error> assign(std::string_view robot, VertexId goal) {
    return assign(robot, std::vector<VertexId>{goal});
  }
  /// As Fleet::close and open.
  [[nodiscard]] std::optional<Error> close(VertexId from, VertexId to);
  [[nodiscard]] std::optional<Error> open(VertexId from, VertexId to);
  /// Time has gone on, to the nearest multiple of the resolution, and everybody has followed the
  /// plan, one of `fleet()`: that of the last answer, or what has become of it where somebody was
  /// late (TimedPlan::make). From now on robots begin where they are then, at a vertex or in the
  /// middle of a move; those that leave and have arrived are removed. Errors: out_of_range for a
  /// time that is over, or too long; invalid_plan, with the first violation, for one that is no
  /// plan of `fleet()`; those of Fleet::instance.
  [[nodiscard]] std::optional<Error> advance_to(Seconds now, const TimedPlan& plan);

  /// When all robots are at their starts.
  [[nodiscard]] Seconds now() const noexcept { return fleet_.begin(); }
  /// All as it is now, with robots in the order in which they were added.
  [[nodiscard]] const Fleet& fleet() const noexcept { return fleet_; }

  /// As fleet::solve for `fleet()`, with its errors. With one thread the search takes note of what
  /// the lower bound is made of, as with `explain`, which costs a few per cent of its time.
  [[nodiscard]] Result<SolveOutcome> solve(const SolveOptions& options = {});

 private:
  /// A robot as the layer below takes it.
  struct Member {
    continuous::Agent agent;
    std::optional<continuous::EdgeId> edge = {};  ///< In the middle of a move along it,
    continuous::Ticks behind = 0;                 ///< with so much of it behind.
  };
  Session(Fleet fleet, continuous::Session session)
      : fleet_(std::move(fleet)), session_(std::move(session)) {}
  [[nodiscard]] static Result<Member> member(const Fleet& fleet, AgentId robot);
  [[nodiscard]] std::optional<Error> add(const Member& member);
  [[nodiscard]] Result<AgentId> find(std::string_view robot) const;
  void put(continuous::MemberId id, const Member& member);
  [[nodiscard]] Error in_words(const Error& error, const TimedPlan& plan) const;
  void forget_removed();

  Fleet fleet_;
  continuous::Session session_;
  IdVector<AgentId, continuous::MemberId> members_;
  std::size_t num_added_ = 0;
};

}  // namespace quadrille::fleet

QUADRILLE_API_END
