// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "quadrille/core/goals.hpp"
#include "quadrille/core/result.hpp"
#include "quadrille/discrete/instance.hpp"
#include "quadrille/discrete/movingai.hpp"
#include "quadrille/discrete/plan.hpp"
#include "quadrille/input/source.hpp"
#include "quadrille/text/names.hpp"

namespace quadrille::input {

/// What is wrong with the combination of options where they name no roadmap; empty if nothing is.
[[nodiscard]] std::string check_grid_options(const InputOptions& options, Need need);

/// An instance and what is worth saying about its files.
struct GridInput {
  discrete::Instance instance;
  std::string source;       ///< The file that holds the graph.
  std::string task_source;  ///< The file that holds the agents; empty if there are none.
  std::size_t rows = 0;     ///< Of the scenario; 0 without one.
  std::vector<discrete::LetterCount> other_letters;
  std::string other_map;  ///< What the scenario names, if it is not the map; else empty.
  text::Names names = {};
  std::string note = "";  ///< About the files, for the user; empty if there is nothing to say.
  /// What is to be done besides, where the files say so: the places to go to, one after the other.
  std::vector<std::vector<Goals>> tasks = {};
  double num_revealed = 1;  ///< So many of them per agent are known at a time.
};
/// Requires options that pass check_grid_options. Reads each file once, front to back.
/// A problem of the League of Robot Runners is read without the turns of its robots.
[[nodiscard]] Result<GridInput> load_grid_input(const InputOptions& options);

/// What is wrong with an instance whose robots are to be sent about: it has rules.
[[nodiscard]] std::optional<Error> refuse_rules(const GridInput& grid);

/// Whether the options name a map and no agents.
[[nodiscard]] bool is_map_alone(const InputOptions& options);
/// The map of a plan, with agents that begin and end where its paths do. `file`: that of the plan.
/// Errors (invalid_plan): two agents begin, or end, in the same place.
[[nodiscard]] Result<GridInput> with_agents_of(GridInput input, const discrete::Plan& plan,
                                               const std::string& file);

}  // namespace quadrille::input
