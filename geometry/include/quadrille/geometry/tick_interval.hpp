// SPDX-License-Identifier: MIT
#pragma once

#include <compare>

#include "quadrille/core/export.hpp"
#include "quadrille/geometry/point.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::geometry {

/// The ticks t with begin <= t < end; none if end <= begin. In all of this project `begin` and
/// `end` name such an interval, and `first` and `last` the ends that both belong to it.
///
/// The same numbers also stand for a *stretch*: the real moments strictly between begin and end. A
/// stay is closed instead, [arrive, leave]; `meets` relates the two.
struct TickInterval {
  Ticks begin = 0;
  Ticks end = 0;

  /// The ticks from `first` to `last`, both included.
  [[nodiscard]] static constexpr TickInterval closed(Ticks first, Ticks last) noexcept {
    return {first, last + 1};
  }

  [[nodiscard]] constexpr bool is_empty() const noexcept { return end <= begin; }
  /// Of the ticks; of the stretch as well.
  [[nodiscard]] constexpr Ticks length() const noexcept {
    return is_empty() ? Ticks{0} : end - begin;
  }
  [[nodiscard]] constexpr Ticks first() const noexcept { return begin; }
  /// Of an interval that is not empty.
  [[nodiscard]] constexpr Ticks last() const noexcept { return end - 1; }
  [[nodiscard]] constexpr bool contains(Ticks tick) const noexcept {
    return begin <= tick && tick < end;
  }
  /// Whether some tick is in both.
  [[nodiscard]] constexpr bool overlaps(const TickInterval& other) const noexcept {
    return !is_empty() && !other.is_empty() && begin < other.end && other.begin < end;
  }
  /// All t + by. The same for the stretch.
  [[nodiscard]] constexpr TickInterval shifted(Ticks by) const noexcept {
    return {begin + by, end + by};
  }
  /// All -t: of differences, those with the two sides swapped.
  [[nodiscard]] constexpr TickInterval mirrored() const noexcept { return {1 - end, 1 - begin}; }

  /// Of the stretch: whether some moment of it is in the closed interval [arrive, leave], arrive <=
  /// leave; a stay without length is met if it is strictly inside.
  [[nodiscard]] constexpr bool meets(Ticks arrive, Ticks leave) const noexcept {
    return arrive < end && leave > begin;
  }
  /// The whole ticks of the stretch.
  [[nodiscard]] constexpr TickInterval inner_ticks() const noexcept { return {begin + 1, end}; }

  friend constexpr auto operator<=>(const TickInterval&, const TickInterval&) = default;
};

}  // namespace quadrille::geometry

QUADRILLE_API_END
