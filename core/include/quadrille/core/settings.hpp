// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "quadrille/core/export.hpp"
#include "quadrille/core/result.hpp"

QUADRILLE_API_BEGIN

namespace quadrille {

/// The numbers that searches rest on and that nobody has to choose, in one table, so that each of
/// them can be measured without a build (bench/README.md). They change how long a solve takes, and
/// with limits what it comes to, never whether an answer is true. Not an interface: a version may
/// drop any of them or give it another meaning.
struct Settings {
#define QUADRILLE_SETTING(name, value, least, most, unit, meaning, basis) std::int64_t name = value;
#include "quadrille/core/settings_table.inc"
#undef QUADRILLE_SETTING
};

/// A line of the table.
struct SettingInfo {
  std::string_view name;
  std::int64_t Settings::*value;
  std::int64_t least, most;  ///< Both included.
  std::string_view unit;
  std::string_view meaning;  ///< Goes on after the number and its unit.
};
[[nodiscard]] std::span<const SettingInfo> settings_table() noexcept;

/// What a setting in per mille is in per cent.
[[nodiscard]] constexpr double in_percent(std::int64_t per_mille) {
  return static_cast<double>(per_mille) / 10;
}

/// Carries out "name=value". Errors: syntax; out_of_range for a name that does not exist and a
/// value that is not in its range.
[[nodiscard]] std::optional<Error> assign_setting(Settings& settings, std::string_view assignment);

/// The first value out of its range, if there is one.
[[nodiscard]] std::optional<Error> check_settings(const Settings& settings);

}  // namespace quadrille

QUADRILLE_API_END
