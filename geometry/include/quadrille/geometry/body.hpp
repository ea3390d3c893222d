// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <variant>
#include <vector>

#include "quadrille/core/export.hpp"
#include "quadrille/core/result.hpp"
#include "quadrille/geometry/point.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::geometry {

/// A disc around the agent's position; where motions leave the plane, the ball of that radius.
struct Disc {
  Length radius = 1;  ///< Length units; 1 <= radius <= kMaxLength.

  friend bool operator==(const Disc&, const Disc&) = default;
};

/// A convex polygon that moves with the agent, stays at one height, and never turns. Immutable;
/// copies share the corners.
class ConvexPolygon {
 public:
  /// Most corners that a polygon may have.
  static constexpr std::size_t kMaxVertices = 64;

  /// `vertices`: the corners relative to the agent's position (which need not lie inside), in
  /// order, either way round; kept counter-clockwise, starting with the one given first. Errors:
  /// invalid_instance if there are fewer than three, if one repeats, if one has a height, if three
  /// consecutive ones are on a line, or if they do not form a convex polygon; out_of_range beyond
  /// kMaxLength or kMaxVertices. Nothing is repaired.
  [[nodiscard]] static Result<ConvexPolygon> make(std::vector<Point> vertices);

  /// Counter-clockwise, strictly convex.
  [[nodiscard]] const std::vector<Point>& vertices() const noexcept { return *vertices_; }

  friend bool operator==(const ConvexPolygon& p, const ConvexPolygon& q) {
    return p.vertices() == q.vertices();
  }

 private:
  explicit ConvexPolygon(std::vector<Point> vertices)
      : vertices_(std::make_shared<const std::vector<Point>>(std::move(vertices))) {}

  std::shared_ptr<const std::vector<Point>> vertices_;  // Shared by the copies.
};

/// The shape of an agent. Its boundary does not count: bodies collide when their *interiors* meet.
using Body = std::variant<Disc, ConvexPolygon>;

/// The radius of the smallest disc (ball) around the agent's position that contains the body,
/// rounded up to a whole length unit: of a disc its radius. At most sqrt(2) kMaxLength, rounded up.
/// Linear in the number of corners.
[[nodiscard]] Length enclosing_radius(const Body& body);

}  // namespace quadrille::geometry

QUADRILLE_API_END
