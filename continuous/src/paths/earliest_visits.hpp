// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "paths/timed_path.hpp"

namespace quadrille::continuous {

/// When an agent that is alone can set out from each vertex, by index; kForever if never.
[[nodiscard]] std::vector<Ticks> earliest_visits(const Instance& instance, AgentId agent);

}  // namespace quadrille::continuous
