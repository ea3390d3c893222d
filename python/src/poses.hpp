// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "quadrille/continuous/pose_roadmap.hpp"
#include "timed.hpp"

namespace quadrille::python {

/// A roadmap for robots that turn, and what it was made of.
struct PoseMap {
  std::shared_ptr<continuous::Roadmap> places;
  py::list kinds;  ///< [(groups as bits, radians per tick or None, steering in radians)]
  py::dict rules;  ///< As rules_of_headings gives them.
  continuous::PoseRoadmap poses;
};

/// "further" and "stands": [(place, heading)], "lanes": [(from, to, heading)], "turns": [(place,
/// counter-clockwise, clockwise, most)]; angles in radians, rates per tick.
py::dict rules_of_headings(const continuous::HeadingRules& rules);

}  // namespace quadrille::python
