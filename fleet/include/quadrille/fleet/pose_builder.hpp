// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "quadrille/core/contract.hpp"
#include "quadrille/core/export.hpp"
#include "quadrille/core/ids.hpp"
#include "quadrille/core/result.hpp"
#include "quadrille/fleet/roadmap.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::fleet {

/// A roadmap for robots that turn. Each vertex is a pose: a place, which is a vertex of the roadmap
/// that it was made of, with a heading. The poses of a place are all where it is. Their names are
/// those of places with the heading, "dock facing 90 deg". Immutable; cheap to copy.
class PoseRoadmap {
 public:
  /// For Fleet.
  [[nodiscard]] const Roadmap& roadmap() const noexcept { return roadmap_; }
  [[nodiscard]] std::size_t num_places() const noexcept { return poses_.size(); }

  /// Requires a vertex of `roadmap()`.
  [[nodiscard]] VertexId place(VertexId pose) const {
    QUADRILLE_REQUIRE(pose.index() < places_.size(), "a pose");
    return places_[pose];
  }
  /// From 0 to 360 degrees: 0 along x, 90 degrees along y. Requires a vertex of `roadmap()`.
  [[nodiscard]] Radians heading(VertexId pose) const {
    QUADRILLE_REQUIRE(pose.index() < headings_.size(), "a pose");
    return headings_[pose];
  }

  /// All poses of a place by increasing heading: where a robot may go if its heading there does not
  /// matter, as Robot::to_any takes it. At least one. Requires a place.
  [[nodiscard]] const std::vector<VertexId>& any_heading(VertexId place) const {
    QUADRILLE_REQUIRE(place.index() < poses_.size(), "a place");
    return poses_[place];
  }
  /// Of these the one that faces most nearly there; of two the one with the smaller heading.
  /// Requires a place and a finite heading.
  [[nodiscard]] VertexId facing(VertexId place, Radians heading) const;

 private:
  friend class PoseBuilder;
  explicit PoseRoadmap(Roadmap roadmap) : roadmap_(std::move(roadmap)) {}
  Roadmap roadmap_;
  IdVector<VertexId, VertexId> places_;  // by pose
  IdVector<VertexId, Radians> headings_;
  IdVector<VertexId, std::vector<VertexId>> poses_;  // by place
};

/// Makes a roadmap of poses of one of places. At each place there are the headings of the lanes
/// that begin or end there, and those of `heading`; 0 where there are none. A robot goes along a
/// lane if it faces the lane's way, up to a degree, or for cars up to their greatest steering; it
/// faces exactly that way when it arrives. In between a robot that is no car turns where it stands.
///
/// A polygon is that of a robot that faces along x, and turns with it. While the robot turns, and
/// while a car goes along a lane whose way it does not face exactly, it takes up all that it
/// sweeps, by the shorter way round; half a turn goes counter-clockwise (geometry::swept_by_turn).
/// Groups of the roadmap are kinds of robots, which may turn in different ways.
class PoseBuilder {
 public:
  /// Changes of heading that count as none.
  static constexpr Radians kStraight = units::degrees(1);

  /// `turn_rate`: how fast robots turn of whom nothing else is said.
  PoseBuilder(Roadmap places, RadiansPerSecond turn_rate)
      : places_(std::move(places)), others_{turn_rate, kStraight} {}

  /// One more heading at a place, where a robot begins, say, or has to end.
  PoseBuilder& heading(VertexId place, Radians heading);
  /// Robots of this group turn faster or slower, or as all others after all.
  PoseBuilder& turn_rate(Group group, RadiansPerSecond rate);
  /// Robots of this group, or all of whom nothing else is said, do not turn where they stand: from
  /// one lane to the next their heading changes by at most `max_steer`.
  PoseBuilder& car(Radians max_steer);
  PoseBuilder& car(Group group, Radians max_steer);

  /// Turns take the angle divided by the rate, rounded up to the resolution; by the shorter way
  /// round. Lanes take what they take, and are for the same groups. Errors: out_of_range for a rate
  /// that is not positive, or so slow or fast that half a turn takes longer than is supported, a
  /// steering outside [0, 180] degrees, a heading that is not finite; invalid_instance for a
  /// place or group that the roadmap does not have, and lanes that go straight up or down, which
  /// have no heading. Time and size: per place the square of its headings, per lane the headings
  /// where it begins.
  [[nodiscard]] Result<PoseRoadmap> build() const;

 private:
  /// How robots of some groups turn.
  struct Kind {
    std::optional<RadiansPerSecond> rate;  // none: not where they stand
    Radians steer;
  };
  struct Members {
    Kind kind;
    continuous::Groups groups;
  };
  class Poses;  // that are being made
  [[nodiscard]] std::optional<Error> check() const;
  [[nodiscard]] std::vector<Members> kinds() const;

  Roadmap places_;
  Kind others_;
  std::vector<std::pair<Group, Kind>> groups_;
  std::vector<std::pair<VertexId, Radians>> headings_;
};

}  // namespace quadrille::fleet

QUADRILLE_API_END
