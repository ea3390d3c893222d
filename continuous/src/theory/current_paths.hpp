// SPDX-License-Identifier: MIT
#pragma once

#include "theory/known_path.hpp"
#include "theory/model.hpp"

namespace quadrille::continuous {

/// One current path per agent, and which obstacle is in the way of a path.
class CurrentPaths {
 public:
  using Path = KnownPathRef;
  using Cost = quadrille::Cost;

  /// `model` outlives the object. Paths are null at first.
  explicit CurrentPaths(const Model& model)
      : model_(model), paths_(model.instance().num_agents()) {}
  [[nodiscard]] const KnownPathRef& path(AgentId i) const { return paths_[i]; }
  void set_path(AgentId i, const KnownPathRef& path) { paths_[i] = path; }
  [[nodiscard]] Cost cost(const KnownPathRef& path) const { return as_cost(path->path.arrival); }
  [[nodiscard]] bool breaks(const KnownPathRef& path, ObstacleId id) const {
    return path->uses.breaks(model_.obstacles()[id].bans);
  }

 private:
  const Model& model_;
  IdVector<AgentId, KnownPathRef> paths_;
};

using PathTrail = lazy::ObstacleTrail<CurrentPaths>;

}  // namespace quadrille::continuous
