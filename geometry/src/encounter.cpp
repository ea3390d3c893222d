// SPDX-License-Identifier: MIT
//
// On purpose this uses nothing of what decides exactly, and none of its floating-point filters.
#include "quadrille/geometry/encounter.hpp"

#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/distance.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <limits>
#include <optional>
#include <vector>

#include "fcl_shapes.hpp"
#include "quadrille/core/contract.hpp"

namespace quadrille::geometry {
namespace {

using Vector = Eigen::Vector3d;

// Each step proves a stretch of time, and most legs take two or three.
constexpr int kMaxSteps = 200;

Vector to_vector(const Point& p) {
  return {static_cast<double>(p.x.value()), static_cast<double>(p.y.value()),
          static_cast<double>(p.z.value())};
}

/// A body about its centre, in length units.
struct Outline {
  Vector centre{0, 0, 0};       // from the agent's position
  std::vector<Vector> corners;  // from the centre; none: a disc
  double radius = 0;            // of a disc
  double inner = 0, outer = 0;  // radii of discs about the centre: inside, and around the body

  explicit Outline(const Body& body) {
    if (const auto* disc = std::get_if<Disc>(&body)) {
      QUADRILLE_REQUIRE(1 <= disc->radius && disc->radius <= kMaxLength, "radius out of range");
      radius = inner = outer = static_cast<double>(disc->radius.value());
      return;
    }
    const std::vector<Point>& vertices = std::get<ConvexPolygon>(body).vertices();
    for (const Point& vertex : vertices) centre += to_vector(vertex);
    centre /= static_cast<double>(vertices.size());
    for (const Point& vertex : vertices) corners.emplace_back(to_vector(vertex) - centre);
    inner = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Vector side = corners[(k + 1) % corners.size()] - corners[k];
      inner =
          std::min(inner, (corners[k].x() * side.y() - corners[k].y() * side.x()) / side.norm());
      outer = std::max(outer, corners[k].norm());
    }
  }

  /// How far it reaches in a direction of length 1, `scale` times as large.
  [[nodiscard]] double reach(const Vector& direction, double scale) const {
    double most = corners.empty() ? 0 : -outer;
    for (const Vector& corner : corners) most = std::max(most, direction.dot(corner));
    return scale * (most + radius);
  }
};

/// Two bodies of one size each, as FCL sees them: its tolerances are absolute, so the unit of
/// length is one in which the larger one is about as large as 1.
class Shapes {
 public:
  /// Both outlines outlive this. `scale`: of these, to make them smaller.
  Shapes(const Outline& a, const Outline& b, double scale)
      : a_(a), b_(b), scale_(scale), unit_(1 / std::max(a.outer, b.outer)) {
    // Of unlike heights, so that no two faces are in one plane but those that could touch.
    shape_a_ = make(a, 2);
    shape_b_ = make(b, 1);
  }

  enum class Advance { apart, contact, unknown };
  /// Whether they stay more than `least` / 2 apart while b's centre goes from `from` to `to` as
  /// seen from a's, or come as near as `least` according to FCL.
  [[nodiscard]] Advance advance(const Vector& from, const Vector& to, double least) const {
    double done = 0;  // the share of the way that is proved
    for (int step = 0; step < kMaxSteps; ++step) {
      const Vector here = from + done * (to - from);
      const std::optional<Nearest> nearest = ask(here);
      if (!nearest) return Advance::unknown;
      if (nearest->distance <= 0) return Advance::contact;
      const double gap = beyond(nearest->direction, here);
      if (gap <= least) return nearest->distance <= least ? Advance::contact : Advance::unknown;
      const double last = beyond(nearest->direction, to);
      if (last > least / 2) return Advance::apart;
      // The gap in this direction falls linearly from here on.
      done += (1 - done) * (gap - least / 2) / (gap - last);
    }
    return Advance::unknown;
  }

  /// Whether FCL finds them overlapping with b's centre there as seen from a's.
  [[nodiscard]] bool overlap(const Vector& place) const {
    const std::optional<Nearest> nearest = ask(place);
    return nearest && nearest->distance <= 0;
  }

 private:
  struct Nearest {
    double distance;   // not positive: they overlap
    Vector direction;  // from a to b, of length 1
  };

  [[nodiscard]] std::shared_ptr<fcl::CollisionGeometryd> make(const Outline& outline,
                                                              double height) const {
    if (outline.corners.empty())
      return std::make_shared<fcl::Sphered>(unit_ * scale_ * outline.radius);
    std::vector<Eigen::Vector2d> corners;
    for (const Vector& corner : outline.corners)
      corners.emplace_back(unit_ * scale_ * corner.head<2>());
    return make_prism(corners, height);
  }

  /// How far b is beyond a in a direction: at most their distance.
  [[nodiscard]] double beyond(const Vector& direction, const Vector& place) const {
    return direction.dot(place) - a_.reach(direction, scale_) - b_.reach(-direction, scale_);
  }

  /// What FCL says where b's centre is at `place` as seen from a's; none if it fails.
  [[nodiscard]] std::optional<Nearest> ask(const Vector& place) const {
    fcl::Transform3d at = fcl::Transform3d::Identity();
    at.translation() = unit_ * place;
    fcl::DistanceRequestd request(/*enable_nearest_points=*/true);
    request.distance_tolerance = 1e-9;
    fcl::DistanceResultd result;
    double distance = 0;
    try {
      // libccd's iteration may degenerate, and FCL throws then.
      distance = fcl::distance(shape_a_.get(), fcl::Transform3d::Identity(), shape_b_.get(), at,
                               request, result);
    } catch (const std::exception&) {
      return std::nullopt;
    }
    if (!(distance > 0)) return Nearest{distance, Vector::Zero()};
    Vector between = result.nearest_points[1] - result.nearest_points[0];
    if (!a_.corners.empty() || !b_.corners.empty()) between.z() = 0;  // Prisms overlap in height.
    const double length = between.norm();
    if (!(length > 0) || !std::isfinite(length)) return std::nullopt;
    return Nearest{length / unit_, between / length};
  }

  const Outline &a_, &b_;
  double scale_, unit_;
  std::shared_ptr<fcl::CollisionGeometryd> shape_a_, shape_b_;
};

/// The share of the leg that is over at a tick.
double share(const Leg& leg, Ticks tick) {
  if (leg.whole > 0)
    return static_cast<double>((leg.stands ? leg.behind : leg.behind + tick - leg.begin).value()) /
           static_cast<double>(leg.whole.value());
  return leg.end == leg.begin ? 0
                              : static_cast<double>((tick - leg.begin).value()) /
                                    static_cast<double>((leg.end - leg.begin).value());
}

/// The point of a segment that is nearest to the origin.
Vector nearest_point(const Vector& from, const Vector& to) {
  const Vector along = to - from;
  const double square = along.squaredNorm();
  const double at = square > 0 ? std::clamp(-from.dot(along) / square, 0.0, 1.0) : 0;
  return from + at * along;
}

}  // namespace

class EncounterCheck::Pair {
 public:
  Pair(const Body& a, const Body& b, Length extent) : a_(a), b_(b), same_(a_, b_, 1) {
    const double outer = a_.outer + b_.outer, inner = a_.inner + b_.inner;
    // A relative position is a sum of three differences of places, each at most twice the extent,
    // two of them times rounded shares; reaches are sums of lengths that are no larger than the
    // bodies and the ways between them. 2^-46 is 128 times the rounding error of one of these.
    const double size = outer + a_.centre.norm() + b_.centre.norm();
    error_ = std::ldexp(static_cast<double>(extent.value()) + size, -46);
    const double shrinking = std::max(kRelativeTolerance, 4 * error_ / inner);
    least_apart_ = 2 * std::max(error_, kRelativeTolerance * outer / 4);
    tolerance_ = std::max(shrinking * outer, least_apart_) + error_;
    if (shrinking > 0.5) return;  // So far away that nothing can be told.
    shrunk_.emplace(a_, b_, 1 - shrinking);
    least_shrunk_ = shrinking * inner / 2;
  }
  // The shapes refer to the outlines.
  Pair(const Pair&) = delete;
  Pair& operator=(const Pair&) = delete;

  [[nodiscard]] double tolerance() const { return tolerance_; }

  [[nodiscard]] Encounter look(const Leg& a, const Leg& b) const {
    const Ticks begin = std::max(a.begin, b.begin), end = std::min(a.end, b.end);
    if (begin > end) return Encounter::clear;
    const Vector from = apart(a, b, begin), to = apart(a, b, end);
    const Vector nearest = nearest_point(from, to);
    if (nearest.norm() > a_.outer + b_.outer + least_apart_) return Encounter::clear;
    if (same_.advance(from, to, least_apart_) == Shapes::Advance::apart) return Encounter::clear;
    return shrunk_ && shrunk_meet(from, to, nearest) ? Encounter::collision : Encounter::touch;
  }

 private:
  /// Where FCL's nearest points are too bad to go on with, bodies that get deep into each other can
  /// still be seen to do so.
  [[nodiscard]] bool shrunk_meet(const Vector& from, const Vector& to,
                                 const Vector& nearest) const {
    const auto advance = shrunk_->advance(from, to, least_shrunk_);
    if (advance != Shapes::Advance::unknown) return advance == Shapes::Advance::contact;
    return shrunk_->overlap(nearest) || shrunk_->overlap(from) || shrunk_->overlap(to);
  }

  /// From a's centre to b's.
  [[nodiscard]] Vector apart(const Leg& a, const Leg& b, Ticks tick) const {
    const auto difference = [](const Point& p, const Point& q) {
      return to_vector({q.x - p.x, q.y - p.y, q.z - p.z});
    };
    return difference(a.from, b.from) + share(b, tick) * difference(b.from, b.to) -
           share(a, tick) * difference(a.from, a.to) + b_.centre - a_.centre;
  }

  Outline a_, b_;
  Shapes same_;
  std::optional<Shapes> shrunk_;
  double error_ = 0;
  double least_apart_ = 0, least_shrunk_ = 0, tolerance_ = 0;
};

EncounterCheck::EncounterCheck(const Body& a, const Body& b, Length extent)
    : pair_(std::make_unique<const Pair>(a, b, extent)) {
  QUADRILLE_REQUIRE(0 <= extent && extent <= kMaxLength, "extent out of range");
}
EncounterCheck::~EncounterCheck() = default;
EncounterCheck::EncounterCheck(EncounterCheck&&) noexcept = default;
EncounterCheck& EncounterCheck::operator=(EncounterCheck&&) noexcept = default;

double EncounterCheck::tolerance() const noexcept { return pair_->tolerance(); }

Encounter EncounterCheck::look(const Leg& a, const Leg& b) const { return pair_->look(a, b); }

std::string_view to_string(Encounter encounter) noexcept {
  switch (encounter) {
    case Encounter::clear:
      return "clear";
    case Encounter::touch:
      return "touch";
    case Encounter::collision:
      return "collision";
  }
  return "";
}

}  // namespace quadrille::geometry
