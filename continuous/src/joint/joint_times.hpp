// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "joint/joint_space.hpp"
#include "quadrille/continuous/plan.hpp"

namespace quadrille::continuous {

/// The paths, by position among the agents, of a sequence of events from the starts on for which
/// there are times; at the least times, which are the same for all of them at once. The longest
/// paths in a graph with a few arcs per event: O(n^2) at worst, about linear.
[[nodiscard]] std::vector<Path> earliest_paths(const Instance& instance, JointSpace& space,
                                               const std::vector<JointStep>& steps);

}  // namespace quadrille::continuous
