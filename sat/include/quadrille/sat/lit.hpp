// SPDX-License-Identifier: MIT
#pragma once

#include <compare>
#include <cstdint>
#include <cstdlib>

#include "quadrille/core/contract.hpp"
#include "quadrille/core/export.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::sat {

/// A literal of the propositional formula: a variable (1, 2, ...) or its negation. The default is
/// no literal at all. Ordered by variable, then positive before negative.
class Lit {
 public:
  constexpr Lit() = default;
  /// The DIMACS integer: v for the variable v, -v for its negation; not 0.
  [[nodiscard]] static constexpr Lit from_dimacs(int value) { return Lit(value); }

  [[nodiscard]] constexpr int dimacs() const noexcept { return value_; }
  [[nodiscard]] constexpr int variable() const noexcept { return value_ < 0 ? -value_ : value_; }
  [[nodiscard]] constexpr bool positive() const noexcept { return value_ > 0; }
  /// False for a default-constructed literal.
  [[nodiscard]] constexpr bool valid() const noexcept { return value_ != 0; }
  [[nodiscard]] constexpr Lit operator~() const noexcept { return Lit(-value_); }

  friend constexpr bool operator==(Lit, Lit) = default;
  friend constexpr auto operator<=>(Lit a, Lit b) noexcept {
    if (const auto order = a.variable() <=> b.variable(); order != 0) return order;
    return b.value_ <=> a.value_;
  }

 private:
  constexpr explicit Lit(int value) : value_(value) {}
  int value_ = 0;
};

enum class Truth : std::uint8_t { unassigned, is_true, is_false };

}  // namespace quadrille::sat

QUADRILLE_API_END
