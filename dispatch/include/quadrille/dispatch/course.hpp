// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "quadrille/core/export.hpp"
#include "quadrille/core/ids.hpp"
#include "quadrille/geometry/point.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::dispatch {

using geometry::Ticks;

/// Where a robot is: at a vertex (from == to), or on the lane from one vertex to another one, which
/// takes it `whole` ticks, of which `behind` are over.
struct Spot {
  VertexId from, to;
  Ticks behind = 0;
  Ticks whole = 1;

  Spot() = default;
  Spot(VertexId vertex) : from(vertex), to(vertex) {}  // NOLINT: a vertex is a spot
  Spot(VertexId of_from, VertexId of_to, Ticks of_behind, Ticks of_whole)
      : from(of_from), to(of_to), behind(of_behind), whole(of_whole) {}
  [[nodiscard]] bool is_vertex() const noexcept { return from == to; }
  friend bool operator==(const Spot&, const Spot&) = default;
};

/// A stay from `arrive` to `depart`, equal where the robot passes through. Within a lane it stops
/// where it was held up.
struct Stop {
  Spot spot;
  Ticks arrive = 0;
  Ticks depart = 0;
  friend bool operator==(const Stop&, const Stop&) = default;
};

/// What a robot does: it stands at its stops, and goes from each to the next one without a stop.
/// The first one begins, and the last one is for ever. At least one stop. Two that follow each
/// other are the ends of a lane, or on the same lane.
using Course = std::vector<Stop>;

/// When the last stop begins.
[[nodiscard]] inline Ticks end_of(const Course& course) { return course.back().arrive; }
/// Where who follows it is at that time: at its first stop before it begins, at its last one after
/// that. Linear, as all of these.
[[nodiscard]] Spot spot_at(const Course& course, Ticks time);
/// Whether it stands then, for some time after it too, or has arrived.
[[nodiscard]] bool stands_at(const Course& course, Ticks time);
/// What it does from that time on: the first stop is where it is then.
[[nodiscard]] Course since(const Course& course, Ticks time);
/// What it does until then: the last stop is where it is then, and ends then.
[[nodiscard]] Course until(const Course& course, Ticks time);
/// One after the other: the second begins where and when the first ends.
[[nodiscard]] Course joined(Course first, const Course& second);
/// So much later.
[[nodiscard]] Course shifted(Course course, Ticks by);

}  // namespace quadrille::dispatch

QUADRILLE_API_END
