// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include "quadrille/continuous/instance.hpp"

namespace quadrille::continuous::test {

/// Least differences between moments, closed: all that follow from those that were asked for.
/// Moment 0 is tick 0, no other one is before it.
class Differences {
 public:
  explicit Differences(std::size_t capacity) : capacity_(capacity), least_(capacity * capacity) {
    size_ = 1;
  }

  /// A new moment, `gap` after moment x or later.
  std::size_t append(std::size_t x, Ticks gap) {
    const std::size_t y = size_++;
    for (std::size_t u = 0; u < y; ++u) {
      at(u, y) = at(u, x) == kNone ? kNone : at(u, x) + gap;
      at(y, u) = kNone;
    }
    at(y, y) = 0;
    return y;
  }
  /// Asks for moment y to be `gap` after moment x or later. False: it cannot be.
  [[nodiscard]] bool ask(std::size_t x, std::size_t y, Ticks gap) {
    if (implies(x, y, gap)) return true;
    if (!allows(x, y, gap)) return false;
    for (std::size_t u = 0; u < size_; ++u) {
      if (at(u, x) == kNone) continue;
      const Ticks to_y = at(u, x) + gap;
      for (std::size_t v = 0; v < size_; ++v)
        if (at(y, v) != kNone) at(u, v) = std::max(at(u, v), to_y + at(y, v));
    }
    return true;
  }
  [[nodiscard]] bool implies(std::size_t x, std::size_t y, Ticks gap) const {
    return at(x, y) != kNone && at(x, y) >= gap;
  }
  [[nodiscard]] bool allows(std::size_t x, std::size_t y, Ticks gap) const {
    return at(y, x) == kNone || at(y, x) + gap <= 0;
  }
  [[nodiscard]] Ticks earliest(std::size_t x) const { return at(0, x); }

 private:
  static constexpr Ticks kNone{std::numeric_limits<std::int64_t>::min()};
  [[nodiscard]] Ticks& at(std::size_t x, std::size_t y) { return least_[x * capacity_ + y]; }
  [[nodiscard]] Ticks at(std::size_t x, std::size_t y) const { return least_[x * capacity_ + y]; }

  std::size_t capacity_, size_ = 1;
  std::vector<Ticks> least_;  // by both moments
};

}  // namespace quadrille::continuous::test
