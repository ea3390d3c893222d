// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "paths/scene_store.hpp"
#include "quadrille/continuous/plan.hpp"
#include "quadrille/continuous/solver.hpp"

namespace quadrille::continuous {

/// Proved: these agents alone, as if there were no others, cost at least so much together
/// (makespan: one of them).
struct GroupBound {
  std::vector<AgentId> agents;  ///< Increasing.
  Cost cost = 0;
};

/// What earlier solves on the same roadmap leave to one.
struct Inheritance {
  SceneStore* store = nullptr;  ///< Null, or one that has adopted the instance.
  std::vector<GroupBound> bounds;
  /// Paths of some of the agents, which obey all rules and do not collide; empty for the others.
  std::vector<IdVector<AgentId, Path>> drafts;
};

/// As continuous::solve, with what is known already.
[[nodiscard]] Result<SolveOutcome> solve(const Instance& instance, const SolveOptions& options,
                                         const Inheritance& inheritance);

}  // namespace quadrille::continuous
