// SPDX-License-Identifier: MIT
#pragma once

#include "quadrille/discrete/instance.hpp"
#include "quadrille/solve/apart.hpp"

namespace quadrille::discrete {

/// Agents in one component of the graph are one group: no others can ever meet. O(V + E).
[[nodiscard]] solve::AgentGroups independent_groups(const Instance& instance);

}  // namespace quadrille::discrete
