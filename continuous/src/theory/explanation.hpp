// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "paths/path_finder.hpp"

namespace quadrille::continuous {

/// Finds out which bans are to blame that an agent has no path before some tick.
class Explainer {
 public:
  explicit Explainer(PathFinder& finder) : finder_(finder) {}

  /// Slots of `bans`, all of which are on, that are enough to keep all paths from arriving before
  /// `bound`, while without any one of them some path would. Requires that there is no path before
  /// `bound`. The slots are appended to `slots`, in order; all are switched on again afterwards.
  ///
  /// As long as there is a path around the slots that were taken, the first one that it breaks is
  /// taken, too. Two searches for each slot that is taken, most of which find a path. In the order
  /// in which literals became false, explanations of early ones take the solver back further.
  void explain(const PathTask& task, BanTable& bans, Ticks bound, std::vector<std::size_t>& slots);

 private:
  void drop_unneeded(const PathTask& task, BanTable& bans, Ticks bound);

  PathFinder& finder_;
  TimedPath path_;
  std::vector<std::size_t> enough_;
};

}  // namespace quadrille::continuous
