// SPDX-License-Identifier: MIT
#include "hints.hpp"

namespace quadrille::geometry {
namespace {

// The fractions in [0, 1] of a step at which |start + fraction * step| < radius.
RealInterval near_fractions(Vec start, Vec step, double radius) {
  RealInterval result;
  const double square = dot(step, step);
  if (square == 0) {
    if (dot(start, start) < radius * radius) result = {0, 1};
    return result;
  }
  // The miss distance from the cross product: the discriminant would cancel where discs graze.
  const double length = std::sqrt(square);
  const double miss = std::abs(cross(start, step)) / length;
  if (miss >= radius) return result;
  const double middle = -dot(start, step) / square;
  const double half = std::sqrt((radius - miss) * (radius + miss)) / length;
  if (middle + half < 0 || middle - half > 1) return result;
  return {std::max(0.0, middle - half), std::min(1.0, middle + half)};
}

}  // namespace

// With the fractions p and q of a's and b's motion that are done, the relative position is
// apart + q step_b - p step_a and the offset p duration_a - q duration_b. The pairs (p, q) of the
// unit square that are in contact form the part of an ellipse (or strip) in it; the offset is least
// and greatest where the ellipse meets a side of the square, or, inside the square, where both
// bodies graze each other in full motion.
void include_disc(const Motion& a, const Motion& b, Vec centre, double radius,
                  RealInterval& offsets) {
  const Vec apart = to_vec(b.from - a.from) - centre;
  const Vec step_a = to_vec(a.to - a.from);
  const Vec step_b = to_vec(b.to - b.from);
  const double duration_a = static_cast<double>(a.duration.count());
  const double duration_b = static_cast<double>(b.duration.count());

  for (const double p : {0.0, 1.0}) {
    const RealInterval q = near_fractions(apart - p * step_a, step_b, radius);
    if (q.empty()) continue;
    offsets.include(p * duration_a - q.lo * duration_b);
    offsets.include(p * duration_a - q.hi * duration_b);
  }
  for (const double q : {0.0, 1.0}) {
    const RealInterval p = near_fractions(apart + q * step_b, Vec{} - step_a, radius);
    if (p.empty()) continue;
    offsets.include(p.lo * duration_a - q * duration_b);
    offsets.include(p.hi * duration_a - q * duration_b);
  }

  // In full motion: the line apart - offset velocity_b + time velocity is `radius` from the origin.
  if (a.is_rest() || b.is_rest()) return;
  const Vec velocity_a = (1 / duration_a) * step_a;
  const Vec velocity_b = (1 / duration_b) * step_b;
  const Vec velocity = velocity_b - velocity_a;
  const double turn = cross(velocity_b, velocity);
  if (turn == 0) return;
  const double speed = norm(velocity);
  for (const double side : {-radius, radius}) {
    const double offset = (cross(apart, velocity) + side * speed) / turn;
    const double time = -dot(apart - offset * velocity_b, velocity) / (speed * speed);
    const double time_b = time - offset;
    if (time >= 0 && time <= duration_a && time_b >= 0 && time_b <= duration_b)
      offsets.include(offset);
  }
}

void include_polygon(const Motion& a, const Motion& b, std::span<const Vec> corners,
                     RealInterval& offsets) {
  const Vec apart = to_vec(b.from - a.from);
  const Vec step_a = to_vec(a.to - a.from);
  const Vec step_b = to_vec(b.to - b.from);
  // Clips the unit square of (p, q), see above, by one side of the polygon after the other.
  std::vector<Vec> kept{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  std::vector<Vec> next;
  for (std::size_t i = 0; i < corners.size() && !kept.empty(); ++i) {
    const Vec side = corners[(i + 1) % corners.size()] - corners[i];
    const auto inside = [&](Vec at) {
      return cross(side, apart + at.y * step_b - at.x * step_a - corners[i]);
    };
    next.clear();
    for (std::size_t k = 0; k < kept.size(); ++k) {
      const Vec from = kept[k];
      const Vec to = kept[(k + 1) % kept.size()];
      const double value_from = inside(from);
      const double value_to = inside(to);
      if (value_from >= 0) next.push_back(from);
      if ((value_from < 0 && value_to > 0) || (value_from > 0 && value_to < 0))
        next.push_back(from + (value_from / (value_from - value_to)) * (to - from));
    }
    kept.swap(next);
  }
  for (const Vec at : kept)
    offsets.include(at.x * static_cast<double>(a.duration.count()) -
                    at.y * static_cast<double>(b.duration.count()));
}

}  // namespace quadrille::geometry
