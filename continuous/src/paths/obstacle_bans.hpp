// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "paths/bans.hpp"
#include "quadrille/core/limits.hpp"

namespace quadrille::continuous {

/// Bans that an agent of the class obeys if and only if it keeps clear of all moving obstacles,
/// sorted. Each step of an obstacle is looked at with each edge and each vertex. Throws
/// LimitReached.
[[nodiscard]] std::vector<Ban> bans_around_obstacles(const Instance& instance, ClassId c,
                                                     LimitMonitor& limits);

}  // namespace quadrille::continuous
