// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

#include "quadrille/geometry/point.hpp"

namespace quadrille::geometry {

/// The largest t in [seed, limit] with `holds`, which is true for `seed` and, once false, stays
/// false. `guess` in [seed, limit] is where the answer probably is: two calls when it is right, and
/// else as many as the logarithm of its error.
template <class Predicate>
Ticks last_true(Ticks guess, Ticks seed, Ticks limit, const Predicate& holds) {
  Ticks good = seed;      // Known to hold.
  Ticks bad = limit + 1;  // Known not to hold.
  Ticks stride = 1;
  if (guess == seed || holds(guess)) {
    good = guess;
    while (good < bad - 1) {
      const Ticks next = std::min(good + stride, limit);
      if (!holds(next)) {
        bad = next;
        break;
      }
      good = next;
      stride *= 2;
    }
  } else {
    bad = guess;
    while (good < bad - 1) {
      const Ticks next = std::max(bad - stride, seed);
      if (next == seed || holds(next)) {
        good = next;
        break;
      }
      bad = next;
      stride *= 2;
    }
  }
  while (good < bad - 1) {
    const Ticks middle = good + (bad - good) / 2;
    (holds(middle) ? good : bad) = middle;
  }
  return good;
}

}  // namespace quadrille::geometry
