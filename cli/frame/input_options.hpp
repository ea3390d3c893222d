// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "frame/option_parser.hpp"
#include "quadrille/continuous/plan_files.hpp"
#include "quadrille/discrete/plan_formats.hpp"
#include "quadrille/input/roadmap.hpp"
#include "quadrille/input/source.hpp"

namespace quadrille::cli {

using input::InputOptions;
using input::Need;
using input::RoadmapOptions;

void add_input_options(CLI::App& app, InputOptions& options);
void add_roadmap_options(CLI::App& app, RoadmapOptions& options);

/// A plan format in both domains; "json" is one of either.
struct PlanFormats {
  std::optional<discrete::PlanFormat> discrete;
  std::optional<continuous::PlanFormat> continuous;

  [[nodiscard]] bool is_given() const { return discrete || continuous; }
  /// What is wrong with the format where the instance is one with timesteps, or a roadmap; empty if
  /// nothing is, or no format was given.
  [[nodiscard]] std::string why_not_discrete(const std::string& option) const;
  [[nodiscard]] std::string why_not_continuous(const std::string& option) const;
};
/// "--plan-format" and its like. Refuses unknown names.
CLI::Option* add_plan_format(CLI::App& app, const std::string& name, PlanFormats& formats,
                             const std::string& help);

}  // namespace quadrille::cli
