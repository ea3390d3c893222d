// SPDX-License-Identifier: MIT
#include "windows.hpp"

#include <algorithm>
#include <cstdint>

namespace quadrille::execution {
namespace {

constexpr std::int64_t kFinest = std::int64_t{1} << 20;

/// The largest whole number that is not above count / divisor.
std::int64_t floor_div(std::int64_t count, std::int64_t divisor) {
  const std::int64_t quotient = count / divisor;
  return quotient * divisor > count ? quotient - 1 : quotient;
}

}  // namespace

std::optional<UnsafeWindow> unsafe_window(const geometry::BodyPair& bodies,
                                          const geometry::Motion& a, const geometry::Motion& b) {
  if (const auto offsets = bodies.unsafe_offsets(a, b))
    return UnsafeWindow{offsets->first() - 1, offsets->last() + 1};
  if (!bodies.can_meet(a, b)) return std::nullopt;
  // The same motions in finer ticks.
  std::int64_t parts = kFinest;
  const Ticks longest = std::max(a.behind + a.duration, b.behind + b.duration);
  while (parts > 1 && longest > geometry::kMaxDuration / parts) parts /= 2;
  geometry::Motion fine_a = a, fine_b = b;
  for (geometry::Motion* const fine : {&fine_a, &fine_b}) {
    fine->duration *= parts;
    fine->behind *= parts;
  }
  const auto offsets = bodies.unsafe_offsets(fine_a, fine_b);
  if (!offsets) return std::nullopt;
  const Ticks below(floor_div(offsets->first().value(), parts));
  return UnsafeWindow{below, below + 1};
}

}  // namespace quadrille::execution
