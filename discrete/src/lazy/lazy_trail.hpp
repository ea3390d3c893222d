// SPDX-License-Identifier: MIT
#pragma once

#include "paths/path_index.hpp"
#include "quadrille/sat/obstacle_trail.hpp"

namespace quadrille::discrete {

/// The current paths, and which obstacle hits a path.
class TrailedPaths {
 public:
  using Path = discrete::Path;
  using Cost = Timestep;

  /// Both outlive the object.
  TrailedPaths(PathIndex& paths, const ObstacleTable& obstacles)
      : paths_(paths), obstacles_(obstacles) {}
  [[nodiscard]] const Path& path(AgentId i) const { return paths_.path(i); }
  void set_path(AgentId i, const Path& path) { paths_.replace(i, path); }
  [[nodiscard]] Timestep cost(const Path& path) const {
    return static_cast<Timestep>(path.size()) - 1;
  }
  [[nodiscard]] bool breaks(const Path& path, ObstacleId id) const {
    return obstacles_.hits(id, path);
  }

 private:
  PathIndex& paths_;
  const ObstacleTable& obstacles_;
};

/// Caps are kForever for agents that do not take part.
using LazyTrail = sat::ObstacleTrail<TrailedPaths>;

}  // namespace quadrille::discrete
