// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "quadrille/core/ids.hpp"
#include "quadrille/core/result.hpp"
#include "quadrille/text/names.hpp"

namespace quadrille::cli {

/// What a robot is called by others, per agent.
using RobotNames = IdVector<AgentId, std::string>;

/// Those of the names, "agent3" where there is none. Error (invalid_instance, without a file): two
/// are called alike.
[[nodiscard]] Result<RobotNames> robot_names(const text::Names& names, std::size_t num_agents);

}  // namespace quadrille::cli
