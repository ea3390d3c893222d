// SPDX-License-Identifier: MIT
#include "ball_pair.hpp"

#include "exact/exact_balls.hpp"

namespace quadrille::geometry::balls {
namespace {

double to_double(Length length) { return static_cast<double>(length.value()); }

// The point of a parallelogram that is nearest to the origin, as far as doubles tell.
Vec3 nearest_point(const Vec3 (&corners)[4]) {
  const Vec3 c = corners[0], u = corners[1] - c, v = corners[3] - c;
  const double uu = dot(u, u), vv = dot(v, v), uv = dot(u, v), cu = dot(c, u), cv = dot(c, v);
  const double det = uu * vv - uv * uv;
  const double p = (cv * uv - cu * vv) / det, q = (cu * uv - cv * uu) / det;
  if (0 < p && p < 1 && 0 < q && q < 1) return c + p * u + q * v;
  Vec3 nearest = c;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3 along = corners[(i + 1) % 4] - corners[i];
    const double square = dot(along, along);
    const double share = square > 0 ? std::clamp(-dot(corners[i], along) / square, 0.0, 1.0) : 0;
    const Vec3 point = corners[i] + share * along;
    if (dot(point, point) < dot(nearest, nearest)) nearest = point;
  }
  return nearest;
}

}  // namespace

bool meet(const Motion& a, const Motion& b, Ticks offset, Window window, Length reach) {
  const SpacePath path = space_path(a, b, offset, window, reach);
  const double apart = distance(path.begin, path.end);
  if (apart < to_double(reach) - path.error) return true;
  if (apart >= to_double(reach) + path.error) return false;
  return exact::balls_meet(a, b, offset, window, reach);
}

// A point of the parallelogram proves that the balls meet. That they do not is proved by a
// direction in which all corners are too far: FCL's or any other nearest point proposes one.
bool can_meet(const Motion& a, const Motion& b, Length reach) {
  if (boxes_apart(a, b, reach)) return false;
  const auto [apart_at_first, step_a, step_b] = sweep(a, b, to_vec3);
  const Vec3 corners[4] = {apart_at_first, apart_at_first + step_b,
                           apart_at_first + step_b - step_a, apart_at_first - step_a};
  const Vec3 nearest = nearest_point(corners);
  const double apart = norm(nearest);
  const double error = space_error_bound(a, b, reach);
  if (apart < to_double(reach) - error) return true;
  const Vec3 direction = (1 / apart) * nearest;
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3 corner : corners) least = std::min(least, dot(direction, corner));
  if (least >= to_double(reach) + error) return false;
  return a.is_part() || b.is_part() || exact::ball_reaches(relative_places(a, b), reach);
}

bool boxes_apart(const Motion& a, const Motion& b, Length reach) {
  const Parallelogram places = relative_places(a, b);
  for (Length Point::*coordinate : {&Point::x, &Point::y, &Point::z}) {
    bool below = true, above = true;
    for (const Point& p : places.corners) {
      below = below && p.*coordinate <= -reach;
      above = above && p.*coordinate >= reach;
    }
    if (below || above) return true;
  }
  return false;
}

// As for discs, see include_disc. In full motion the line apart - offset velocity_b + time velocity
// is `radius` from the origin: with w and r for what of `apart` and velocity_b is normal to the
// relative velocity, |w - offset r|^2 = radius^2, whose discriminant is (radius |r|)^2 - |w x r|^2.
RealInterval likely_offsets(const Motion& a, const Motion& b, Length reach) {
  const Sweep<Vec3> swept = sweep(a, b, to_vec3);
  const Vec3 &apart = swept.apart, &step_a = swept.step_a, &step_b = swept.step_b;
  const double duration_a = static_cast<double>(a.duration.value());
  const double duration_b = static_cast<double>(b.duration.value());
  const double radius = to_double(reach);
  RealInterval offsets;
  include_ends(apart, step_a, step_b, duration_a, duration_b, radius, offsets);

  if (a.is_rest() || b.is_rest()) return offsets;
  const Vec3 velocity_b = (1 / duration_b) * step_b;
  const Vec3 velocity = velocity_b - (1 / duration_a) * step_a;
  const double square = dot(velocity, velocity);
  if (square == 0) return offsets;
  const auto normal = [&](Vec3 p) { return p - (dot(p, velocity) / square) * velocity; };
  const Vec3 w = normal(apart), r = normal(velocity_b);
  const double turn = norm(r);
  if (turn == 0) return offsets;
  const double miss = norm(cross(w, r)) / turn;
  if (miss >= radius) return offsets;
  const double half = std::sqrt((radius - miss) * (radius + miss)) / turn;
  for (const double side : {-half, half}) {
    const double offset = dot(w, r) / (turn * turn) + side;
    const double time = -dot(apart - offset * velocity_b, velocity) / square;
    const double time_b = time - offset;
    if (time >= 0 && time <= duration_a && time_b >= 0 && time_b <= duration_b)
      offsets.include(offset);
  }
  return offsets;
}

std::optional<Ticks> find_meeting(const Motion& a, const Motion& b, Length reach) {
  return exact::find_balls_meeting(a, b, reach);
}

Gap gap(const Motion& a, const Motion& b, Ticks offset, Window window, Length reach) {
  const SpacePath path = space_path(a, b, offset, window, reach);
  const double apart = distance(path.begin, path.end) - to_double(reach);
  if (apart <= path.error && exact::balls_touch(a, b, offset, window, reach)) return Gap{};
  return Gap{std::max(0.0, apart - path.error), apart + path.error};
}

}  // namespace quadrille::geometry::balls
