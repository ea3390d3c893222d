// SPDX-License-Identifier: MIT
#include "hints.hpp"

namespace quadrille::geometry {
namespace {

// The fractions in [0, 1] of a step that are in the convex polygon.
RealInterval inner_fractions(Vec start, Vec step, std::span<const Vec> corners) {
  RealInterval kept{0, 1};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec side = corners[(i + 1) % corners.size()] - corners[i];
    const double first = cross(side, start - corners[i]), growth = cross(side, step);
    if (growth == 0 && first < 0) return {};
    if (growth > 0) kept.lo = std::max(kept.lo, -first / growth);
    if (growth < 0) kept.hi = std::min(kept.hi, -first / growth);
    if (kept.empty()) return {};
  }
  return kept;
}

}  // namespace

// With the fractions p and q of a's and b's motion that are done, the relative position is
// apart + q step_b - p step_a and the offset p duration_a - q duration_b. The pairs (p, q) of the
// unit square that are in contact form the part of an ellipse (or strip) in it; the offset is least
// and greatest where the ellipse meets a side of the square, or, inside the square, where both
// bodies graze each other in full motion.
void include_disc(const Motion& a, const Motion& b, Vec centre, double radius,
                  RealInterval& offsets) {
  const auto [begin, step_a, step_b] = sweep(a, b, to_vec);
  const Vec apart = begin - centre;
  const double duration_a = static_cast<double>(a.duration.value());
  const double duration_b = static_cast<double>(b.duration.value());

  include_ends(apart, step_a, step_b, duration_a, duration_b, radius, offsets);

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

// See above: the pairs in contact form a convex part of the unit square, which has its corners
// where the sides of the square enter and leave the polygon, and at corners of the polygon.
void include_polygon(const Motion& a, const Motion& b, std::span<const Vec> corners,
                     RealInterval& offsets) {
  const Sweep<Vec> swept = sweep(a, b, to_vec);
  const Vec &apart = swept.apart, &step_a = swept.step_a, &step_b = swept.step_b;
  const auto include = [&](double p, double q) {
    offsets.include(p * static_cast<double>(a.duration.value()) -
                    q * static_cast<double>(b.duration.value()));
  };
  for (const double end : {0.0, 1.0}) {
    const RealInterval q = inner_fractions(apart - end * step_a, step_b, corners);
    if (!q.empty()) include(end, q.lo), include(end, q.hi);
    const RealInterval p = inner_fractions(apart + end * step_b, Vec{} - step_a, corners);
    if (!p.empty()) include(p.lo, end), include(p.hi, end);
  }
  const double turn = cross(step_a, step_b);
  if (turn == 0) return;  // Strips, which end at the sides of the square.
  for (const Vec corner : corners) {
    const double p = cross(step_b, corner - apart) / turn;
    const double q = cross(step_a, corner - apart) / turn;
    if (p >= 0 && p <= 1 && q >= 0 && q <= 1) include(p, q);
  }
}

}  // namespace quadrille::geometry
