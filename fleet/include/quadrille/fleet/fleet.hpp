// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "quadrille/continuous/instance.hpp"
#include "quadrille/core/export.hpp"
#include "quadrille/core/ids.hpp"
#include "quadrille/core/result.hpp"
#include "quadrille/fleet/roadmap.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::fleet {

/// A disc around the robot's position. Rounded up to the resolution: the robot is never larger than
/// planned.
struct Disc {
  Metres radius;
  constexpr explicit Disc(Metres of_radius) : radius(of_radius) {}
  friend constexpr bool operator==(const Disc&, const Disc&) = default;
};

/// A convex polygon around the robot's position, which it keeps without turning; a robot that turns
/// is a disc around all its orientations. `corners`: relative to the position, in order, either way
/// round; 3 .. 64. Each coordinate is rounded to the nearest multiple of the resolution.
struct Polygon {
  std::vector<Point> corners;
  explicit Polygon(std::vector<Point> of_corners) : corners(std::move(of_corners)) {}
  friend bool operator==(const Polygon&, const Polygon&) = default;
};

using Body = std::variant<Disc, Polygon>;

/// What a robot is. Without a name it is called "robot 3", by its number.
struct RobotSpec {
  std::string name = {};
  Body body = Disc(Metres(0));  ///< Has to be given.
  /// On all lanes. How long a lane takes is rounded to the nearest multiple of the resolution of
  /// time, so that a robot may be faster or slower by up to half of that per lane.
  MetresPerSecond speed = {};
  friend bool operator==(const RobotSpec&, const RobotSpec&) = default;
};

class Fleet;

/// A robot of a fleet, to be told its task: `fleet.robot({...}).from(a).to(b)`. To be used while
/// the fleet is where it is. What it converts to, its id, stays valid.
class Robot {
 public:
  /// Where it begins. Requires a vertex of the roadmap.
  Robot from(VertexId start) const;  // NOLINT: part of a chain
  /// Where it goes, and stays. Requires a vertex of the roadmap.
  Robot to(VertexId goal) const;  // NOLINT: part of a chain

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

  /// Another robot. Whether it makes sense is checked by `instance`.
  Robot robot(RobotSpec spec);
  /// One that is there already, to be given another task. Requires a robot of this fleet.
  [[nodiscard]] Robot operator[](AgentId id);

  [[nodiscard]] const Roadmap& roadmap() const noexcept { return roadmap_; }
  /// Roads that were closed or opened. Requires the vertices to be the same in number.
  void set_roadmap(Roadmap roadmap);

  [[nodiscard]] std::size_t num_robots() const noexcept { return robots_.size(); }
  [[nodiscard]] IdRange<AgentId> robot_ids() const { return IdRange<AgentId>(num_robots()); }
  [[nodiscard]] const RobotSpec& spec(AgentId id) const { return robots_[id].spec; }
  [[nodiscard]] std::string name(AgentId id) const;
  [[nodiscard]] std::optional<AgentId> find(std::string_view name) const;
  /// nullopt as long as it has not been told.
  [[nodiscard]] std::optional<VertexId> start(AgentId id) const { return robots_[id].start; }
  [[nodiscard]] std::optional<VertexId> goal(AgentId id) const { return robots_[id].goal; }

  /// The same in whole units, as the solver takes it. Errors name robots and vertices:
  /// invalid_instance for a robot without body, start or goal, a name given twice, a polygon that
  /// is not convex; out_of_range for sizes and speeds that are not supported at this resolution;
  /// no_plan for starts or goals that overlap and goals that cannot be reached.
  [[nodiscard]] Result<continuous::Instance> instance() const;

 private:
  friend class Robot;
  struct Entry {
    RobotSpec spec;
    std::optional<VertexId> start, goal;
  };
  [[nodiscard]] Result<std::vector<continuous::Agent>> agents() const;
  [[nodiscard]] Error in_words(const Error& error,
                               const std::vector<continuous::Agent>& agents) const;
  [[nodiscard]] std::optional<Error> find_unsupported(
      const std::vector<continuous::Agent>& agents) const;
  [[nodiscard]] std::optional<Error> find_overlap(const std::vector<continuous::Agent>& agents,
                                                  VertexId continuous::Agent::*end,
                                                  const std::string& what) const;

  Roadmap roadmap_;
  IdVector<AgentId, Entry> robots_;
};

}  // namespace quadrille::fleet

QUADRILLE_API_END
