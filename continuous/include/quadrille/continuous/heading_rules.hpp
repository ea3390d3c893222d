// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <vector>

#include "quadrille/core/export.hpp"
#include "quadrille/core/ids.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::continuous {

/// What the places and lanes of a roadmap say of the headings of robots, for PoseRoadmap. Angles
/// are in radians, 0 along x, a quarter turn along y. What is told of a place several times holds
/// together.
struct HeadingRules {
  struct Heading {
    VertexId place;
    double heading = 0;
  };
  struct Lane {
    VertexId from, to;
    double heading = 0;
  };
  struct Turns {
    VertexId place;
    bool counter_clockwise = true, clockwise = true;  ///< Which ones are allowed.
    /// Nobody turns faster there, in radians per tick.
    double most = std::numeric_limits<double>::infinity();
  };
  std::vector<Heading> further;  ///< Headings besides those of the lanes.
  /// Who goes along the lane faces so all the way, instead of ahead; of several in any one of them.
  std::vector<Lane> lanes;
  /// Whoever comes to the place turns to that heading, and stays in it, or goes on from it.
  std::vector<Heading> stands;
  std::vector<Turns> turns;
};

}  // namespace quadrille::continuous

QUADRILLE_API_END
