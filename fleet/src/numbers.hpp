// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <charconv>
#include <cmath>
#include <string>

namespace quadrille::fleet {

/// The shortest decimal number that is read as the same double, without an exponent where people
/// would not write one; zero has no sign.
[[nodiscard]] inline std::string shortest(double value) {
  std::array<char, 64> text{};
  char *const begin = text.data(), *const end = begin + text.size();
  const double size = std::abs(value);
  if (size >= 1e-7 && size < 1e7)
    return {begin, std::to_chars(begin, end, value, std::chars_format::fixed).ptr};
  return {begin, std::to_chars(begin, end, value + 0.0).ptr};
}

}  // namespace quadrille::fleet
