// SPDX-License-Identifier: MIT
#include "hints.hpp"

namespace quadrille::geometry {
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
    // Most sides have all of it inside.
    if (std::all_of(kept.begin(), kept.end(), [&](Vec at) { return inside(at) >= 0; })) continue;
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
