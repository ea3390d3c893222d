// SPDX-License-Identifier: MIT
#pragma once

#include <compare>
#include <cstdint>
#include <limits>

#include "quadrille/core/export.hpp"

QUADRILLE_API_BEGIN

namespace quadrille {

/// How much work something is. It is counted in elementary steps and never by clocks, so that a
/// solve does the same in each run; this is the unit in which kinds of work are compared whose
/// steps take different times. Nominal: a nanosecond was one on the machine that they were measured
/// on. Who does one kind of work may count its own steps, and tells what one takes; whoever lets
/// several take turns counts this.
class Effort {
 public:
  constexpr Effort() noexcept = default;
  [[nodiscard]] static constexpr Effort nanoseconds(std::int64_t count) noexcept {
    return Effort(count);
  }
  [[nodiscard]] static constexpr Effort microseconds(std::int64_t count) noexcept {
    return Effort(1000 * count);
  }
  [[nodiscard]] static constexpr Effort most() noexcept {
    return Effort(std::numeric_limits<std::int64_t>::max());
  }

  /// In nominal nanoseconds.
  [[nodiscard]] constexpr std::int64_t count() const noexcept { return count_; }
  friend constexpr auto operator<=>(Effort, Effort) noexcept = default;
  constexpr Effort& operator+=(Effort other) noexcept {
    count_ += other.count_;
    return *this;
  }
  constexpr Effort& operator-=(Effort other) noexcept {
    count_ -= other.count_;
    return *this;
  }
  [[nodiscard]] friend constexpr Effort operator+(Effort a, Effort b) noexcept { return a += b; }
  [[nodiscard]] friend constexpr Effort operator-(Effort a, Effort b) noexcept { return a -= b; }
  [[nodiscard]] friend constexpr Effort operator*(std::int64_t times, Effort a) noexcept {
    return Effort(times * a.count_);
  }
  [[nodiscard]] friend constexpr Effort operator/(Effort a, std::int64_t parts) noexcept {
    return Effort(a.count_ / parts);
  }
  /// How many of `b` there are in `a`, rounded towards 0.
  [[nodiscard]] friend constexpr std::int64_t operator/(Effort a, Effort b) noexcept {
    return a.count_ / b.count_;
  }

 private:
  explicit constexpr Effort(std::int64_t count) noexcept : count_(count) {}
  std::int64_t count_ = 0;
};

}  // namespace quadrille

QUADRILLE_API_END
