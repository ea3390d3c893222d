// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <utility>

namespace quadrille::cli::campaign {

/// The value of a JSON number written without fraction and exponent that fits into the type; else
/// nothing. nlohmann's own conversions take 1.5, true and 1e300, too: the last one is undefined.
template <std::integral Number>
[[nodiscard]] std::optional<Number> whole(const nlohmann::ordered_json& json) {
  const auto fitting = [](auto value) {
    return std::in_range<Number>(value) ? std::optional(static_cast<Number>(value)) : std::nullopt;
  };
  if (json.is_number_unsigned()) return fitting(json.get<std::uint64_t>());
  if (json.is_number_integer()) return fitting(json.get<std::int64_t>());
  return std::nullopt;
}

/// The same for a value that has to be there. Throws std::runtime_error.
template <std::integral Number>
[[nodiscard]] Number require_whole(const nlohmann::ordered_json& json) {
  if (const auto value = whole<Number>(json)) return *value;
  throw std::runtime_error(json.dump() + " is no whole number that can be");
}

}  // namespace quadrille::cli::campaign
