// SPDX-License-Identifier: MIT
// The text forms of the solver's settings.
#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

#include "quadrille/discrete/solver.hpp"

namespace quadrille::discrete {
namespace {

template <class Enum, std::size_t N>
using Names = std::array<std::pair<Enum, std::string_view>, N>;

constexpr Names<System, 4> kSystems{{{System::dpll, "dpll"},
                                     {System::dpll_mdd, "dpll-mdd"},
                                     {System::smt_cbs, "smt-cbs"},
                                     {System::mdd_sat, "mdd-sat"}}};
constexpr Names<CostSearch, 2> kSearches{
    {{CostSearch::iterative, "iterative"}, {CostSearch::core_guided, "core-guided"}}};
constexpr Names<Tie, 2> kTies{{{Tie::any, "any"}, {Tie::fewest_moves, "fewest-moves"}}};
constexpr Names<MddGrowth, 2> kGrowths{
    {{MddGrowth::on_demand, "on-demand"}, {MddGrowth::full, "full"}}};

template <class Enum, std::size_t N>
std::string_view name_of(const Names<Enum, N>& names, Enum value) {
  for (const auto& [item, name] : names)
    if (item == value) return name;
  return "?";
}

template <class Enum, std::size_t N>
std::optional<Enum> value_of(const Names<Enum, N>& names, std::string_view text) {
  for (const auto& [item, name] : names)
    if (name == text) return item;
  return std::nullopt;
}

std::optional<std::int32_t> parse_number(std::string_view text) {
  std::int32_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

Result<CheckSchedule::Fraction> parse_fraction(std::string_view text) {
  const auto refuse = [&](ErrorCode code, const char* why) {
    return Error{code, "check schedule: \"" + std::string(text) + "\" " + why, {}};
  };
  const std::size_t slash = text.find('/');
  if (slash == std::string_view::npos)
    return refuse(ErrorCode::syntax, "is neither watch, propagate nor a fraction such as 1/2");
  const auto numerator = parse_number(text.substr(0, slash));
  const auto denominator = parse_number(text.substr(slash + 1));
  if (!numerator || !denominator)
    return refuse(ErrorCode::syntax, "is not a fraction of two whole numbers");
  if (*numerator <= 0 || *denominator <= *numerator)
    return refuse(ErrorCode::out_of_range, "is not between 0 and 1");
  return CheckSchedule::Fraction{*numerator, *denominator};
}

}  // namespace

std::string_view to_string(System system) noexcept { return name_of(kSystems, system); }
std::optional<System> parse_system(std::string_view text) noexcept {
  return value_of(kSystems, text);
}

std::string_view to_string(CostSearch search) noexcept { return name_of(kSearches, search); }
std::optional<CostSearch> parse_cost_search(std::string_view text) noexcept {
  return value_of(kSearches, text);
}

std::string_view to_string(MddGrowth growth) noexcept { return name_of(kGrowths, growth); }
std::optional<MddGrowth> parse_mdd_growth(std::string_view text) noexcept {
  return value_of(kGrowths, text);
}

std::string_view to_string(Tie tie) noexcept { return name_of(kTies, tie); }
std::optional<Tie> parse_tie(std::string_view text) noexcept { return value_of(kTies, text); }

Result<CheckSchedule> parse_check_schedule(std::string_view text) {
  CheckSchedule schedule;
  if (text == "watch") return schedule;
  if (text == "propagate") {
    schedule.kind = CheckSchedule::Kind::propagate;
    return schedule;
  }
  schedule.kind = CheckSchedule::Kind::fractions;
  while (true) {
    const std::size_t comma = text.find(',');
    const auto fraction = parse_fraction(text.substr(0, comma));
    if (!fraction) return fraction.error();
    if (!schedule.fractions.empty()) {
      const auto& last = schedule.fractions.back();
      if (static_cast<std::int64_t>(last.numerator) * fraction->denominator >=
          static_cast<std::int64_t>(fraction->numerator) * last.denominator)
        return Error{ErrorCode::out_of_range, "check schedule: the fractions do not increase", {}};
    }
    schedule.fractions.push_back(*fraction);
    if (comma == std::string_view::npos) return schedule;
    text.remove_prefix(comma + 1);
  }
}

std::string to_string(const CheckSchedule& schedule) {
  if (schedule.kind == CheckSchedule::Kind::watch) return "watch";
  if (schedule.kind == CheckSchedule::Kind::propagate) return "propagate";
  std::string text;
  for (const auto& f : schedule.fractions) {
    if (!text.empty()) text += ",";
    text += std::to_string(f.numerator) + "/" + std::to_string(f.denominator);
  }
  return text;
}

}  // namespace quadrille::discrete
