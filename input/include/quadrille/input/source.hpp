// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "quadrille/core/result.hpp"
#include "quadrille/discrete/movingai.hpp"

namespace quadrille::input {

/// Under this name standard input is a file like others.
inline constexpr const char* kStandardInput = "/dev/stdin";

/// Where an instance comes from: `--map`, `--scen` and `--agents`, or `--instance`.
struct InputOptions {
  std::string map, scen, instance;
  std::optional<std::int64_t> agents;
  discrete::MapOptions letters;
  /// So many agents of a scenario or task, one after the other, share their goals; SIZE_MAX: all.
  /// At least 1.
  std::optional<std::size_t> sharing;
  /// Rules for all agents on grids and graphs: they leave at their goals; plans are k-robust.
  bool leave = false;
  std::optional<std::int64_t> robust;
  /// Plans are for systems that release whole moves: on grids and graphs they are 1-robust.
  bool whole_moves = false;
  /// Maps with more passable cells are refused before a graph is made of them.
  std::size_t most_vertices = SIZE_MAX;
  /// The contents of `instance`, if they have been read already.
  std::optional<std::string> instance_text;
};

enum class Need {
  tasks,  ///< A map needs its scenario and the number of agents.
  map,    ///< A map alone will do, and all rows of a scenario are taken by default.
  plan,   ///< As tasks, or a map alone: a plan says where its agents begin and end.
};

/// What is wrong if an `--instance` with this number of agents has fewer than `--agents` asks for.
[[nodiscard]] std::optional<Error> check_agents(const InputOptions& options, std::size_t agents);

/// What is wrong with `--share-goals` where agents come from elsewhere.
inline constexpr const char* kSharingNeedsTask =
    "--share-goals needs agents of --scen or --task; in --instance they have \"goals\"";

/// What is wrong with options about rules of grids and graphs where there is a roadmap.
inline constexpr const char* kRulesNeedGrid =
    "--leave and --robust are for grids and graphs; in --instance agents on roadmaps have "
    "\"at_goal\"";

/// What is wrong if a map, in this file, has too many passable cells.
[[nodiscard]] std::optional<Error> check_map_size(const InputOptions& options, std::int64_t cells,
                                                  const std::string& file);

/// An error of the reader of maps; one about a letter says which options can help.
[[nodiscard]] Error with_letters_hint(Error error);

/// The text of a file, which may be a pipe. Errors: those of text::read_all.
[[nodiscard]] Result<std::string> read_text(const std::string& file);

}  // namespace quadrille::input
