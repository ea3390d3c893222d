// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "quadrille/core/attribution.hpp"

namespace quadrille::support {

/// The least cost of a plan of these agents, as if there were no others; nullopt: there is none.
using LeastCost = std::function<std::optional<Cost>(const std::vector<AgentId>& agents)>;

/// What is wrong with an attribution; empty if nothing is. Looks at every set of agents, so there
/// may be no more than a few.
[[nodiscard]] std::string find_fault(const Attribution& attribution, Cost lower_bound,
                                     const LeastCost& least);

/// How many raises are claims about some of the agents only.
[[nodiscard]] int num_partial_raises(const Attribution& attribution);

}  // namespace quadrille::support
