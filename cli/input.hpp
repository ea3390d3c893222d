// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "quadrille/continuous/plan_files.hpp"
#include "quadrille/core/result.hpp"
#include "quadrille/discrete/instance.hpp"
#include "quadrille/discrete/movingai.hpp"
#include "quadrille/discrete/plan_formats.hpp"

namespace quadrille::cli {

/// Where an instance comes from: `--map`, `--scen` and `--agents`, or `--instance`.
struct InputOptions {
  std::string map, scen, instance;
  std::optional<std::int64_t> agents;
  discrete::MapOptions letters;
  /// The contents of `instance`, if they have been read already.
  std::optional<std::string> instance_text;
};

enum class Need {
  tasks,  ///< A map needs its scenario and the number of agents.
  map,    ///< A map alone will do, and all rows of a scenario are taken by default.
};

void add_input_options(CLI::App& app, InputOptions& options);
/// What is wrong with the combination of options; empty if nothing is.
[[nodiscard]] std::string check_input_options(const InputOptions& options, Need need);

/// An instance and what is worth saying about its files.
struct Input {
  discrete::Instance instance;
  std::string source;       ///< The file that holds the graph.
  std::string task_source;  ///< The file that holds the agents; empty if there are none.
  std::size_t rows = 0;     ///< Of the scenario; 0 without one.
  std::vector<discrete::LetterCount> other_letters;
};
/// Requires options that pass check_input_options. Reads each file once, front to back.
[[nodiscard]] Result<Input> load_input(const InputOptions& options);

/// "8 x 8 grid, 64 vertices, 112 edges"
[[nodiscard]] std::string describe_graph(const discrete::Graph& graph);
/// One line per unusual letter.
[[nodiscard]] std::string describe_letters(const std::vector<discrete::LetterCount>& letters);
/// The lines "map" and "agents" of the human output, and one line per unusual letter.
[[nodiscard]] std::string describe_input(const Input& input);

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
