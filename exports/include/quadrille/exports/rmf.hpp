// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "quadrille/continuous/instance.hpp"
#include "quadrille/continuous/plan.hpp"
#include "quadrille/core/export.hpp"
#include "quadrille/core/result.hpp"
#include "quadrille/execution/precedences.hpp"
#include "quadrille/exports/naming.hpp"
#include "quadrille/text/names.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::exports {

/// What a follower has to wait for before it begins its move, in whole: the leader has begun a move
/// and come to a time of it, or has ended it.
struct Blocker {
  execution::MoveId leader;
  std::optional<execution::Ticks> until;  ///< Within the move; nullopt: its end.
};
/// Once the leader has come to end - slack, the rule of execution lets the follower end its move.
/// Of a robot that stands at a vertex the clock is as late as it may stand there. Nullopt: the
/// leader need not have begun any move.
[[nodiscard]] std::optional<Blocker> blocker_of(const execution::Precedences& order,
                                                const execution::Precedence& precedence);

/// What messages of a plan server of Open-RMF say besides the plan.
struct RmfHeads {
  RobotNames robots;        ///< The namespaces of the participants; different ones.
  text::Names names;        ///< Of vertices; those without a name have none.
  std::string map = "map";  ///< Of all places.
  std::string graph = "graph";
  /// Sessions of destinations are made of that and the robot's name: the same for the same texts.
  std::string session = "";
};

/// A plan as rmf_prototype_msgs/Plan of Open-RMF's next generation, one per agent, as a list of
/// {"name": participant, "plan": message} in JSON; docs/formats-of-others.md has the fields.
///
/// Progress is time of the plan since it begins, in the instance's unit. That of a waypoint is when
/// the plan lets the robot leave it: nothing holds back a robot that has arrived. Each waypoint has
/// one trajectory, with the time of its move. A robot leaves a waypoint when its blockers have made
/// the progress required: so much that the move can end whatever they do then, or that they have
/// ended theirs. So robots that leave when they are allowed to never collide, however late anybody
/// is. Numbers are those of float32; what is required is rounded up.
///
/// Requires a valid plan of the instance in the plane, and its precedences.
[[nodiscard]] std::string export_rmf_plan(const continuous::Instance& instance,
                                          const continuous::Plan& plan,
                                          const execution::Precedences& order,
                                          const RmfHeads& heads);

/// Robots that wait for each other for ever if each leaves waypoints as the blockers say: moves
/// each of which waits for the one before it to begin, the first one for the last one. Empty if all
/// arrive. Linear in moves and precedences.
[[nodiscard]] std::vector<execution::MoveId> blocked_for_ever(const execution::Precedences& order);

}  // namespace quadrille::exports

QUADRILLE_API_END
