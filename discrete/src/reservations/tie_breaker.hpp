// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "quadrille/core/random.hpp"

namespace quadrille::discrete {

/// Small random numbers by the million, as fair as ties need: two from one draw, no division.
class TieBreaker {
 public:
  /// `random` outlives the object.
  explicit TieBreaker(Random& random) : random_(random) {}

  /// 0 .. count-1; 0 if there is nothing to draw from. Requires a count of at most 2^40.
  [[nodiscard]] std::size_t draw(std::size_t count) {
    constexpr int kBits = 20;
    constexpr std::uint64_t kOne = 1;
    if (bits_ == 1) bits_ = random_.below(kOne << (2 * kBits)) | kOne << (2 * kBits);
    const std::uint64_t drawn = bits_ & ((kOne << kBits) - 1);
    bits_ >>= kBits;
    return static_cast<std::size_t>(drawn * count >> kBits);
  }

 private:
  Random& random_;
  std::uint64_t bits_ = 1;  // What is left of the last draw, behind a one.
};

}  // namespace quadrille::discrete
