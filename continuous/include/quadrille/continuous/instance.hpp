// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "quadrille/continuous/resolution.hpp"
#include "quadrille/continuous/roadmap.hpp"
#include "quadrille/core/contract.hpp"
#include "quadrille/core/export.hpp"
#include "quadrille/core/goals.hpp"
#include "quadrille/geometry/body.hpp"
#include "quadrille/geometry/motion.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::continuous {

using geometry::Body;
using geometry::ConvexPolygon;
using geometry::Disc;

/// A body with a task.
struct Agent {
  VertexId start;
  Goals goals;  ///< It ends at any one of them. At least one.
  /// A disc, or a convex polygon, which keeps its orientation on all moves: a robot that turns is
  /// the disc around all its orientations, or has `shapes`. In an instance that is not flat a disc
  /// is a ball.
  Body body = Disc{};
  Speed speed = kUnitSpeed;
  GroupId group = {};  ///< It may use the edges that are open to this one.
  /// It begins no move before this tick. At its start it is from Instance::now on all the same, and
  /// its cost counts from there.
  Ticks release = 0;
  /// It arrives at its goal for the last time by this tick.
  std::optional<Ticks> deadline = {};
  /// It vanishes when it arrives at its goal, where the goals of others may be, too. Otherwise it
  /// stays there for ever.
  bool leaves = false;
  /// At Instance::now it is moving: its start is a place in the middle of a move, where it is then,
  /// and it goes on at once. The start is a vertex of its own, without edges that lead there and
  /// with one that leads on, whose duration is what is left of the move. It has no release. An
  /// agent that may wait in the middle of a move starts at such a vertex without this.
  bool under_way = false;
  /// Those of a robot that turns: its body where a vertex or an edge has shape k is shapes[k - 1].
  /// None: it is `body` wherever it is. A shape of an edge contains those of both its ends. All
  /// shapes are relative to the position of the robot, and none turns of itself.
  std::vector<Body> shapes = {};
  /// At its start its body may overlap with that of another agent of which that is said, too: they
  /// are parked nearer than bodies that are drawn with a margin. The two do not collide as long as
  /// both stand there, nor while one of them does and the other one makes the first move of its
  /// path, if they are apart when that ends; from then on as all do. Not if it is under way.
  bool overlaps_at_start = false;

  /// Its body where the shape is that one. Requires one that it has.
  [[nodiscard]] const Body& body_as(ShapeId shape) const {
    if (shapes.empty() || shape == ShapeId()) return body;
    QUADRILLE_REQUIRE(shape.index() <= shapes.size(), "a shape of the agent");
    return shapes[shape.index() - 1];
  }
  /// Requires that there is one goal only.
  [[nodiscard]] VertexId goal() const { return goals.only(); }
  friend bool operator==(const Agent&, const Agent&) = default;
};

/// A body on a timed path that is known, for which nobody plans: one of another fleet. Agents keep
/// clear of it, as of each other.
struct MovingObstacle {
  /// At `at` from `arrive` to `depart`, both included.
  struct Stop {
    Point at;
    Ticks arrive = 0;
    Ticks depart = 0;
    friend bool operator==(const Stop&, const Stop&) = default;
  };
  Body body = Disc{};
  /// From each stop to the next it goes straight and at constant speed. It is nowhere before the
  /// first arrival. Of what lies before Instance::now only where it is then matters.
  std::vector<Stop> path;
  /// It vanishes at its last departure. Otherwise it stays at its last stop for ever.
  bool leaves = false;
  friend bool operator==(const MovingObstacle&, const MovingObstacle&) = default;
};

/// Agents of the same body and speed, to whom the same edges are open, are alike.
using ClassId = StrongId<struct ClassTag>;

/// A MAPF_R instance: a roadmap and one body with a task per agent, all in whole ticks and length
/// units. All times are absolute. The agents are at their starts at the tick `now`, 0 if nothing
/// else is said, where their plans begin and from where costs count. Agents wait at vertices only,
/// unless the roadmap forbids it there, a whole number of ticks, move along edges at constant
/// speed, and stay at a goal for ever. Two agents collide when the interiors of their bodies meet;
/// touching is allowed. An agent with shapes has that of the edge from the begin of its move to the
/// end, and at the moments between two moves that of the vertex only. Immutable; cheap to copy (the
/// roadmap is shared).
class Instance {
 public:
  /// Durations that the roadmap does not give are length / speed, rounded to the nearest tick,
  /// where the speed is that of the agent or the limit of the edge, whichever is less. Errors:
  /// out_of_range for a radius outside [1, geometry::kMaxLength], a polygon with a corner further
  /// than that from the agent's position, a speed outside [1, kMaxSpeed], a group outside [0,
  /// kMaxGroups), `now`, a release or a deadline outside [0, geometry::kMaxDuration], a duration
  /// outside [1, geometry::kMaxDuration], a resolution that is not positive and finite, likewise
  /// for bodies, places and times of obstacles; invalid_instance for vertices that do not exist,
  /// agents without a goal, agents that start, or would stay at a goal, where nobody may wait,
  /// agents that are under way but not at a place of their own, or released after `now` or that
  /// overlap at their starts, obstacles without stops, whose times go back, or that vanish when
  /// they appear, polygons in an instance that is not flat, agents with shapes that lack one of the
  /// roadmap, or one of whose shapes at a vertex is not inside of that of an edge there that they
  /// may use; no_plan for overlapping starts, unless both agents say so, and with an obstacle at
  /// `now`, overlapping goals (interiors) of agents that stay there and have no other one, and
  /// agents that can reach no goal, or none by the deadline. Agents are named by index. `places`:
  /// where each agent comes from, for errors about it; none, or one per agent.
  [[nodiscard]] static Result<Instance> make(std::shared_ptr<const Roadmap> roadmap,
                                             std::vector<Agent> agents, Resolution resolution = {},
                                             std::span<const SourcePlace> places = {},
                                             std::vector<MovingObstacle> obstacles = {},
                                             Ticks now = 0);
  [[nodiscard]] static Result<Instance> make(Roadmap roadmap, std::vector<Agent> agents,
                                             Resolution resolution = {},
                                             std::span<const SourcePlace> places = {},
                                             std::vector<MovingObstacle> obstacles = {},
                                             Ticks now = 0);
  /// The same with other agents. Errors as those of `make`.
  [[nodiscard]] Result<Instance> with_agents(std::vector<Agent> agents) const;
  /// The same for systems that release whole moves, or no longer: see has_whole_moves.
  [[nodiscard]] Instance with_whole_moves(bool whole = true) const;

  [[nodiscard]] const Roadmap& roadmap() const noexcept { return *roadmap_; }
  [[nodiscard]] std::shared_ptr<const Roadmap> shared_roadmap() const noexcept { return roadmap_; }
  [[nodiscard]] const Resolution& resolution() const noexcept { return resolution_; }
  [[nodiscard]] std::size_t num_agents() const noexcept { return agents_.size(); }
  [[nodiscard]] IdRange<AgentId> agent_ids() const noexcept {
    return IdRange<AgentId>(num_agents());
  }
  [[nodiscard]] const IdVector<AgentId, Agent>& agents() const noexcept { return agents_; }
  [[nodiscard]] const Agent& agent(AgentId i) const { return agents_[i]; }
  /// When all agents are at their starts.
  [[nodiscard]] Ticks now() const noexcept { return now_; }
  /// Moves are released as a whole, one after the other: two moves of different agents that would
  /// collide at some offset, real ones included, have no moment in common but the end of one and
  /// the begin of the other. Agents who carry out such a plan never have to be held back within a
  /// move, and never wait for each other in a circle (docs/soundness/continuous.md, "Whole moves").
  /// A move that begins in the middle of an edge counts as the whole edge here. Who stands, and
  /// moving obstacles, are met as ever.
  [[nodiscard]] bool has_whole_moves() const noexcept { return has_whole_moves_; }
  /// Some agent has more than one goal.
  [[nodiscard]] bool has_goal_sets() const noexcept { return has_goal_sets_; }
  /// The agents that overlap at their starts, in pairs, each of them ascending.
  [[nodiscard]] const std::vector<std::pair<AgentId, AgentId>>& parked_pairs() const noexcept {
    return parked_pairs_;
  }

  [[nodiscard]] const std::vector<MovingObstacle>& obstacles() const noexcept { return obstacles_; }
  /// Whether all is in the plane z = 0, vertices and stops of obstacles. Otherwise all bodies are
  /// balls.
  [[nodiscard]] bool is_flat() const noexcept { return is_flat_; }

  [[nodiscard]] std::size_t num_classes() const noexcept { return classes_.size(); }
  [[nodiscard]] ClassId class_of(AgentId i) const { return class_of_[i]; }
  /// Agent::body_as.
  [[nodiscard]] const Body& body(ClassId c, ShapeId shape = {}) const {
    const std::vector<Body>& bodies = classes_[c].bodies;
    return bodies.size() == 1 ? bodies.front() : bodies[shape.index()];
  }
  /// By shape; one if the class has no shapes.
  [[nodiscard]] const std::vector<Body>& bodies(ClassId c) const { return classes_[c].bodies; }
  /// Some agent has.
  [[nodiscard]] bool has_shapes() const noexcept { return has_shapes_; }
  /// An agent is nowhere further than that from Roadmap::position of where it stands, or from the
  /// line between those of the ends of its move: geometry::enclosing_radius of the largest of its
  /// bodies, and one more where places in the middle of moves are rounded; where such moves count
  /// as whole ones, more by the longest way that lies behind such a place.
  [[nodiscard]] Length reach(ClassId c) const { return classes_[c].reach; }
  [[nodiscard]] Ticks duration(ClassId c, EdgeId e) const {
    return durations_[classes_[c].durations][e.index()];
  }
  /// Whether the edge is open to the agents of the class.
  [[nodiscard]] bool may_use(ClassId c, EdgeId e) const {
    return roadmap_->edge(e).open_to.contains(classes_[c].group);
  }
  /// Those that are open to the class, by edge id.
  [[nodiscard]] std::span<const EdgeId> out_edges(ClassId c, VertexId v) const {
    const auto& ways = classes_[c].ways;
    return ways == nullptr ? roadmap_->out_edges(v) : ways->out.of(v);
  }
  [[nodiscard]] std::span<const EdgeId> in_edges(ClassId c, VertexId v) const {
    const auto& ways = classes_[c].ways;
    return ways == nullptr ? roadmap_->in_edges(v) : ways->in.of(v);
  }
  [[nodiscard]] geometry::Motion motion(ClassId c, EdgeId e) const {
    const Edge& edge = roadmap_->edge(e);
    return roadmap_->motion(edge.from, edge.to, duration(c, e));
  }

 private:
  /// The edges that are open to a group.
  struct Ways {
    EdgeLists out, in;
  };
  struct Class {
    std::vector<Body> bodies;  // by shape, or one
    Length body_reach = 1;     // without what is behind places in the middle of moves
    Length reach = 1;
    Speed speed = kUnitSpeed;
    std::size_t durations = 0;              // into durations_, one per speed
    GroupId group;                          // of an agent of this class
    std::shared_ptr<const Ways> ways = {};  // null: all edges
  };
  Instance() = default;
  /// `make`. Obstacles that are not new are those of an instance.
  [[nodiscard]] static Result<Instance> build(std::shared_ptr<const Roadmap> roadmap,
                                              std::vector<Agent> agents, Resolution resolution,
                                              std::span<const SourcePlace> places,
                                              std::vector<MovingObstacle> obstacles, Ticks now,
                                              bool has_new_obstacles);
  friend Instance since_now(const Instance& instance);  // model/since_now.hpp

  std::shared_ptr<const Roadmap> roadmap_;
  IdVector<AgentId, Agent> agents_;
  std::vector<MovingObstacle> obstacles_;
  Ticks now_ = 0;
  bool is_flat_ = true;
  bool has_goal_sets_ = false;
  bool has_shapes_ = false;
  bool has_whole_moves_ = false;
  std::vector<std::pair<AgentId, AgentId>> parked_pairs_;
  Resolution resolution_;
  IdVector<ClassId, Class> classes_;
  IdVector<AgentId, ClassId> class_of_;
  std::vector<std::vector<Ticks>> durations_;  // by speed, by edge
};

}  // namespace quadrille::continuous

QUADRILLE_API_END
