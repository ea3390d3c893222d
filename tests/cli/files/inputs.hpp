// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>

#include "cli/files/commands.hpp"
#include "support/random.hpp"

namespace quadrille::cli::test {

using support::Random;

/// Names of files that do not exist yet, of all kinds that a shell can write.
class FileNames {
 public:
  explicit FileNames(Random& random) : random_(random) {}
  /// With this ending, such as ".json".
  std::string next(const std::string& ending);

 private:
  Random& random_;
  int count_ = 0;
};

/// An instance in files, as a user would name it.
struct Input {
  Words options;          ///< "--map", "m.map", "--scen", ...
  Words map;              ///< Without the agents, where `generate --map` takes it; else empty.
  bool in_time = false;   ///< With a roadmap.
  bool has_cells = true;  ///< On a grid, in timesteps.
  bool has_heights = false;
  bool may_block = false;    ///< Some plans have none: agents would wait where nobody may wait.
  bool is_no_order = false;  ///< No order of moves makes up for delays: obstacles that move, ...
  bool has_goal_sets = false;
  std::size_t num_agents = 0;  ///< As many as the options say.
};

/// A small instance, written by the program or its library where these can write it.
[[nodiscard]] Input draw_steps(Random& random, Workshop& workshop, FileNames& names);
[[nodiscard]] Input draw_roadmap(Random& random, Workshop& workshop, FileNames& names);

/// A size of a tick or a length unit.
[[nodiscard]] double draw_resolution(Random& random);
/// The shortest text that is read as this number.
[[nodiscard]] std::string number_text(double number);

}  // namespace quadrille::cli::test
