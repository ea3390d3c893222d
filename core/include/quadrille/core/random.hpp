// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "quadrille/core/contract.hpp"
#include "quadrille/core/export.hpp"

QUADRILLE_API_BEGIN

namespace quadrille {

/// Random numbers that are the same on every platform: the standard fixes what std::mt19937_64
/// gives, but not what its distributions and std::shuffle make of it.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  /// Uniform in 0 .. bound-1. Requires bound > 0.
  std::uint64_t below(std::uint64_t bound) {
    QUADRILLE_REQUIRE(bound > 0, "there is nothing to draw from");
    // The first 2^64 mod bound values would make small results more likely.
    const std::uint64_t skipped = (0 - bound) % bound;
    for (;;)
      if (const std::uint64_t value = engine_(); value >= skipped) return value % bound;
  }

  /// True with the given probability.
  bool chance(double share) {
    constexpr double kUnit = 1.0 / (std::uint64_t{1} << 53);
    return static_cast<double>(engine_() >> 11) * kUnit < share;
  }

  /// Puts a uniform random choice of `count` items, in random order, in front. Requires
  /// count <= items.size().
  template <class T>
  void shuffle_front(std::vector<T>& items, std::size_t count) {
    QUADRILLE_REQUIRE(count <= items.size(), "no more items than there are");
    for (std::size_t i = 0; i < count; ++i)
      std::swap(items[i], items[i + static_cast<std::size_t>(below(items.size() - i))]);
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace quadrille

QUADRILLE_API_END
