// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <charconv>
#include <string>

namespace quadrille::continuous {

/// The shortest decimal number that is read as the same double, which has to be finite.
[[nodiscard]] inline std::string json_number(double value) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return {text.data(), end};
}

}  // namespace quadrille::continuous
