// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "quadrille/continuous/instance.hpp"
#include "quadrille/continuous/plan.hpp"
#include "quadrille/continuous/verify.hpp"
#include "quadrille/core/ids.hpp"

namespace quadrille::continuous {

/// "agent 3"
[[nodiscard]] std::string agent_name(AgentId i);
/// A time as the input of the instance counts.
[[nodiscard]] std::string time_text(const Instance& instance, Ticks ticks);

/// What happens when all go their ways.
struct Happenings {
  std::vector<Violation> collisions;  ///< By tick, then agents, those with obstacles first.
  std::vector<Clearance> clearances;  ///< The least ones, see VerifyReport::clearances.
};

/// Lets all agents and moving obstacles go their ways at once, move by move in order of time; who
/// is near whom is looked up by place. Agents whose paths are not sound are left out. On purpose
/// this uses nothing of geometry/ but its names for integers: an independent opinion.
///
/// Time: that of looking at those who are near each other at the same time, and the logarithm of
/// the number of agents for each move. Memory: the number of agents, of collisions and of the
/// clearances that are asked for.
[[nodiscard]] Happenings replay(const Instance& instance, const Plan& plan,
                                const IdVector<AgentId, bool>& sound, std::size_t num_clearances);

}  // namespace quadrille::continuous
