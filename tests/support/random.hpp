// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "quadrille/core/contract.hpp"

namespace quadrille::support {

/// Random draws that are the same on every platform: the standard fixes mt19937_64, but not its
/// distributions.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  /// Uniform in 0 .. bound-1. Requires bound > 0.
  [[nodiscard]] std::size_t below(std::size_t bound) {
    QUADRILLE_REQUIRE(bound > 0, "something to draw from");
    // Draws from the incomplete last stretch of the range would favour small numbers.
    const std::uint64_t stretch = UINT64_MAX / bound;
    std::uint64_t draw = engine_() / stretch;
    while (draw >= bound) draw = engine_() / stretch;
    return static_cast<std::size_t>(draw);
  }
  /// Uniform in first .. last, both included.
  [[nodiscard]] std::size_t between(std::size_t first, std::size_t last) {
    return first + below(last - first + 1);
  }
  /// True in `percent` of 100 draws.
  [[nodiscard]] bool percent(std::size_t percent) { return below(100) < percent; }

  template <class T>
  [[nodiscard]] const T& pick(const std::vector<T>& items) {
    return items[below(items.size())];
  }
  template <class T>
  void shuffle(std::vector<T>& items) {
    for (std::size_t i = items.size(); i > 1; --i) std::swap(items[i - 1], items[below(i)]);
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace quadrille::support
