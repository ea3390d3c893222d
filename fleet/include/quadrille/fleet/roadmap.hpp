// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "quadrille/continuous/resolution.hpp"
#include "quadrille/continuous/roadmap.hpp"
#include "quadrille/core/export.hpp"
#include "quadrille/core/ids.hpp"
#include "quadrille/core/result.hpp"
#include "quadrille/fleet/units.hpp"
#include "quadrille/geometry/turning.hpp"

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

/// Who may use a lane.
struct LaneSpec {
  std::vector<Group> only = {};  ///< Robots of these groups; none: all robots.
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
  struct Turn {
    geometry::Direction from, to;
  };
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
  /// there already may be given again, to the same groups.
  RoadmapBuilder& road(VertexId a, VertexId b, LaneSpec spec = {});
  RoadmapBuilder& lane(VertexId from, VertexId to, LaneSpec spec = {});
  /// Takes out what joins the two vertices, in both directions. Vertices keep their ids.
  RoadmapBuilder& close(VertexId a, VertexId b);

  [[nodiscard]] Resolution resolution() const noexcept { return resolution_; }
  [[nodiscard]] std::size_t num_vertices() const noexcept { return places_.size(); }
  /// As it was given, not rounded. Requires a vertex that has been made.
  [[nodiscard]] const Point& position(VertexId v) const { return places_[v.index()]; }

  /// Errors: out_of_range for a resolution that is not positive and for coordinates beyond 2^40
  /// times the resolution; invalid_instance for a name given twice, a lane from a vertex to itself,
  /// between vertices in the same place once they are rounded, with an end that does not exist, for
  /// a group that this builder has not made, or given twice to different groups.
  [[nodiscard]] Result<Roadmap> build() const;

 private:
  struct Lane {
    VertexId from, to;
    LaneSpec spec;
  };
  [[nodiscard]] std::string name_of(VertexId v) const;
  [[nodiscard]] Result<std::vector<continuous::Point>> rounded_places() const;
  [[nodiscard]] Result<std::vector<continuous::Edge>> edges(
      const std::vector<continuous::Point>& points) const;

  Resolution resolution_;
  std::vector<Point> places_;
  std::vector<std::string> names_;
  std::vector<Lane> lanes_;
  std::size_t num_groups_ = 0;
};

}  // namespace quadrille::fleet

QUADRILLE_API_END
