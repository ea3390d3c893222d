// SPDX-License-Identifier: MIT
#include "verify/footprints.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>
#include <variant>

namespace quadrille::continuous {
namespace {

const Disc* disc_of(const Body& body) { return std::get_if<Disc>(&body); }

const std::vector<Point>& corners_of(const Body& body) {
  return std::get<ConvexPolygon>(body).vertices();
}

RealPoint operator-(RealPoint p, RealPoint q) { return {p.x - q.x, p.y - q.y, p.z - q.z}; }
long double dot(RealPoint p, RealPoint q) { return p.x * q.x + p.y * q.y + p.z * q.z; }
// Below 2^44: nothing overflows, as it would where std::hypot is worth its time.
long double length(RealPoint p) { return std::sqrt(dot(p, p)); }
RealPoint between(const RealPoint& from, const RealPoint& to, long double share) {
  return {from.x + share * (to.x - from.x), from.y + share * (to.y - from.y),
          from.z + share * (to.z - from.z)};
}

FlatPoint operator-(FlatPoint p, FlatPoint q) { return {p.x - q.x, p.y - q.y}; }
long double dot(FlatPoint p, FlatPoint q) { return p.x * q.x + p.y * q.y; }
long double cross(FlatPoint p, FlatPoint q) { return p.x * q.y - p.y * q.x; }
long double length(FlatPoint p) { return std::sqrt(dot(p, p)); }
FlatPoint between(const FlatPoint& from, const FlatPoint& to, long double share) {
  return {from.x + share * (to.x - from.x), from.y + share * (to.y - from.y)};
}
FlatPoint flat(RealPoint p) { return {p.x, p.y}; }

/// Where on the segment the point is nearest: a share of it in [0, 1].
template <class AnyPoint>
long double nearest_share(AnyPoint p, AnyPoint from, AnyPoint to) {
  const AnyPoint along = to - from;
  const long double square = dot(along, along);
  return square > 0 ? std::clamp(dot(p - from, along) / square, 0.0L, 1.0L) : 0;
}

std::vector<FlatPoint> real_corners(const Body& body, int sign) {
  std::vector<FlatPoint> corners;
  for (const Point& corner : corners_of(body))
    corners.push_back({sign * static_cast<long double>(corner.x.value()),
                       sign * static_cast<long double>(corner.y.value())});
  return corners;
}

/// All sums of a point of one convex polygon and one of the other, both counter-clockwise: their
/// sides sorted by direction, from the lowest (then leftmost) corners on.
std::vector<FlatPoint> sum_of(std::vector<FlatPoint> p, std::vector<FlatPoint> q) {
  const auto is_lower = [](FlatPoint a, FlatPoint b) {
    return a.y < b.y || (a.y == b.y && a.x < b.x);
  };
  for (auto* polygon : {&p, &q})
    std::rotate(polygon->begin(), std::min_element(polygon->begin(), polygon->end(), is_lower),
                polygon->end());
  const auto side = [](const std::vector<FlatPoint>& polygon, std::size_t k) {
    return polygon[(k + 1) % polygon.size()] - polygon[k];
  };
  std::vector<FlatPoint> sum;
  for (std::size_t k = 0, l = 0; k < p.size() || l < q.size();) {
    const FlatPoint &a = p[k % p.size()], &b = q[l % q.size()];
    sum.push_back({a.x + b.x, a.y + b.y});
    const long double turn = k == p.size() ? -1 : l == q.size() ? 1 : cross(side(p, k), side(q, l));
    if (turn >= 0) ++k;
    if (turn <= 0) ++l;
  }
  return sum;
}

long double farthest(const std::vector<FlatPoint>& points) {
  long double most = 0;
  for (const FlatPoint p : points) most = std::max(most, length(p));
  return most;
}

// --- exact ---

ExactPoint operator-(const ExactPoint& p, const ExactPoint& q) {
  return {p.x - q.x, p.y - q.y, p.z - q.z};
}
Integer dot(const ExactPoint& p, const ExactPoint& q) {
  if (p.z.is_zero() || q.z.is_zero()) return p.x * q.x + p.y * q.y;
  return p.x * q.x + p.y * q.y + p.z * q.z;
}
/// Of two vectors of the plane.
Integer cross(const ExactPoint& p, const ExactPoint& q) { return p.x * q.y - p.y * q.x; }

std::vector<ExactPoint> scaled_corners(const Body& body, const Integer& scale) {
  std::vector<ExactPoint> corners;
  for (const Point& corner : corners_of(body))
    corners.push_back({scale * corner.x.value(), scale * corner.y.value()});
  return corners;
}

/// Whether the point is nearer to the segment than the root of `square`.
bool is_nearer(const ExactPoint& p, const ExactPoint& from, const ExactPoint& to,
               const Integer& square) {
  const ExactPoint along = to - from, at = p - from;
  const Integer ahead = dot(at, along), size = dot(along, along);
  if (ahead <= 0) return dot(at, at) < square;
  if (ahead >= size) {
    const ExactPoint beyond = p - to;
    return dot(beyond, beyond) < square;
  }
  // Inside its stretch the squared distance is what is left of |at|^2 without the part ahead.
  if (!at.z.is_zero() || !along.z.is_zero())
    return dot(at, at) * size - ahead * ahead < square * size;
  // In the plane it is |cross| / length.
  const Integer area = cross(along, at);
  return area * area < square * size;
}

/// Whether each segment has points on both sides of the other.
bool cut_each_other(const ExactPoint& p, const ExactPoint& q, const ExactPoint& r,
                    const ExactPoint& s) {
  const auto are_apart = [](const Integer& u, const Integer& v) {
    return (u > 0 && v < 0) || (u < 0 && v > 0);
  };
  return are_apart(cross(q - p, r - p), cross(q - p, s - p)) &&
         are_apart(cross(s - r, p - r), cross(s - r, q - r));
}

/// A disc that moves past a polygon that rests. Outside of the polygon the least distance between
/// the disc's way and a side is taken at an end of one of them, unless they cut each other.
bool disc_meets(const ExactPoint& from, const ExactPoint& to, const Integer& radius,
                const std::vector<ExactPoint>& corners) {
  const Integer square = radius * radius;
  bool is_inside = true;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const ExactPoint &p = corners[k], &q = corners[(k + 1) % corners.size()];
    if (cross(q - p, from - p) <= 0) is_inside = false;
    if (is_nearer(from, p, q, square) || is_nearer(to, p, q, square) ||
        is_nearer(p, from, to, square) || cut_each_other(from, to, p, q))
      return true;
  }
  return is_inside;
}

/// The moments of a step at which a linear function is below zero, cut out of those before: shares
/// of the step, as fractions with positive denominators.
class Moments {
 public:
  /// The function goes from `first` to `last`. False if no moment is left.
  bool keep_negative(const Integer& first, const Integer& last) {
    if (first >= 0 && last >= 0) return false;
    // It is zero at first / (first - last).
    if (first >= 0 && is_less(begin_, {first, first - last})) begin_ = {first, first - last};
    if (last >= 0 && is_less({-first, last - first}, end_)) end_ = {-first, last - first};
    return is_less(begin_, end_);
  }

 private:
  struct Share {
    Integer over, under;
  };
  static bool is_less(const Share& a, const Share& b) {
    return a.over * b.under < b.over * a.under;
  }
  Share begin_{0, 1}, end_{1, 1};
};

/// The greatest value of a corner in a direction.
Integer extent(const std::vector<ExactPoint>& corners, const ExactPoint& direction) {
  Integer most = dot(corners.front(), direction);
  for (const ExactPoint& corner : corners) most = std::max(most, dot(corner, direction));
  return most;
}

/// Separating axes over time: convex polygons are apart if and only if some side of one of them has
/// the other one beyond it, and how far beyond is linear in time. The interiors meet at the moments
/// at which no side does that. Moments that fulfil strict inequalities form an open interval within
/// the step; if it has no inner moment, it is empty, because the inequalities are continuous.
bool polygons_meet(const ExactStep& step, const std::vector<ExactPoint>& a,
                   const std::vector<ExactPoint>& b) {
  Moments moments;
  const auto cut = [&](const std::vector<ExactPoint>& sides, const std::vector<ExactPoint>& other,
                       int sign) {
    for (std::size_t k = 0; k < sides.size(); ++k) {
      const ExactPoint side = sides[(k + 1) % sides.size()] - sides[k];
      const ExactPoint outwards{side.y, -side.x};
      // The other polygon is beyond the side by `apart` plus its move in that direction.
      const ExactPoint inwards{-side.y, side.x};
      const Integer apart = -extent(other, inwards) - dot(sides[k], outwards);
      if (!moments.keep_negative(apart + sign * dot(step.from, outwards),
                                 apart + sign * dot(step.to, outwards)))
        return false;
    }
    return true;
  };
  return cut(a, b, 1) && cut(b, a, -1);
}

}  // namespace

FootprintPair::FootprintPair(const Body& a, const Body& b) : a_(a), b_(b) {
  std::vector<FlatPoint> core_a{{0, 0}}, core_b{{0, 0}};
  for (const auto& [body, core, sign] : {std::tuple(&a, &core_a, 1), std::tuple(&b, &core_b, -1)}) {
    if (const auto* disc = disc_of(*body))
      radius_ += static_cast<long double>(disc->radius.value());
    else
      *core = real_corners(*body, sign);
  }
  far_ = radius_ + farthest(core_a) + farthest(core_b);
  core_ = sum_of(std::move(core_a), std::move(core_b));
  for (std::size_t k = 0; k < core_.size(); ++k) {
    const FlatPoint along = core_[(k + 1) % core_.size()] - core_[k];
    if (const long double size = length(along); size > 0) sides_.push_back({core_[k], along, size});
  }
}

// From outside, the nearest point is on a side that has the point beyond it.
long double FootprintPair::distance(FlatPoint p) const {
  long double inside = -std::numeric_limits<long double>::infinity();
  long double square = std::numeric_limits<long double>::infinity();
  for (const Side& side : sides_) {
    const FlatPoint at = p - side.from;
    const long double area = cross(at, side.along), ahead = dot(at, side.along);
    if (area <= 0) {
      inside = std::max(inside, area / side.size);
      continue;
    }
    const long double whole = side.size * side.size;
    const FlatPoint beyond = at - side.along;
    square = std::min(square, ahead <= 0       ? dot(at, at)
                              : ahead >= whole ? dot(beyond, beyond)
                                               : area * area / whole);
  }
  return square < std::numeric_limits<long double>::infinity() ? std::sqrt(square) : inside;
}

// Whether some moment is less than a length unit outside of each side, or inside: more than
// rounding can amount to, so that a way that cuts the core is seen to do so, however thin the core
// is.
bool FootprintPair::may_enter_core(FlatPoint from, FlatPoint to) const {
  long double low = 0, high = 1;
  for (const Side& side : sides_) {
    const long double first = cross(from - side.from, side.along) / side.size - 1;
    const long double last = cross(to - side.from, side.along) / side.size - 1;
    if (first >= 0 && last >= 0) return false;
    if (first > 0) low = std::max(low, first / (first - last));
    if (last > 0) high = std::min(high, first / (first - last));
  }
  return low <= high;
}

// How far it is outside of each side is linear in the share; the greatest of these is followed
// while it falls.
long double FootprintPair::deepest_share(FlatPoint from, FlatPoint to) const {
  struct Outside {
    long double first, growth;
  };
  std::vector<Outside> sides;
  for (const Side& side : sides_)
    sides.push_back({cross(from - side.from, side.along) / side.size,
                     cross(to - from, side.along) / side.size});
  Outside top = *std::max_element(sides.begin(), sides.end(), [](Outside x, Outside y) {
    return std::tie(x.first, x.growth) < std::tie(y.first, y.growth);
  });
  long double share = 0;
  while (top.growth < 0) {
    const Outside last = top;
    share = 1;
    for (const Outside side : sides) {
      if (side.growth <= last.growth) continue;
      const long double at = (last.first - side.first) / (side.growth - last.growth);
      if (at > share || (at == share && side.growth <= top.growth)) continue;
      share = at;
      top = side;
    }
    if (top.growth == last.growth) return 1;
  }
  return std::clamp(share, 0.0L, 1.0L);
}

// A way that stays outside of the core is nearest to it at an end of the way or beside a corner; in
// the core, what counts is the nearest side.
FootprintPair::Nearest FootprintPair::nearest(const RealStep& step) const {
  if (core_.size() == 1) {
    const long double share = nearest_share(RealPoint{0, 0}, step.from, step.to);
    return {length(between(step.from, step.to, share)) - radius_, share};
  }
  const FlatPoint from = flat(step.from), to = flat(step.to);
  Nearest best{std::numeric_limits<long double>::infinity(), 0};
  const auto try_share = [&](long double gap, long double share) {
    if (gap < best.gap) best = {gap, share};
  };
  try_share(distance(from), 0);
  try_share(distance(to), 1);
  if (may_enter_core(from, to)) {
    const long double share = deepest_share(from, to);
    try_share(distance(between(from, to, share)), share);
  }
  if (best.gap >= 0)
    for (const FlatPoint corner : core_) {
      const long double share = nearest_share(corner, from, to);
      try_share(length(corner - between(from, to, share)), share);
    }
  return {best.gap - radius_, best.share};
}

long double FootprintPair::least_gap(const RealStep& step) const {
  const long double share = nearest_share(RealPoint{0, 0}, step.from, step.to);
  return length(between(step.from, step.to, share)) - far_;
}

bool FootprintPair::interiors_meet(const ExactStep& step) const {
  const auto *a = disc_of(a_), *b = disc_of(b_);
  if (a != nullptr && b != nullptr) {
    const Integer reach = step.scale * (a->radius + b->radius).value();
    return is_nearer({0, 0}, step.from, step.to, reach * reach);
  }
  // Seen from b, a moves the other way.
  if (a != nullptr)
    return disc_meets({-step.from.x, -step.from.y}, {-step.to.x, -step.to.y},
                      step.scale * a->radius.value(), scaled_corners(b_, step.scale));
  if (b != nullptr)
    return disc_meets(step.from, step.to, step.scale * b->radius.value(),
                      scaled_corners(a_, step.scale));
  return polygons_meet(step, scaled_corners(a_, step.scale), scaled_corners(b_, step.scale));
}

// Places at which interiors meet form an open convex set, and the sweep is a parallelogram. If they
// have a point in common, so have the set and a side, or the set is inside of the parallelogram; of
// balls in space also if the plane cuts the set within the parallelogram.
bool FootprintPair::sweeps_meet(const ExactSweep& sweep) const {
  const auto plus = [](const ExactPoint& p, const ExactPoint& q) {
    return ExactPoint{p.x + q.x, p.y + q.y, p.z + q.z};
  };
  const ExactPoint &first = sweep.corner, second = plus(first, sweep.way_b),
                   third = plus(second, sweep.way_a), fourth = plus(first, sweep.way_a);
  return interiors_meet({first, second, 1}) || interiors_meet({second, third, 1}) ||
         interiors_meet({third, fourth, 1}) || interiors_meet({fourth, first, 1}) ||
         meet_inside(sweep);
}

bool FootprintPair::meet_inside(const ExactSweep& sweep) const {
  const auto cross = [](const ExactPoint& p, const ExactPoint& q) {
    return ExactPoint{p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x};
  };
  const auto dot = [](const ExactPoint& p, const ExactPoint& q) -> Integer {
    return p.x * q.x + p.y * q.y + p.z * q.z;
  };
  const ExactPoint normal = cross(sweep.way_a, sweep.way_b);
  const Integer area = dot(normal, normal);
  if (area == 0) return false;  // the sides are all there is
  // A place within the set, times `scale`: where the centre of b is that of a.
  const auto sum_of_corners = [](const Body& body) {
    ExactPoint sum{0, 0};
    if (const auto* const polygon = std::get_if<ConvexPolygon>(&body))
      for (const Point& corner : polygon->vertices()) {
        sum.x += corner.x.value();
        sum.y += corner.y.value();
      }
    return sum;
  };
  const auto num_corners = [](const Body& body) -> Integer {
    const auto* const polygon = std::get_if<ConvexPolygon>(&body);
    return polygon == nullptr ? 1 : static_cast<std::int64_t>(polygon->vertices().size());
  };
  const Integer na = num_corners(a_), nb = num_corners(b_), scale = na * nb;
  const ExactPoint a = sum_of_corners(a_), b = sum_of_corners(b_);
  const ExactPoint within{nb * a.x - na * b.x - scale * sweep.corner.x,
                          nb * a.y - na * b.y - scale * sweep.corner.y,
                          -scale * sweep.corner.z};  // from the corner of the sweep
  // Its shares of the two ways, times `area`, after it is put onto the plane.
  const Integer share_a = dot(cross(within, sweep.way_b), normal);
  const Integer share_b = dot(cross(sweep.way_a, within), normal);
  if (share_a <= 0 || share_a >= scale * area || share_b <= 0 || share_b >= scale * area)
    return false;
  const auto *disc_a = disc_of(a_), *disc_b = disc_of(b_);
  if (disc_a == nullptr || disc_b == nullptr) return true;
  const Integer off = dot(sweep.corner, normal);
  const Integer reach = (disc_a->radius + disc_b->radius).value();
  return off * off < reach * reach * area;
}

}  // namespace quadrille::continuous
