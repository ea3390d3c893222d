// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "quadrille/core/export.hpp"

QUADRILLE_API_BEGIN

namespace quadrille {

/// Where a robot on a grid faces: clockwise on the map, whose rows go down.
enum class Heading : std::uint8_t { east, south, west, north };
inline constexpr std::array kHeadings{Heading::east, Heading::south, Heading::west, Heading::north};
[[nodiscard]] constexpr std::string_view to_string(Heading heading) noexcept {
  constexpr std::array<std::string_view, kHeadings.size()> kNames{"east", "south", "west", "north"};
  return kNames[static_cast<std::size_t>(heading)];
}
/// The heading after a quarter turn.
[[nodiscard]] constexpr Heading right_of(Heading heading) noexcept {
  return static_cast<Heading>((static_cast<unsigned>(heading) + 1) % kHeadings.size());
}
[[nodiscard]] constexpr Heading left_of(Heading heading) noexcept {
  return static_cast<Heading>((static_cast<unsigned>(heading) + 3) % kHeadings.size());
}
/// Quarter turns from one to the other, the shorter way round: 0, 1 or 2.
[[nodiscard]] constexpr int quarter_turns(Heading from, Heading to) noexcept {
  const unsigned right =
      (static_cast<unsigned>(to) + kHeadings.size() - static_cast<unsigned>(from)) %
      static_cast<unsigned>(kHeadings.size());
  return right == 3 ? 1 : static_cast<int>(right);
}

}  // namespace quadrille

QUADRILLE_API_END
