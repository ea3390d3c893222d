// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "quadrille/execution/precedences.hpp"
#include "snapshot.hpp"

namespace quadrille::dispatch {

/// The fleet as far as it matters for who goes first. All by robot.
struct Traffic {
  std::shared_ptr<const Roadmap> roadmap;
  continuous::Resolution resolution;
  std::vector<continuous::Agent> agents;
  /// The plan: at `origin` all were where their courses say, or behind on their own, see below.
  Ticks origin = 0;
  /// Clocks; one that is before `origin` is that of a robot that goes there alone: it has been
  /// allowed to, by all others as they stand.
  std::vector<Ticks> clocks;
};

/// How far each clock may run on some courses, and the order of moves that this follows from.
struct RightOfWay {
  std::vector<Ticks> limits;
  execution::Precedences order;
};

/// Nothing if the courses collide. What lies before the earliest clock is left out. A robot whose
/// clock is before the origin leads all others on what it has still to go until then, in whole
/// moves.
[[nodiscard]] std::optional<RightOfWay> find_right_of_way(const Traffic& traffic,
                                                          std::span<const Course> courses);

}  // namespace quadrille::dispatch
