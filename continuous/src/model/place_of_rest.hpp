// SPDX-License-Identifier: MIT
#pragma once

#include "quadrille/continuous/instance.hpp"

namespace quadrille::continuous {

/// Where the agent stays in the end whatever it does; null if it leaves, or has a choice. Valid as
/// long as the agent.
[[nodiscard]] inline const VertexId* place_of_rest(const Agent& agent) {
  return agent.leaves || !agent.goals.is_single() ? nullptr : agent.goals.vertices().data();
}

}  // namespace quadrille::continuous
