// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "quadrille/continuous/in_words.hpp"
#include "quadrille/continuous/instance.hpp"
#include "quadrille/core/export.hpp"
#include "quadrille/core/ids.hpp"
#include "quadrille/core/result.hpp"
#include "quadrille/fleet/roadmap.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::fleet {

/// A disc around the robot's position, where there are heights a sphere. Rounded up to the
/// resolution: the robot is never larger than planned.
struct Disc {
  Metres radius;
  constexpr explicit Disc(Metres of_radius) : radius(of_radius) {}
  friend constexpr bool operator==(const Disc&, const Disc&) = default;
};

/// A convex polygon around the robot's position, which it keeps without turning; a robot that turns
/// is a disc around all its orientations. Not where there are heights. `corners`: relative to the
/// position, in order, either way round; 3 .. 64. It is rounded outwards to multiples of the
/// resolution (quantise_polygon_up), so that it contains the one given.
struct Polygon {
  std::vector<Point> corners;
  explicit Polygon(std::vector<Point> of_corners) : corners(std::move(of_corners)) {}
  friend bool operator==(const Polygon&, const Polygon&) = default;
};

using Body = std::variant<Disc, Polygon>;

/// What a robot is. Without a name it is called "robot 3", by its number.
struct RobotSpec {
  std::string name = {};
  /// Has to be given. Where vertices are poses (PoseBuilder), a polygon is the robot that faces
  /// along x, and turns with it; elsewhere it keeps its orientation.
  Body body = Disc(Metres(0));
  /// On all lanes. How long a lane takes is rounded to the nearest multiple of the resolution of
  /// time, so that a robot may be faster or slower by up to half of that per lane.
  MetresPerSecond speed = {};
  /// It may use lanes for all, and those that are reserved for this group.
  std::optional<Group> group = {};
  friend bool operator==(const RobotSpec&, const RobotSpec&) = default;
};

/// Something that moves as is known, and for which nobody plans: a robot of another fleet, say. The
/// robots keep clear of it as of each other.
struct MovingObstacle {
  /// At `place` from `arrive` to `depart`.
  struct Stop {
    Point place;
    Seconds arrive;
    Seconds depart;
    friend bool operator==(const Stop&, const Stop&) = default;
  };
  std::string name = {};        ///< Without one it is called "obstacle 3", by its number.
  Body body = Disc(Metres(0));  ///< Has to be given.
  /// It goes straight and at constant speed from each stop to the next, which it reaches later. It
  /// is nowhere before the first one. Places and times are rounded to the nearest multiples of the
  /// resolution.
  std::vector<Stop> path = {};
  bool leaves = false;  ///< It vanishes at its last departure, and does not stay for ever.
  friend bool operator==(const MovingObstacle&, const MovingObstacle&) = default;
};

class Fleet;
class TimedPath;

/// A move in progress: `fraction` of it, 0 .. 1, lies behind, or it was begun at a given time.
struct UnderWay {
  VertexId from, to;
  double fraction = 0;
  std::optional<Seconds> begun = {};  ///< Instead of a fraction.
  bool may_wait = false;              ///< It stands there, and need not go on at once.
  friend bool operator==(const UnderWay&, const UnderWay&) = default;
};

/// A robot of a fleet, to be told its task: `fleet.robot({...}).from(a).to(b)`. To be used while
/// the fleet is where it is. What it converts to, its id, stays valid.
class Robot {
 public:
  /// Where it begins. Requires a vertex of the roadmap, or the place in the middle of a move where
  /// this robot begins as it is, which changes nothing.
  Robot from(VertexId start) const;  // NOLINT: part of a chain
  /// Where it is at this time when it follows the path: at a vertex, or in the middle of a move;
  /// where it stands within its lane it may wait still.
  /// For planning again while robots are under way, as often as there is need, also within one
  /// move. Before its first stop it is where the path begins, after the end where it ends. Requires
  /// a path whose vertices the roadmap has, and a finite time.
  Robot from(const TimedPath& path, Seconds time) const;  // NOLINT: part of a chain
  /// Instead: when all begins, Fleet::begins_at, it is in the middle of a move, of which `fraction`
  /// lies behind it, 0 .. 1, and it finishes the move, without a stop; also if the lane has been
  /// closed meanwhile. What lies behind is rounded down to whole steps of time, and at least one
  /// step is left: it is never taken to be further than it is, but for that last step. Its place
  /// follows from that, exactly. Requires two vertices of the roadmap.
  /// `from` may also be the place in the middle of a move to `to` where this robot begins until
  /// now, told by a fraction as well: then `fraction` is one of what was left of the move, so that
  /// it must not be told twice.
  Robot from_edge(VertexId from, VertexId to,
                  double fraction = 0) const;  // NOLINT: part of a chain
  /// After from_edge, and instead of a fraction: when it began the move, on the clock of
  /// Fleet::begins_at, rounded up to a whole step, and so negative where the fleet begins at 0 s.
  /// Requires that it is under way, and a finite time.
  Robot begun(Seconds time) const;  // NOLINT: part of a chain
  /// After from_edge: it stands within its lane, and may wait there before it goes on.
  Robot may_wait(bool may = true) const;  // NOLINT: part of a chain
  /// Where it goes, and stays. Requires a vertex of the roadmap.
  Robot to(VertexId goal) const { return to_any({goal}); }  // NOLINT: part of a chain
  /// Where it may go: it ends at any one of these, in any order, and stays there. Requires vertices
  /// of the roadmap, at least one.
  Robot to_any(std::vector<VertexId> goals) const;  // NOLINT: part of a chain

  /// It begins no move before this time, rounded up. At its start it is from the beginning all the
  /// same, in the way of others, and its cost counts from there.
  Robot release(Seconds time) const;  // NOLINT: part of a chain
  /// It arrives at its goal for good by this time, rounded down; a plan in which it does not is
  /// none. nullopt: whenever.
  Robot deadline(std::optional<Seconds> time) const;  // NOLINT: part of a chain
  /// It vanishes when it arrives at its goal, and does not stay there.
  Robot leaves(bool does = true) const;  // NOLINT: part of a chain
  /// Another body or speed, such as that of a robot with its load.
  Robot becomes(RobotSpec spec) const;  // NOLINT: part of a chain

  [[nodiscard]] AgentId id() const noexcept { return id_; }
  operator AgentId() const noexcept { return id_; }  // NOLINT: an id is all that others need

 private:
  friend class Fleet;
  Robot(Fleet& fleet, AgentId id) : fleet_(&fleet), id_(id) {}
  Fleet* fleet_;
  AgentId id_;
};

/// Robots with tasks on a roadmap, in metres and seconds. Copies are independent.
class Fleet {
 public:
  explicit Fleet(Roadmap roadmap) : roadmap_(std::move(roadmap)) {}

  /// When all begin, as the clock of releases, deadlines, obstacles and plans says, rounded to the
  /// nearest multiple of the resolution; 0 s if nothing else is said. Robots are at their starts
  /// then, and what plans cost counts from there.
  void begins_at(Seconds time) { begin_ = time; }
  [[nodiscard]] Seconds begin() const noexcept { return begin_; }

  /// Plans are for systems that release whole moves, such as VDA 5050: two moves that cross are
  /// never under way at the same time, so that nobody waits for a release while all are on time,
  /// and robots that are late never lock up (continuous::Instance::has_whole_moves).
  void release_whole_moves(bool whole = true) { whole_moves_ = whole; }
  [[nodiscard]] bool releases_whole_moves() const noexcept { return whole_moves_; }

  /// Another robot. Whether it makes sense is checked by `instance`.
  Robot robot(RobotSpec spec);
  /// One that is there already, to be given another task. Requires a robot of this fleet.
  [[nodiscard]] Robot operator[](AgentId id);

  [[nodiscard]] const Roadmap& roadmap() const noexcept { return roadmap_; }
  /// Other roads, all of them open. Requires the vertices to be the same in number.
  void set_roadmap(Roadmap roadmap);
  /// Nobody enters the lane from one vertex to another one, until it is opened; who is under way
  /// there finishes its move. Errors: invalid_instance if there is no such lane, or it is closed
  /// (open) already.
  [[nodiscard]] std::optional<Error> close(VertexId from, VertexId to);
  [[nodiscard]] std::optional<Error> open(VertexId from, VertexId to);
  [[nodiscard]] bool is_closed(VertexId from, VertexId to) const {
    return closed_.contains({from, to});
  }
  /// From where to where.
  [[nodiscard]] const std::set<std::pair<VertexId, VertexId>>& closed_lanes() const noexcept {
    return closed_;
  }

  [[nodiscard]] std::size_t num_robots() const noexcept { return robots_.size(); }
  [[nodiscard]] IdRange<AgentId> robot_ids() const { return IdRange<AgentId>(num_robots()); }
  [[nodiscard]] const RobotSpec& spec(AgentId id) const { return robots_[id].spec; }
  [[nodiscard]] std::string name(AgentId id) const;
  [[nodiscard]] std::optional<AgentId> find(std::string_view name) const;
  /// nullopt as long as it has not been told, or if it begins in the middle of a move.
  [[nodiscard]] std::optional<VertexId> start(AgentId id) const { return robots_[id].start; }
  /// The move in the middle of which it begins; nullopt if it begins at a vertex.
  [[nodiscard]] const std::optional<UnderWay>& under_way(AgentId id) const {
    return robots_[id].under_way;
  }
  /// nullopt as long as it has not been told. Requires that it has one goal only.
  [[nodiscard]] std::optional<VertexId> goal(AgentId id) const {
    return robots_[id].goals ? std::optional(robots_[id].goals->only()) : std::nullopt;
  }
  /// All of which it ends at one; nullopt as long as it has not been told.
  [[nodiscard]] const std::optional<Goals>& goals(AgentId id) const { return robots_[id].goals; }
  [[nodiscard]] Seconds release(AgentId id) const { return robots_[id].release; }
  [[nodiscard]] std::optional<Seconds> deadline(AgentId id) const { return robots_[id].deadline; }
  [[nodiscard]] bool leaves(AgentId id) const { return robots_[id].leaves; }

  /// Roadmap::name for the vertices of the roadmap. In `instance`, and in plans, there is one more
  /// for each robot that begins in the middle of a move, in their order: "the lane from a to b".
  /// Requires one of these.
  [[nodiscard]] std::string place_name(VertexId v) const;

  /// Another obstacle. Whether it makes sense is checked by `instance`.
  void obstacle(MovingObstacle obstacle) { obstacles_.push_back(std::move(obstacle)); }
  void clear_obstacles() { obstacles_.clear(); }
  [[nodiscard]] const std::vector<MovingObstacle>& obstacles() const noexcept { return obstacles_; }
  /// Its name, for one that has none "obstacle 3". Requires an obstacle of this fleet.
  [[nodiscard]] std::string obstacle_name(std::size_t index) const;

  /// The same in whole units, as the solver takes it. Errors name robots and vertices:
  /// invalid_instance for a robot without body, start or goal, a name given twice, a polygon that
  /// is not convex, or is somewhere where there are heights, a group that the roadmap does not
  /// have, an obstacle without stops, whose times do not increase, or that vanishes when it
  /// appears; out_of_range for sizes, speeds and times that are not supported at this resolution;
  /// no_plan for starts that overlap, also with an obstacle, goals that overlap of robots that have
  /// no other one, and robots that can reach no goal, or none by the deadline.
  [[nodiscard]] Result<continuous::Instance> instance() const;

 private:
  friend class Robot;
  friend class Session;
  struct Entry {
    RobotSpec spec;
    std::optional<VertexId> start = {};
    std::optional<Goals> goals = {};
    std::optional<UnderWay> under_way = {};  // instead of a start
    Seconds release = {};
    std::optional<Seconds> deadline = {};
    bool leaves = false;
  };
  using Roads = std::shared_ptr<const continuous::Roadmap>;
  /// What an instance is made of.
  struct Parts {
    std::vector<continuous::Agent> agents;
    Roads roads;
    std::vector<continuous::MovingObstacle> obstacles;
    continuous::Ticks now = 0;
  };
  [[nodiscard]] Result<Parts> parts() const;
  [[nodiscard]] Result<std::vector<continuous::Agent>> agents() const;
  [[nodiscard]] Result<continuous::Agent> agent(AgentId id) const;
  [[nodiscard]] std::optional<Error> add_shapes(continuous::Agent& agent) const;
  [[nodiscard]] Result<continuous::LanePlace> lane_place(AgentId id, const continuous::Agent& agent,
                                                         continuous::Ticks now) const;
  /// Those between the two vertices.
  [[nodiscard]] std::vector<continuous::EdgeId> edges(VertexId from, VertexId to) const;
  [[nodiscard]] std::string lane_name(VertexId from, VertexId to) const;
  [[nodiscard]] Result<Roads> put_under_way(std::vector<continuous::Agent>& agents,
                                            continuous::Ticks now) const;
  [[nodiscard]] Result<std::vector<continuous::MovingObstacle>> obstacles_in_units() const;
  [[nodiscard]] Result<continuous::Ticks> begin_in_units() const;
  [[nodiscard]] continuous::Words words() const;

  Roadmap roadmap_;
  std::set<std::pair<VertexId, VertexId>> closed_;
  IdVector<AgentId, Entry> robots_;
  std::vector<MovingObstacle> obstacles_;
  Seconds begin_ = {};
  bool whole_moves_ = false;
};

}  // namespace quadrille::fleet

QUADRILLE_API_END
