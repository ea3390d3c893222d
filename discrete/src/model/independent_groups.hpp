// SPDX-License-Identifier: MIT
#pragma once

#include "quadrille/core/grouping.hpp"
#include "quadrille/discrete/components.hpp"
#include "quadrille/discrete/instance.hpp"

namespace quadrille::discrete {

/// Agents in one component of the graph are one group: no others can ever meet. O(V + E).
[[nodiscard]] AgentGroups independent_groups(const Instance& instance);

}  // namespace quadrille::discrete
