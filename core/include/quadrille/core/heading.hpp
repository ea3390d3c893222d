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
/// Of a move to a neighbouring cell, so many columns to the right, or rows down: one of them is 0.
[[nodiscard]] constexpr Heading heading_of_move(int right, int down) noexcept {
  if (down == 0) return right > 0 ? Heading::east : Heading::west;
  return down > 0 ? Heading::south : Heading::north;
}

}  // namespace quadrille

QUADRILLE_API_END
