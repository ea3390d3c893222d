// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "quadrille/continuous/instance.hpp"

namespace quadrille::continuous {

/// Two agents that cannot both get to their goals.
struct StuckPair {
  AgentId first, second;
  friend bool operator==(const StuckPair&, const StuckPair&) = default;
};

/// "agents 0 and 1 cannot both get to their goals: ..."
[[nodiscard]] std::string describe(const StuckPair& pair);

/// Effort of find_stuck_pair when nothing else is asked for: well under a second.
inline constexpr std::int64_t kFeasibilityEffort = 20'000'000;

/// Looks for two agents that cannot get from their starts to their goals without colliding, however
/// slow or fast, forwards or backwards they move along the edges, with nobody else there. If there
/// is such a pair, the instance has no plan: docs/continuous.md has the proof. nullopt proves
/// nothing: more than two agents may be in each other's way, one-way edges and fixed speeds are not
/// taken into account, and pairs beyond the effort are not looked at. The effort is counted in
/// steps: about (vertices + edges) * edges per sum of two radii. Exact; deterministic.
[[nodiscard]] std::optional<StuckPair> find_stuck_pair(const Instance& instance,
                                                       std::int64_t effort = kFeasibilityEffort);

}  // namespace quadrille::continuous
