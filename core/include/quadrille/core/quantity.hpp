// SPDX-License-Identifier: MIT
#pragma once

#include <compare>
#include <concepts>
#include <cstdint>
#include <iosfwd>
#include <limits>

#include "quadrille/core/export.hpp"

// Old versions of clang (14 at least) crash on immediate functions in lists of initial values. They
// accept every `int` then; other compilers see to it that it is a constant.
#if defined(__clang__) && __clang_major__ < 17
#define QUADRILLE_LITERAL constexpr
#else
#define QUADRILLE_LITERAL consteval
#endif

QUADRILLE_API_BEGIN

namespace quadrille {

/// A whole number of one unit, such as ticks, that mixes with no other: neither with a quantity of
/// another unit nor with a plain integer that the program computes. A literal is of any unit, so
/// that `end - 1` and `Ticks when = 0` need no ceremony; any other integer becomes a quantity by
/// `Ticks(number)` only, and a quantity a number by `value()` only, like ids and metres.
///
/// Arithmetic is that of std::int64_t: nothing is checked, and a result that does not fit is
/// undefined. What keeps results in range is stated where the unit is defined.
template <class Unit>
class Quantity {
 public:
  using Count = std::int64_t;

  constexpr Quantity() = default;  ///< None.
  /// A literal, or another constant of type `int`.
  template <std::same_as<int> Literal>
  QUADRILLE_LITERAL Quantity(Literal literal) noexcept : count_(literal) {}
  constexpr explicit Quantity(Count count) noexcept : count_(count) {}
  /// Rounding is for the caller to choose.
  template <std::floating_point Real>
  Quantity(Real) = delete;

  /// How many units.
  [[nodiscard]] constexpr Count value() const noexcept { return count_; }

  friend constexpr auto operator<=>(Quantity, Quantity) = default;

  [[nodiscard]] constexpr Quantity operator-() const noexcept { return Quantity(-count_); }
  [[nodiscard]] friend constexpr Quantity operator+(Quantity a, Quantity b) noexcept {
    return Quantity(a.count_ + b.count_);
  }
  [[nodiscard]] friend constexpr Quantity operator-(Quantity a, Quantity b) noexcept {
    return Quantity(a.count_ - b.count_);
  }
  constexpr Quantity& operator+=(Quantity other) noexcept {
    count_ += other.count_;
    return *this;
  }
  constexpr Quantity& operator-=(Quantity other) noexcept {
    count_ -= other.count_;
    return *this;
  }
  constexpr Quantity& operator++() noexcept {
    ++count_;
    return *this;
  }

  [[nodiscard]] friend constexpr Quantity operator*(Quantity quantity, Count factor) noexcept {
    return Quantity(quantity.count_ * factor);
  }
  [[nodiscard]] friend constexpr Quantity operator*(Count factor, Quantity quantity) noexcept {
    return Quantity(factor * quantity.count_);
  }
  constexpr Quantity& operator*=(Count factor) noexcept {
    count_ *= factor;
    return *this;
  }
  /// Rounded towards zero, as integers are. Requires a divisor other than 0.
  [[nodiscard]] friend constexpr Quantity operator/(Quantity quantity, Count divisor) noexcept {
    return Quantity(quantity.count_ / divisor);
  }
  /// How often the second goes into the first, rounded towards zero.
  [[nodiscard]] friend constexpr Count operator/(Quantity a, Quantity b) noexcept {
    return a.count_ / b.count_;
  }

  [[nodiscard]] friend constexpr Quantity abs(Quantity quantity) noexcept {
    return quantity.count_ < 0 ? -quantity : quantity;
  }

  template <class Char, class Traits>
  friend std::basic_ostream<Char, Traits>& operator<<(std::basic_ostream<Char, Traits>& out,
                                                      Quantity quantity) {
    return out << quantity.count_;
  }

 private:
  Count count_ = 0;
};

}  // namespace quadrille

/// Left without a definition, because the general template would give 0 for each limit. The range
/// of a quantity is for its unit to state; that of the number is that of `Quantity::Count`.
template <class Unit>
class std::numeric_limits<quadrille::Quantity<Unit>>;

QUADRILLE_API_END

#undef QUADRILLE_LITERAL
