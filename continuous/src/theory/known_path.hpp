// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "quadrille/lazy/trail.hpp"
#include "traffic/steps.hpp"

namespace quadrille::continuous {

/// A path and what follows from it.
struct KnownPath {
  TimedPath path;
  PathUses uses;
  std::vector<Step> steps;
  std::uint64_t version = 0;  ///< No two paths have the same.
  /// An obstacle that it was found to run into last.
  mutable std::optional<lazy::ObstacleId> breaks;
};
using KnownPathRef = std::shared_ptr<const KnownPath>;

[[nodiscard]] KnownPathRef known_path(const Instance& instance, AgentId agent, TimedPath path,
                                      std::uint64_t version);

}  // namespace quadrille::continuous
