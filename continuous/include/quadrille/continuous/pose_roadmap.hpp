// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "quadrille/continuous/heading_rules.hpp"
#include "quadrille/continuous/instance.hpp"
#include "quadrille/continuous/roadmap.hpp"
#include "quadrille/core/export.hpp"
#include "quadrille/core/ids.hpp"
#include "quadrille/core/result.hpp"
#include "quadrille/geometry/turning.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::continuous {

/// From where to where a robot faces while it has a shape; the same while it does not turn.
struct HeadingTurn {
  geometry::Direction from, to;
  friend bool operator==(const HeadingTurn&, const HeadingTurn&) = default;
};

/// How the robots of some groups turn.
struct Turning {
  Groups groups;
  /// Radians per tick where they stand; none: not there.
  std::optional<double> rate;
  /// Changes of heading, in radians, that they need no time for when they go along a lane.
  double steer = kStraight;

  /// Changes of heading that count as none: one degree.
  static constexpr double kStraight = 0.017453292519943295;
};

/// A roadmap for robots that turn. Each vertex is a pose: a place, which is a vertex of the roadmap
/// that it was made of, with a heading. The poses of a place are all where it is. Immutable; cheap
/// to copy. Headings are in radians, in [0, 2 pi): 0 along x, pi / 2 along y.
class PoseRoadmap {
 public:
  /// At each place there are the headings of the lanes that begin or end there, those of `rules`,
  /// and 0 where there are none. A robot goes along a lane if it faces the lane's way, or as
  /// HeadingRules::lanes says, up to its `steer`, and faces exactly so when it arrives. In between
  /// it turns where it stands, by the shorter way round: the angle divided by the rate, rounded up
  /// to whole ticks. Lanes take what they take, and are for the same groups. Each group is in one
  /// of `kinds`.
  ///
  /// At a place where HeadingRules::stands says how robots stand there are two poses for each other
  /// heading, of those who arrive and of those who leave: they turn to how they stand in between.
  ///
  /// Errors: out_of_range for a rate that is not positive, or so slow or fast that half a turn
  /// takes longer than kMaxDuration, a steering outside [0, pi], angles that are not finite;
  /// invalid_instance for places that `places` does not have, lanes of `rules` that it does not
  /// have, a place that is told twice how robots stand there, lanes that go straight up or down,
  /// which have no heading, and places in the middle of moves. Time and size: per place the square
  /// of its headings, per lane the headings where it begins.
  [[nodiscard]] static Result<PoseRoadmap> make(const Roadmap& places,
                                                std::span<const Turning> kinds,
                                                const HeadingRules& rules = {});

  [[nodiscard]] const std::shared_ptr<const Roadmap>& roadmap() const noexcept { return roadmap_; }
  [[nodiscard]] std::size_t num_places() const noexcept { return poses_.size(); }
  /// Requires a vertex of `roadmap`.
  [[nodiscard]] VertexId place(VertexId pose) const {
    QUADRILLE_REQUIRE(pose.index() < places_.size(), "a pose");
    return places_[pose];
  }
  /// Requires a vertex of `roadmap`.
  [[nodiscard]] double heading(VertexId pose) const {
    QUADRILLE_REQUIRE(pose.index() < headings_.size(), "a pose");
    return headings_[pose];
  }
  /// All poses of a place in which robots stay, by increasing heading. At least one. Requires a
  /// place.
  [[nodiscard]] const std::vector<VertexId>& any_heading(VertexId place) const {
    QUADRILLE_REQUIRE(place.index() < stays_.size(), "a place");
    return stays_[place];
  }
  /// Of all poses in which a robot may arrive or stay at a place the one that faces most nearly
  /// there; of two the one with the smaller heading. Requires a place and a finite heading.
  [[nodiscard]] VertexId facing(VertexId place, double heading) const;

  /// Whether it is one of those who leave a place where robots stand as HeadingRules::stands says.
  /// Linear in the poses of the place. Requires a vertex of `roadmap`.
  [[nodiscard]] bool is_leaving(VertexId pose) const;

  /// By ShapeId: what a robot that is no disc does while it has that shape. The first: it faces
  /// along x, and has the body as it is given.
  [[nodiscard]] const std::shared_ptr<const std::vector<HeadingTurn>>& turns() const noexcept {
    return turns_;
  }

 private:
  PoseRoadmap() = default;
  class Making;
  std::shared_ptr<const Roadmap> roadmap_;
  std::shared_ptr<const std::vector<HeadingTurn>> turns_;
  IdVector<VertexId, VertexId> places_;  // by pose
  IdVector<VertexId, double> headings_;
  IdVector<VertexId, std::vector<VertexId>> poses_;  // by place: where robots arrive or stay
  IdVector<VertexId, std::vector<VertexId>> stays_;
};

/// Agent::shapes of a body that turns: as it is, or all that it sweeps, by the shorter way round;
/// half a turn goes counter-clockwise. None for a disc. Errors: out_of_range for one that is too
/// large to turn.
[[nodiscard]] Result<std::vector<Body>> shapes_of(const Body& body,
                                                  const std::vector<HeadingTurn>& turns);

}  // namespace quadrille::continuous

QUADRILLE_API_END
