// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <charconv>
#include <string>

#include "quadrille/core/export.hpp"

QUADRILLE_API_BEGIN

namespace quadrille {

/// The shortest decimal number that is read as the same double.
[[nodiscard]] inline std::string decimal(double value) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return {text.data(), end};
}

}  // namespace quadrille

QUADRILLE_API_END
