// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <optional>

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

/// Some offset in [low, high] at which the bodies meet; none if there is no such integer. `meets`
/// and `distance` are of an offset, and distances can be `compare`d where the bodies do not meet.
/// As many calls of each as the length of the interval has bits.
///
/// By bisection. The distance is a convex function of the offset: it is the least value, over the
/// moments, of a convex function of moment and offset. So where the bodies meet at neither of two
/// neighbouring offsets, they can only meet on the side on which the distance is less, and nowhere
/// if it is the same.
template <class Meets, class Distance>
std::optional<Ticks> find_near(Ticks low, Ticks high, const Meets& meets,
                               const Distance& distance) {
  while (low < high) {
    const Ticks middle = low + (high - low) / 2;
    if (meets(middle)) return middle;
    if (meets(middle + 1)) return middle + 1;
    const int order = compare(distance(middle), distance(middle + 1));
    if (order == 0) return std::nullopt;
    if (order < 0)
      high = middle;
    else
      low = middle + 1;
  }
  if (meets(low)) return low;
  return std::nullopt;
}

}  // namespace quadrille::geometry
