// SPDX-License-Identifier: MIT
#include "quadrille/core/settings.hpp"

#include <algorithm>
#include <charconv>
#include <string>

namespace quadrille {
namespace {

constexpr SettingInfo kTable[] = {
#define QUADRILLE_SETTING(name, value, least, most, unit, meaning, basis) \
  {#name, &Settings::name, least, most, unit, meaning},
#include "quadrille/core/settings_table.inc"
#undef QUADRILLE_SETTING
};

std::optional<Error> check(const SettingInfo& info, std::int64_t value) {
  if (value >= info.least && value <= info.most) return std::nullopt;
  return Error{ErrorCode::out_of_range,
               "the setting " + std::string(info.name) + " is " + std::to_string(value) +
                   ", it must be from " + std::to_string(info.least) + " to " +
                   std::to_string(info.most) + ": " + std::string(info.unit) + " " +
                   std::string(info.meaning),
               {}};
}

}  // namespace

std::span<const SettingInfo> settings_table() noexcept { return kTable; }

std::optional<Error> assign_setting(Settings& settings, std::string_view assignment) {
  const std::size_t at = assignment.find('=');
  const std::string_view name = assignment.substr(0, at);
  const auto* const info = std::find_if(std::begin(kTable), std::end(kTable),
                                        [&](const SettingInfo& one) { return one.name == name; });
  if (info == std::end(kTable))
    return Error{ErrorCode::out_of_range, "there is no setting '" + std::string(name) + "'", {}};
  const std::string_view text =
      at == std::string_view::npos ? std::string_view() : assignment.substr(at + 1);
  std::int64_t value = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || fault != std::errc() || end != text.data() + text.size())
    return Error{
        ErrorCode::syntax,
        "the setting " + std::string(name) + " needs a whole number: " + std::string(name) + "=N",
        {}};
  if (auto error = check(*info, value)) return error;
  settings.*(info->value) = value;
  return std::nullopt;
}

std::optional<Error> check_settings(const Settings& settings) {
  for (const SettingInfo& info : kTable)
    if (auto error = check(info, settings.*(info.value))) return error;
  return std::nullopt;
}

}  // namespace quadrille
