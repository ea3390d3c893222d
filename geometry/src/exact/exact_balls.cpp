// SPDX-License-Identifier: MIT
#include "exact/exact_balls.hpp"

#include "exact/exact_integer.hpp"
#include "exact/offset_search.hpp"

namespace quadrille::geometry::exact {
namespace {

struct Vector3 {
  Integer x;
  Integer y;
  Integer z;
};
Vector3 operator-(const Vector3& p, const Vector3& q) { return {p.x - q.x, p.y - q.y, p.z - q.z}; }
Integer dot(const Vector3& p, const Vector3& q) { return p.x * q.x + p.y * q.y + p.z * q.z; }
Vector3 to_vector(const Point& p) { return {p.x.value(), p.y.value(), p.z.value()}; }

// Of the origin from a segment. By Lagrange's identity the squared cross product of two vectors is
// the product of their squares minus the square of their product.
Fraction squared_distance(const Vector3& begin, const Vector3& end) {
  const Vector3 along = end - begin;
  const Integer projection = -dot(begin, along);
  if (projection <= 0) return {dot(begin, begin), 1};
  const Integer square = dot(along, along);
  if (projection >= square) return {dot(end, end), 1};
  return {dot(begin, begin) * square - projection * projection, square};
}

// Both ends of the relative path, times `scale`.
struct ScaledPath {
  Integer scale;
  Vector3 begin;
  Vector3 end;
};

ScaledPath scaled_path(const Motion& a, const Motion& b, Ticks offset, Window window) {
  const Ticks unit_a = a.whole(), unit_b = b.whole();
  const Integer scale = Integer(unit_a.value()) * unit_b.value();
  const Point apart = b.from - a.from;
  const Point step_a = a.to - a.from;
  const Point step_b = b.to - b.from;
  const auto at = [&](Ticks time) {
    const Integer done_a = Integer(a.done(time).value()) * unit_b.value();
    const Integer done_b = Integer(b.done(time - offset).value()) * unit_a.value();
    const auto coordinate = [&](Length Point::*of) -> Integer {
      return scale * (apart.*of).value() + done_b * (step_b.*of).value() -
             done_a * (step_a.*of).value();
    };
    return Vector3{coordinate(&Point::x), coordinate(&Point::y), coordinate(&Point::z)};
  };
  return {scale, at(window.begin), at(window.end)};
}

// Of the centres, in length units. The scale is that of all offsets of the two motions.
Fraction distance(const Motion& a, const Motion& b, Ticks offset) {
  const ScaledPath path = scaled_path(a, b, offset, *common_window(a, b, offset));
  return squared_distance(path.begin, path.end);
}

Integer squared(Length reach, const Integer& scale) {
  const Integer scaled_reach = scale * reach.value();
  return scaled_reach * scaled_reach;
}

}  // namespace

bool balls_meet(const Motion& a, const Motion& b, Ticks offset, Window window, Length reach) {
  const ScaledPath path = scaled_path(a, b, offset, window);
  const Fraction square = squared_distance(path.begin, path.end);
  return square.numerator < squared(reach, path.scale) * square.denominator;
}

bool balls_touch(const Motion& a, const Motion& b, Ticks offset, Window window, Length reach) {
  const ScaledPath path = scaled_path(a, b, offset, window);
  const Fraction square = squared_distance(path.begin, path.end);
  return square.numerator == squared(reach, path.scale) * square.denominator;
}

std::optional<Ticks> find_balls_meeting(const Motion& a, const Motion& b, Length reach) {
  return find_near(
      -b.duration, a.duration,
      [&](Ticks at) { return balls_meet(a, b, at, *common_window(a, b, at), reach); },
      [&](Ticks at) { return distance(a, b, at); });
}

// The squared distance of the point p of the plane is a convex function of its coordinates along
// the two sides u and v: where these are inside of (0, 1) at the minimum of the whole plane, that
// is the least value, and else it is taken on the border. With c = a corner, the minimum is at
//   p = ((c.v)(u.v) - (c.u)(v.v)) / det,  q = ((c.u)(u.v) - (c.v)(u.u)) / det,
//   det = (u.u)(v.v) - (u.v)^2,
// and its value the Gram determinant of c, u and v divided by det.
bool ball_reaches(const Parallelogram& places, Length reach) {
  const Vector3 c = to_vector(places.corners[0]);
  const Vector3 u = to_vector(places.corners[1]) - c;
  const Vector3 v = to_vector(places.corners[3]) - c;
  const Integer uu = dot(u, u), vv = dot(v, v), uv = dot(u, v), cu = dot(c, u), cv = dot(c, v);
  const Integer det = uu * vv - uv * uv;
  const Integer p = cv * uv - cu * vv, q = cu * uv - cv * uu;
  const Integer square = squared(reach, 1);
  if (p > 0 && p < det && q > 0 && q < det) return dot(c, c) * det + cu * p + cv * q < square * det;
  for (std::size_t i = 0; i < 4; ++i) {
    const Fraction side =
        squared_distance(to_vector(places.corners[i]), to_vector(places.corners[(i + 1) % 4]));
    if (side.numerator < square * side.denominator) return true;
  }
  return false;
}

}  // namespace quadrille::geometry::exact
