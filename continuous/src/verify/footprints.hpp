// SPDX-License-Identifier: MIT
#pragma once

#include <boost/multiprecision/cpp_int.hpp>
#include <vector>

#include "quadrille/continuous/instance.hpp"

// Two bodies, one of which moves straight as seen from the other: how near they come, and whether
// their interiors meet. On purpose this uses nothing of geometry/ but the shapes themselves: an
// independent opinion.
namespace quadrille::continuous {

using Integer = boost::multiprecision::cpp_int;

struct RealPoint {
  long double x, y, z = 0;
};
/// Of the plane, in length units.
struct FlatPoint {
  long double x, y;
};
/// From where to where b's position moves as seen from a's, in length units.
struct RealStep {
  RealPoint from, to;
};

struct ExactPoint {
  Integer x, y, z = 0;
};
/// The same, multiplied by `scale`, which is positive.
struct ExactStep {
  ExactPoint from, to;
  Integer scale;
};

/// Places of b as seen from a, in length units, where each is somewhere on a straight way of its
/// own: from `corner` by a share of `way_a` and one of `way_b`.
struct ExactSweep {
  ExactPoint corner, way_a, way_b;
};

/// Two discs are balls. A polygon requires that steps have no height.
class FootprintPair {
 public:
  /// Both bodies outlive this. Linear in the number of corners.
  FootprintPair(const Body& a, const Body& b);

  /// The least gap along the step, in length units, and when: a share of the step in [0, 1].
  struct Nearest {
    long double gap, share;
  };
  /// Negative when the bodies overlap: by as much one of them has to be moved to touch the other.
  /// For two discs in constant time; else linear in the number of corners, squared at worst where
  /// the bodies overlap or touch.
  [[nodiscard]] Nearest nearest(const RealStep& step) const;
  /// At most nearest(step).gap, at once.
  [[nodiscard]] long double least_gap(const RealStep& step) const;

  /// Whether the interiors meet at some moment of the step. Exact.
  [[nodiscard]] bool interiors_meet(const ExactStep& step) const;
  /// Whether they do at some of these places. Exact.
  [[nodiscard]] bool sweeps_meet(const ExactSweep& sweep) const;

 private:
  [[nodiscard]] bool meet_inside(const ExactSweep& sweep) const;
  /// How far b's position is from `core_`: negative inside. With a polygon.
  [[nodiscard]] long double distance(FlatPoint p) const;
  [[nodiscard]] bool may_enter_core(FlatPoint from, FlatPoint to) const;
  [[nodiscard]] long double deepest_share(FlatPoint from, FlatPoint to) const;

  const Body &a_, &b_;
  long double far_ = 0;  // beyond this distance of the positions the bodies do not meet
  // The bodies touch where b's position is `radius_` from the convex polygon `core_`, which is a's
  // polygon and the mirror image of b's, added up; a single point for two discs.
  long double radius_ = 0;
  std::vector<FlatPoint> core_;
  struct Side {
    FlatPoint from, along;
    long double size;  // length
  };
  std::vector<Side> sides_;  // of the core
};

}  // namespace quadrille::continuous
