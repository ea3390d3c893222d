// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "quadrille/continuous/pose_roadmap.hpp"
#include "quadrille/continuous/resolution.hpp"
#include "quadrille/continuous/roadmap.hpp"
#include "quadrille/core/export.hpp"
#include "quadrille/core/ids.hpp"
#include "quadrille/core/result.hpp"
#include "quadrille/fleet/units.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::fleet {

using units::Hertz;
using units::Metres;
using units::MetresPerSecond;
using units::Radians;
using units::RadiansPerSecond;
using units::Seconds;

/// A place in the plane, or in space.
struct Point {
  Metres x;
  Metres y;
  Metres z = {};  ///< Height; 0 in the plane.
  friend constexpr bool operator==(const Point&, const Point&) = default;
};

/// The distance of two places.
[[nodiscard]] Metres distance(const Point& a, const Point& b);

/// What places and times are rounded to: all coordinates become multiples of `length` and all times
/// multiples of `time`, each to the nearest.
struct Resolution {
  Metres length = Metres(0.001);
  Seconds time = Seconds(0.01);
  friend constexpr bool operator==(const Resolution&, const Resolution&) = default;
};

/// A kind of robots, for which lanes can be reserved. Made by RoadmapBuilder::group.
using Group = continuous::GroupId;

/// Who may use a lane, and how fast.
struct LaneSpec {
  std::vector<Group> only = {};  ///< Robots of these groups; none: all robots.
  /// Nobody goes faster than that.
  std::optional<MetresPerSecond> speed_limit = {};
  /// What it takes whoever goes along it, rounded up to whole steps of time. Not with a limit.
  std::optional<Seconds> duration = {};
  /// One group of robots, for whom the limit or the duration is another one, or none.
  struct Kind {
    Group group;
    std::optional<MetresPerSecond> speed_limit = {};
    std::optional<Seconds> duration = {};
    friend bool operator==(const Kind&, const Kind&) = default;
  };
  std::vector<Kind> kinds = {};  ///< Each group once, and only groups that may use the lane.
  friend bool operator==(const LaneSpec&, const LaneSpec&) = default;
};

/// Vertices in the plane or in space, joined by straight lanes. Immutable; cheap to copy.
class Roadmap {
 public:
  [[nodiscard]] Resolution resolution() const noexcept { return resolution_; }
  [[nodiscard]] std::size_t num_vertices() const noexcept { return roads_->num_vertices(); }
  /// Lanes go one way; a road is two of them.
  [[nodiscard]] std::size_t num_lanes() const noexcept { return roads_->num_edges(); }
  [[nodiscard]] IdRange<VertexId> vertex_ids() const { return IdRange<VertexId>(num_vertices()); }
  /// That RoadmapBuilder::group has made.
  [[nodiscard]] std::size_t num_groups() const noexcept { return num_groups_; }

  /// Where the vertex is, rounded to the resolution. Requires a vertex of this roadmap.
  [[nodiscard]] Point position(VertexId v) const;
  /// The name that the vertex was given, or its place, such as "(1.5 m, 2 m)", with its height if
  /// it has one.
  [[nodiscard]] std::string name(VertexId v) const;
  /// The vertex of this name, among those that were given one.
  [[nodiscard]] std::optional<VertexId> find(std::string_view name) const;
  /// The vertex nearest to a place, of several the one that was made first. Requires a vertex.
  /// Linear in the number of vertices.
  [[nodiscard]] VertexId nearest(const Point& place) const;

  /// The same in whole length units, and what these are; for the layers below.
  [[nodiscard]] const std::shared_ptr<const continuous::Roadmap>& in_units() const noexcept {
    return roads_;
  }
  [[nodiscard]] continuous::Resolution unit_sizes() const noexcept {
    return {resolution_.length.value(), resolution_.time.value()};
  }
  /// Of robots that are not round: from where to where they face while they have a shape
  /// (continuous::ShapeId), by its number. Null unless vertices are poses.
  using Turn = continuous::HeadingTurn;
  [[nodiscard]] const std::vector<Turn>* turns() const noexcept { return turns_.get(); }

 private:
  friend class RoadmapBuilder;
  friend class PoseBuilder;
  Roadmap() = default;
  Resolution resolution_;
  std::size_t num_groups_ = 0;
  std::shared_ptr<const continuous::Roadmap> roads_;
  std::shared_ptr<const std::vector<std::string>> names_;  // By vertex; empty for none.
  std::shared_ptr<const std::map<std::string, VertexId, std::less<>>> by_name_;
  std::shared_ptr<const std::vector<Turn>> turns_;
};

/// Collects the vertices and roads of a Roadmap. A copy of it can go on in another direction.
class RoadmapBuilder {
 public:
  explicit RoadmapBuilder(Resolution resolution = {}) : resolution_(resolution) {}

  /// A new vertex. Names are optional.
  VertexId vertex(const Point& place, std::string name = {});
  VertexId vertex(Metres x, Metres y, std::string name = {}) {
    return vertex(Point{x, y}, std::move(name));
  }
  /// One with a height. Then all robots have to be discs, which are spheres there.
  VertexId vertex(Metres x, Metres y, Metres z, std::string name = {}) {
    return vertex(Point{x, y, z}, std::move(name));
  }
  /// A new group of robots: RobotSpec::group. At most continuous::kMaxGroups - 1.
  Group group() { return Group(++num_groups_); }
  /// A road for both directions, or a lane for one. The roads of a roadmap are a set: one that is
  /// there already may be given again, as it is.
  RoadmapBuilder& road(VertexId a, VertexId b, LaneSpec spec = {});
  RoadmapBuilder& lane(VertexId from, VertexId to, LaneSpec spec = {});
  /// Nobody may wait at the vertex, and so nobody begins or stays there: who comes goes on at once.
  RoadmapBuilder& no_waiting(VertexId v);
  /// Takes out what joins the two vertices, in both directions. Vertices keep their ids.
  RoadmapBuilder& close(VertexId a, VertexId b);

  [[nodiscard]] Resolution resolution() const noexcept { return resolution_; }
  [[nodiscard]] std::size_t num_vertices() const noexcept { return places_.size(); }
  /// As it was given, not rounded. Requires a vertex that has been made.
  [[nodiscard]] const Point& position(VertexId v) const { return places_[v.index()]; }

  /// Errors: out_of_range for a resolution that is not positive and for coordinates beyond 2^40
  /// times the resolution, speed limits and durations that are not supported at it;
  /// invalid_instance for a name given twice, a lane from a vertex to itself, between vertices in
  /// the same place once they are rounded, with an end that does not exist, for a group that this
  /// builder has not made, with a limit and a duration, told twice of a group or of one that may
  /// not use it, or given twice in different ways, and for a vertex where nobody may wait that does
  /// not exist or is told twice.
  [[nodiscard]] Result<Roadmap> build() const;

 private:
  struct Lane {
    VertexId from, to;
    LaneSpec spec;
  };
  [[nodiscard]] std::string name_of(VertexId v) const;
  [[nodiscard]] bool is_made(Group group) const {
    return group.index() >= 1 && group.index() <= num_groups_;
  }
  [[nodiscard]] Result<continuous::Groups> groups(const LaneSpec& spec,
                                                  const std::string& what) const;
  /// Sets the limit or the duration of an edge.
  [[nodiscard]] std::optional<Error> set_pace(continuous::Edge& edge,
                                              std::optional<MetresPerSecond> speed_limit,
                                              std::optional<Seconds> duration,
                                              const std::string& what) const;
  /// One edge for all who are alike.
  [[nodiscard]] std::optional<Error> add_edges(const Lane& lane, const std::string& what,
                                               std::vector<continuous::Edge>& edges) const;
  [[nodiscard]] Result<std::vector<continuous::Point>> rounded_places() const;
  [[nodiscard]] Result<std::vector<continuous::Edge>> edges(
      const std::vector<continuous::Point>& points) const;

  Resolution resolution_;
  std::vector<Point> places_;
  std::vector<std::string> names_;
  std::vector<Lane> lanes_;
  std::vector<VertexId> no_waiting_;
  std::size_t num_groups_ = 0;
};

}  // namespace quadrille::fleet

QUADRILLE_API_END
