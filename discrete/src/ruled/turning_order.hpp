// SPDX-License-Identifier: MIT
#pragma once

#include "quadrille/discrete/instance.hpp"
#include "quadrille/discrete/plan.hpp"

namespace quadrille::discrete {

/// A plan that leaves time to turn, made of one that does not: agents come to each vertex in the
/// same order, each move begins as early as that and the turn before it allow, and agents that go
/// round together still do. Requires an instance in which turns take time and that has no other
/// rules, and a plan that is valid but for turns. O(V + length of the plan), times the agents that
/// follow each other at a timestep.
[[nodiscard]] Plan with_turns(const Instance& instance, const Plan& plan);

}  // namespace quadrille::discrete
