// SPDX-License-Identifier: MIT
#pragma once

#include "quadrille/core/export.hpp"
#include "quadrille/geometry/place.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::geometry {

/// A body's reference point goes straight from `from` to `to` at constant velocity; at tick s after
/// its start, s in [0, duration] and real, it is at from + (to - from) * s / duration. Both ends
/// count. A motion with from == to is a rest.
///
/// With `behind` > 0 it is the last part of that: the whole takes behind + duration ticks, and of
/// these `behind` are over when the part starts. So places on the way are exact, whole or not.
struct Motion {
  Point from;
  Point to;
  Ticks duration = 1;  ///< 1 <= duration <= kMaxDuration; a rest may also last 0.
  Ticks behind = 0;    ///< Not negative; behind + duration <= kMaxDuration.
  /// A rest on the way: it stands where it would be after `behind` of so many ticks. 0: it moves.
  Ticks stands_of = 0;

  [[nodiscard]] constexpr bool is_rest() const noexcept { return from == to || stands_of > 0; }
  /// Whether it begins on the way from `from` to `to`, or stands there.
  [[nodiscard]] constexpr bool is_part() const noexcept { return behind > 0 || stands_of > 0; }
  /// Of the way, `done(s)` / `whole()` lie behind the body at tick s.
  [[nodiscard]] constexpr Ticks whole() const noexcept {
    return stands_of > 0 ? stands_of : from == to ? Ticks{1} : behind + duration;
  }
  [[nodiscard]] constexpr Ticks done(Ticks s) const noexcept {
    return is_rest() ? behind : behind + s;
  }

  friend constexpr bool operator==(const Motion&, const Motion&) = default;
};

/// A body that stays at `place` for `duration` ticks.
[[nodiscard]] constexpr Motion rest(const Place& place, Ticks duration) noexcept {
  if (place.from == place.to || place.behind == 0) return Motion{place.from, place.from, duration};
  return Motion{place.from, place.to, duration, place.behind, place.whole};
}

/// Whether the points and the duration are within the ranges above. Every function of this folder
/// that takes a motion requires it.
[[nodiscard]] constexpr bool is_valid(const Motion& motion) noexcept {
  const bool is_rest = motion.is_rest();
  return in_range(motion.from) && in_range(motion.to) && motion.duration <= kMaxDuration &&
         motion.duration >= (is_rest ? Ticks{0} : Ticks{1}) && 0 <= motion.behind &&
         (is_rest ? motion.behind <= motion.whole() && motion.whole() <= kMaxDuration
                  : motion.behind <= kMaxDuration - motion.duration);
}

}  // namespace quadrille::geometry

QUADRILLE_API_END
