// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "theory/model.hpp"

namespace quadrille::continuous {

/// Looks for agents that cannot all reach their goals, whatever it costs, even if there were no
/// others: first two of them, then all. Leaves the times out, so that there is a finite number of
/// states; what is found is certain, but not every instance without a plan is found out. Empty: no
/// such agents were found before the effort became too much or the limits of the model were met.
[[nodiscard]] std::vector<AgentId> find_blocked_agents(Model& model);

}  // namespace quadrille::continuous
