// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "support/generators.hpp"
#include "support/joint_search.hpp"

namespace quadrille::discrete::support {

/// The oracle for instances with rules: a search over what all agents do together. A state is where
/// each agent is, how many waypoints it has visited, whether it is done, where all were the last
/// timesteps if they have to keep apart in time, and the timestep, up to the last one that a rule
/// names. Shares nothing with the library but the types. Unknown beyond `max_states` states.
[[nodiscard]] JointAnswer ruled_search(const Instance& instance, Objective objective,
                                       std::size_t max_states);

/// The least cost, and the fewest moves of the plans that cost as much.
struct Cheapest {
  Status status = Status::unknown;
  Cost cost = 0;
  std::int64_t moves = 0;
};
/// The same search, whose costs are pairs.
[[nodiscard]] Cheapest fewest_moves_search(const Instance& instance, Objective objective,
                                           std::size_t max_states);

/// Replays a plan by the definitions of all rules: empty if it is one, else what is wrong with it.
[[nodiscard]] std::string replay_rules(const Instance& instance, const Plan& plan);

/// Which rules `with_random_rules` may draw.
struct RuleKinds {
  bool leaving = false, times = false, one_way = false, blockages = false, robust = false,
       waypoints = false, turning = false;
};
/// The instance with rules, most of them of the kinds named. Agents that leave may get the goals of
/// others. May be infeasible.
[[nodiscard]] Instance with_random_rules(Random& random, const Instance& instance, RuleKinds kinds);

}  // namespace quadrille::discrete::support
