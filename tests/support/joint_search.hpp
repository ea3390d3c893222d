// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>

#include "quadrille/core/outcome.hpp"
#include "quadrille/discrete/instance.hpp"
#include "quadrille/discrete/plan.hpp"

namespace quadrille::discrete::support {

/// What the joint search found out about an instance.
struct JointAnswer {
  Status status = Status::unknown;  ///< optimal | infeasible | unknown (too many states).
  Cost cost = 0;                    ///< When optimal.
  Plan plan;                        ///< When optimal: a plan of that cost.
};

/// The oracle of the tests: the exact answer by search over the joint positions of all agents. It
/// shares nothing with the library but the types of instances and plans.
///
/// Sum of costs: a state is the positions and the set of agents that have decided never to leave
/// the goal where they are again; only the others pay for a timestep. Makespan: a state is the
/// positions, and every timestep costs one until all agents are at their goals. Gives up without
/// searching if there are more than `max_states` states.
[[nodiscard]] JointAnswer joint_search(const Instance& instance, Objective objective,
                                       std::size_t max_states = 4'000'000);

/// Replays a plan by the definition: empty if it is one, else what is wrong with it.
[[nodiscard]] std::string replay(const Instance& instance, const Plan& plan);

}  // namespace quadrille::discrete::support
