// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "paths/path_finder.hpp"

namespace quadrille::continuous {

/// Finds out which bans are to blame that an agent has no path before some tick.
class Explainer {
 public:
  explicit Explainer(PathFinder& finder) : finder_(finder) {}

  /// Switches slots of `bans`, all of which are on, off until no path arrives before `bound` but
  /// switching off any other one would give one. Requires that there is no path before `bound`.
  /// The slots left are appended to `slots`; all are switched on again afterwards.
  void explain(const PathTask& task, BanTable& bans, Ticks bound, std::vector<std::size_t>& slots);

 private:
  [[nodiscard]] bool has_path(const PathTask& task, BanTable& bans, Ticks bound);

  PathFinder& finder_;
  std::vector<char> relevant_;
  std::vector<std::size_t> candidates_;
};

}  // namespace quadrille::continuous
