// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

#include "quadrille/core/ids.hpp"
#include "quadrille/core/limits.hpp"
#include "quadrille/discrete/instance.hpp"
#include "quadrille/discrete/plan.hpp"

namespace quadrille::discrete {

/// A plan of the instance made of paths of some of the agents, empty for the others: these get
/// cheapest paths, and where agents meet some of them other ones (PlanRepair). Under rules only
/// paths of all agents will do. nullopt if that is not enough, or a limit was met.
[[nodiscard]] std::optional<Plan> mend(const Instance& instance, IdVector<AgentId, Path> paths,
                                       std::uint32_t seed, LimitMonitor& limits);

}  // namespace quadrille::discrete
