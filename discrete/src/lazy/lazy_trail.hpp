// SPDX-License-Identifier: MIT
#pragma once

#include "lazy/lazy_model.hpp"
#include "paths/path_index.hpp"
#include "quadrille/lazy/vocabulary.hpp"

namespace quadrille::discrete {

/// The current paths, and which obstacle hits a path.
class TrailedPaths {
 public:
  using Path = discrete::Path;
  using Cost = quadrille::Cost;

  /// Both outlive the object.
  TrailedPaths(PathIndex& paths, const LazyModel& model) : paths_(paths), model_(model) {}
  [[nodiscard]] const Path& path(AgentId i) const { return paths_.path(i); }
  void set_path(AgentId i, const Path& path) { paths_.replace(i, path); }
  [[nodiscard]] Cost cost(const Path& path) const {
    return static_cast<Cost>(path.size()) - 1 + model_.price(path.back());
  }
  [[nodiscard]] bool breaks(const Path& path, ObstacleId id) const {
    const AgentId agent = model_.obstacles()[id].agent;
    return model_.obstacles().hits(id, path, model_.instance().agents()[agent].leaves);
  }

 private:
  PathIndex& paths_;
  const LazyModel& model_;
};

/// Caps are lazy::kNoCap for agents that do not take part.
using LazyTrail = lazy::ObstacleTrail<TrailedPaths>;

[[nodiscard]] inline bool takes_part(const LazyTrail& trail, AgentId i) {
  return trail.cap(i) < lazy::kNoCap;
}
/// The cap of the agent; kForever if it has none.
[[nodiscard]] inline Timestep cap_of(const LazyTrail& trail, AgentId i) {
  return takes_part(trail, i) ? static_cast<Timestep>(trail.cap(i)) : kForever;
}

}  // namespace quadrille::discrete
