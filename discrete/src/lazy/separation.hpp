// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lazy/lazy_trail.hpp"
#include "lazy/path_search.hpp"
#include "quadrille/core/limits.hpp"

namespace quadrille::discrete {

/// Finds the collisions of the agents that have a cap, and *bypasses*: other paths within the caps
/// with fewer collisions (after Boyarski et al. 2015, ICAPS).
class Separation {
 public:
  /// All outlive the object.
  Separation(PathIndex& paths, LazyTrail& trail, PathSearch& search, LimitMonitor& limits)
      : paths_(paths), trail_(trail), search_(search), limits_(limits) {}

  /// The collisions of current paths among agents that have a cap. Valid until the next call of any
  /// function of this object.
  [[nodiscard]] const std::vector<Encounter>& collisions();
  /// Replaces the agent's path by one with fewer collisions; false if none was found. Requires that
  /// the path is not violated.
  bool bypass(AgentId agent);
  /// The same for all agents that collide, one after the other. False if none was found for any.
  bool bypass_all();

 private:
  PathIndex& paths_;
  LazyTrail& trail_;
  PathSearch& search_;
  LimitMonitor& limits_;
  std::vector<Encounter> collisions_;
};

}  // namespace quadrille::discrete
