// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "advancement.hpp"
#include "hints.hpp"
#include "quadrille/geometry/body_pair.hpp"

namespace quadrille::geometry {

/// What a pair with at least one polygon needs beyond the sum of the radii: the corners of a grown
/// by the mirrored b. The bodies are apart when b's position relative to a's is at least `reach`
/// from that polygon.
class BodyPair::Shape {
 public:
  Shape(const Body& a, const Body& b, Length reach);

  [[nodiscard]] const std::vector<Point>& corners() const noexcept { return corners_; }
  /// The largest coordinate, `reach` included.
  [[nodiscard]] Length size() const noexcept { return size_; }
  /// Around the origin: a disc of the radius `inner` is inside of the polygon, none if negative;
  /// one of the radius `outer` contains it.
  [[nodiscard]] double inner() const noexcept { return inner_; }
  [[nodiscard]] double outer() const noexcept { return outer_; }
  [[nodiscard]] const Body& a() const noexcept { return a_; }
  [[nodiscard]] const Body& b() const noexcept { return b_; }

  /// Whether a position, off by at most `error`, is one at which the bodies meet for certain.
  [[nodiscard]] bool contains(Vec position, double error) const;
  /// Whether the bodies of these motions meet for certain at some offset at which one of them
  /// begins or ends. Doubles; false says nothing.
  [[nodiscard]] bool meet_at_ends(const Motion& a, const Motion& b) const;
  /// Doubles: 1 if the bodies meet along the path for certain, -1 if they do not, 0 in doubt.
  [[nodiscard]] int filter(const RelativePath& path) const;
  /// The smallest distance between the path and the polygon, the radius not subtracted; 0 if they
  /// meet. Off by at most path.error.
  [[nodiscard]] double distance(const RelativePath& path) const;
  /// Without guarantee.
  [[nodiscard]] RealInterval likely_offsets(const Motion& a, const Motion& b) const;

 private:
  // Whether they meet along the path for certain.
  [[nodiscard]] bool meets(const RelativePath& path) const;
  // How far the path stays outside of one of the sides; not positive if it does of none.
  [[nodiscard]] double outside(const RelativePath& path) const;
  // Whether straight lines normal to a direction keep the path from coming within the bodies'
  // reach.
  [[nodiscard]] bool keeps_apart(Vec direction, const RelativePath& path) const;
  // Whether some direction does.
  [[nodiscard]] bool is_apart(const RelativePath& path) const;
  // How deep the path gets into the polygon; negative if it does not meet it.
  [[nodiscard]] double depth(const RelativePath& path) const;

  Body a_;
  Body b_;
  Length reach_;
  std::vector<Point> corners_;
  std::vector<Vec> vecs_;     // The corners.
  std::vector<Vec> normals_;  // Of unit length, outward; the i-th of the side after corner i.
  Length size_ = 0;
  double inner_ = std::numeric_limits<double>::infinity(), outer_ = 0;
  Advancement advancement_;
};

}  // namespace quadrille::geometry
