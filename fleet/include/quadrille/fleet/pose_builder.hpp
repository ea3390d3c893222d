// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "quadrille/continuous/heading_rules.hpp"
#include "quadrille/continuous/pose_roadmap.hpp"
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
  [[nodiscard]] std::size_t num_places() const noexcept { return poses_.num_places(); }

  /// Requires a vertex of `roadmap()`.
  [[nodiscard]] VertexId place(VertexId pose) const { return poses_.place(pose); }
  /// From 0 to 360 degrees: 0 along x, 90 degrees along y. Requires a vertex of `roadmap()`.
  [[nodiscard]] Radians heading(VertexId pose) const { return Radians(poses_.heading(pose)); }

  /// All poses of a place in which robots stay, by increasing heading: where a robot may go if its
  /// heading there does not matter, as Robot::to_any takes it. At least one. Requires a place.
  [[nodiscard]] const std::vector<VertexId>& any_heading(VertexId place) const {
    return poses_.any_heading(place);
  }
  /// Of those in which robots arrive or stay at a place the one that faces most nearly there; of
  /// two the one with the smaller heading. Requires a place and a finite heading.
  [[nodiscard]] VertexId facing(VertexId place, Radians heading) const {
    return poses_.facing(place, heading.value());
  }

 private:
  friend class PoseBuilder;
  PoseRoadmap(Roadmap roadmap, continuous::PoseRoadmap poses)
      : roadmap_(std::move(roadmap)), poses_(std::move(poses)) {}
  Roadmap roadmap_;
  continuous::PoseRoadmap poses_;
};

/// In which directions robots may turn at a place.
enum class Turns { none, counter_clockwise, clockwise, both };

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
  static constexpr Radians kStraight = Radians(continuous::Turning::kStraight);

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

  /// Whoever goes along the lane faces so all the way, and not ahead: backwards, say, or sideways.
  /// Told several times: in any one of these headings.
  PoseBuilder& lane_heading(VertexId from, VertexId to, Radians heading);
  /// Whoever comes to the place turns to that heading, and stays in it or goes on from it.
  PoseBuilder& stand(VertexId place, Radians heading);
  /// In which directions robots may turn at a place, and how fast at most. What is told several
  /// times holds together. To get round in one direction they turn by several steps.
  PoseBuilder& turns(VertexId place, Turns allowed, std::optional<RadiansPerSecond> most = {});
  /// What a layout says, as add_layout gives it. Rates are per step of time of the roadmap.
  PoseBuilder& rules(const continuous::HeadingRules& rules);

  /// Turns take the angle divided by the rate, rounded up to the resolution; by the shorter way
  /// round. Lanes take what they take, and are for the same groups. Errors: out_of_range for a rate
  /// that is not positive, or so slow or fast that half a turn takes longer than is supported, a
  /// steering outside [0, 180] degrees, a heading that is not finite; invalid_instance for a
  /// place, lane or group that the roadmap does not have, a place that is told two headings in
  /// which robots stand, and lanes that go straight up or down, which have no heading. Time and
  /// size: per place the square of its headings, per lane the headings where it begins.
  [[nodiscard]] Result<PoseRoadmap> build() const;

 private:
  /// How robots of some groups turn.
  struct Kind {
    std::optional<RadiansPerSecond> rate;  // none: not where they stand
    Radians steer;
  };
  [[nodiscard]] std::optional<Error> check() const;
  [[nodiscard]] std::optional<Error> check_rules() const;
  [[nodiscard]] double per_tick(RadiansPerSecond rate) const;
  [[nodiscard]] std::vector<continuous::Turning> kinds() const;

  Roadmap places_;
  Kind others_;
  std::vector<std::pair<Group, Kind>> groups_;
  continuous::HeadingRules rules_;
};

}  // namespace quadrille::fleet

QUADRILLE_API_END
