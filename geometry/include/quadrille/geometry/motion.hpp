// SPDX-License-Identifier: MIT
#pragma once

#include "quadrille/core/export.hpp"
#include "quadrille/geometry/point.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::geometry {

/// A body's reference point goes straight from `from` to `to` at constant velocity; at tick s after
/// its start, s in [0, duration] and real, it is at from + (to - from) * s / duration. Both ends
/// count. A motion with from == to is a rest.
struct Motion {
  Point from;
  Point to;
  Ticks duration = 1;  ///< 1 <= duration <= kMaxDuration; a rest may also last 0.

  [[nodiscard]] constexpr bool is_rest() const noexcept { return from == to; }

  friend constexpr bool operator==(const Motion&, const Motion&) = default;
};

/// A body that stays at `place` for `duration` ticks.
[[nodiscard]] constexpr Motion rest(const Point& place, Ticks duration) noexcept {
  return Motion{place, place, duration};
}

/// Whether the points and the duration are within the ranges above. Every function of this folder
/// that takes a motion requires it.
[[nodiscard]] constexpr bool is_valid(const Motion& motion) noexcept {
  return in_range(motion.from) && in_range(motion.to) && motion.duration <= kMaxDuration &&
         motion.duration >= (motion.is_rest() ? Ticks{0} : Ticks{1});
}

}  // namespace quadrille::geometry

QUADRILLE_API_END
