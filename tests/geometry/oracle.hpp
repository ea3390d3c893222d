// SPDX-License-Identifier: MIT
#pragma once

#include <boost/multiprecision/cpp_int.hpp>
#include <utility>
#include <vector>

#include "quadrille/geometry/body.hpp"
#include "quadrille/geometry/motion.hpp"

/// Second opinion on collisions, exact and slow: nothing of geometry/src is used, and the formulas
/// are others. The nearest points are computed as fractions and compared, where the library
/// compares cross products; polygons are compared by the projections of *both* bodies on each
/// normal, where the library clips against their difference.
namespace quadrille::geometry::oracle {

using BigInteger = boost::multiprecision::cpp_int;
__extension__ using SmallInteger = __int128;

/// Which integers are wide enough is for the caller to know: SmallInteger for coordinates and
/// durations up to about a hundred.
template <class Int>
class Oracle {
 public:
  struct Vector {
    Int x;
    Int y;
    Int z = 0;
  };
  struct Fraction {
    Int numerator;
    Int denominator;  // > 0
  };

  Oracle(const Body& body_a, const Motion& a, const Body& body_b, const Motion& b)
      : body_a_(body_a), body_b_(body_b), a_(a), b_(b) {}

  /// Whether the interiors meet at some moment at which both motions run.
  [[nodiscard]] bool collide(Ticks offset) const {
    return collide(offset, std::max(Ticks{0}, offset), std::min(a_.duration, offset + b_.duration));
  }

  /// The same, looking only at the times [begin, end] since a's start; false if end < begin.
  [[nodiscard]] bool collide(Ticks offset, Ticks begin, Ticks end) const {
    if (begin > end) return false;
    const Vector from = position(begin, offset);
    const Vector to = position(end, offset);
    const auto* disc_a = std::get_if<Disc>(&body_a_);
    const auto* disc_b = std::get_if<Disc>(&body_b_);
    if (disc_a && disc_b) {
      const Int reach = scale() * Int((disc_a->radius + disc_b->radius).value());
      return less(squared_distance({0, 0}, from, to), reach * reach);
    }
    // With a disc, the polygon rests and the disc's centre goes along the path, or its mirror
    // image.
    if (disc_a)
      return disc_meets({-from.x, -from.y}, {-to.x, -to.y}, disc_a->radius,
                        std::get<ConvexPolygon>(body_b_));
    if (disc_b) return disc_meets(from, to, disc_b->radius, std::get<ConvexPolygon>(body_a_));
    return polygons_meet(from, to);
  }

  /// For discs: the squared distance of the centres while both motions run, times scale()^2.
  [[nodiscard]] Fraction squared_distance(Ticks offset) const {
    return squared_distance({0, 0}, position(std::max(Ticks{0}, offset), offset),
                            position(std::min(a_.duration, offset + b_.duration), offset));
  }
  [[nodiscard]] Int scale() const { return Int(unit(a_).value()) * unit(b_).value(); }

  static bool less(const Fraction& p, const Fraction& q) {
    return p.numerator * q.denominator < q.numerator * p.denominator;
  }

 private:
  static Ticks unit(const Motion& motion) { return std::max(motion.duration, Ticks{1}); }
  static bool less(const Fraction& p, const Int& q) { return p.numerator < q * p.denominator; }

  // b relative to a, times scale().
  [[nodiscard]] Vector position(Ticks time, Ticks offset) const {
    const auto coordinate = [&](Length a_from, Length a_to, Length b_from, Length b_to) -> Int {
      const Int at_a =
          Int(unit(a_).value()) * a_from.value() + Int(time.value()) * (a_to - a_from).value();
      const Int at_b = Int(unit(b_).value()) * b_from.value() +
                       Int((time - offset).value()) * (b_to - b_from).value();
      return Int(unit(a_).value()) * at_b - Int(unit(b_).value()) * at_a;
    };
    return {coordinate(a_.from.x, a_.to.x, b_.from.x, b_.to.x),
            coordinate(a_.from.y, a_.to.y, b_.from.y, b_.to.y),
            coordinate(a_.from.z, a_.to.z, b_.from.z, b_.to.z)};
  }

  static Fraction squared_distance(const Vector& p, const Vector& from, const Vector& to) {
    const Vector step{to.x - from.x, to.y - from.y, to.z - from.z};
    Int done = (p.x - from.x) * step.x + (p.y - from.y) * step.y + (p.z - from.z) * step.z;
    Int all = step.x * step.x + step.y * step.y + step.z * step.z;
    if (all == 0) all = 1;
    if (done < 0) done = 0;
    if (done > all) done = all;
    // The nearest point is from + step * done / all.
    const Int x = (p.x - from.x) * all - step.x * done;
    const Int y = (p.y - from.y) * all - step.y * done;
    const Int z = (p.z - from.z) * all - step.z * done;
    return {x * x + y * y + z * z, all * all};
  }

  static int side(const Vector& p, const Vector& q, const Vector& r) {
    const Int area = (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
    return area > 0 ? 1 : area < 0 ? -1 : 0;
  }

  [[nodiscard]] bool disc_meets(const Vector& from, const Vector& to, Length radius,
                                const ConvexPolygon& polygon) const {
    const Int reach = scale() * radius.value();
    std::vector<Vector> corners;
    for (const Point& corner : polygon.vertices())
      corners.push_back({scale() * corner.x.value(), scale() * corner.y.value()});
    bool inside = true;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vector& p = corners[i];
      const Vector& q = corners[(i + 1) % corners.size()];
      if (side(p, q, from) <= 0) inside = false;
      if (side(p, q, from) * side(p, q, to) < 0 && side(from, to, p) * side(from, to, q) < 0)
        return true;
      for (const Fraction& square : {squared_distance(p, from, to), squared_distance(from, p, q),
                                     squared_distance(to, p, q)})
        if (less(square, reach * reach)) return true;
    }
    return inside;
  }

  [[nodiscard]] bool polygons_meet(const Vector& from, const Vector& to) const {
    const auto& polygon_a = std::get<ConvexPolygon>(body_a_).vertices();
    const auto& polygon_b = std::get<ConvexPolygon>(body_b_).vertices();
    Fraction earliest{0, 1};
    Fraction latest{1, 1};
    // Along each normal the projections overlap during an open interval of time.
    for (const auto* polygon : {&polygon_a, &polygon_b}) {
      for (std::size_t i = 0; i < polygon->size(); ++i) {
        const Point& p = (*polygon)[i];
        const Point& q = (*polygon)[(i + 1) % polygon->size()];
        const Vector normal{(q.y - p.y).value(), (p.x - q.x).value()};
        const auto [low_a, high_a] = range(polygon_a, normal);
        const auto [low_b, high_b] = range(polygon_b, normal);
        const Int at_begin = normal.x * from.x + normal.y * from.y;
        const Int at_end = normal.x * to.x + normal.y * to.y;
        if (!cut(at_begin - scale() * (high_a - low_b), at_end - scale() * (high_a - low_b),
                 earliest, latest) ||
            !cut(scale() * (low_a - high_b) - at_begin, scale() * (low_a - high_b) - at_end,
                 earliest, latest))
          return false;
      }
    }
    return true;
  }

  static std::pair<Int, Int> range(const std::vector<Point>& polygon, const Vector& normal) {
    std::pair<Int, Int> result;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Int value = normal.x * polygon[i].x.value() + normal.y * polygon[i].y.value();
      if (i == 0 || value < result.first) result.first = value;
      if (i == 0 || value > result.second) result.second = value;
    }
    return result;
  }

  // Keeps the times at which a value that goes from `begin` to `end` is below 0; whether any is
  // left.
  static bool cut(const Int& begin, const Int& end, Fraction& earliest, Fraction& latest) {
    if (begin >= 0 && end >= 0) return false;
    if (begin >= 0) {
      const Fraction zero{begin, begin - end};
      if (less(earliest, zero)) earliest = zero;
    } else if (end >= 0) {
      const Fraction zero{-begin, end - begin};
      if (less(zero, latest)) latest = zero;
    }
    return less(earliest, latest);
  }

  Body body_a_;
  Body body_b_;
  Motion a_;
  Motion b_;
};

}  // namespace quadrille::geometry::oracle
