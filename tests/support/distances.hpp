// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "quadrille/core/limits.hpp"
#include "quadrille/discrete/goal_distances.hpp"

namespace quadrille::discrete::support {

inline std::shared_ptr<const GoalDistances> distances_of(const Instance& instance) {
  LimitMonitor limits{Limits{}};
  return GoalDistances::make(instance, limits);
}

/// Of an instance that has this task only.
inline std::shared_ptr<const GoalDistances> distances_of(const Graph& graph, const Agent& task) {
  return distances_of(Instance::make(graph, {task}).value());
}

}  // namespace quadrille::discrete::support
