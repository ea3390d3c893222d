// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/timesteps.hpp"
#include "quadrille/discrete/plan.hpp"
#include "quadrille/lazy/trail.hpp"

namespace quadrille::discrete {

using lazy::ObstacleId;

/// Being in a vertex at a timestep.
struct Visit {
  VertexId vertex;
  Timestep timestep = 0;
  friend auto operator<=>(const Visit&, const Visit&) = default;
};

/// What one agent must not do while a literal is false.
struct Obstacle {
  enum class Kind : std::uint8_t {
    point,    ///< Be in `vertex` at `first`.
    edge,     ///< Move between `vertex` and `to`, in either direction, from `first` to `first` + 1.
    range,    ///< Be in `vertex` at any timestep from `first` to `last`, which can be kForever.
    barrier,  ///< Make any of a list of visits.
    end,      ///< Rest in `vertex` in the end, whenever. Being there before is nothing.
    elsewhere,  ///< Rest anywhere but in `vertex` in the end.
  };
  Kind kind = Kind::point;
  AgentId agent;
  sat::Lit allowed;  ///< False: the obstacle is active.
  VertexId vertex, to;
  Timestep first = 0, last = 0;
  std::uint32_t visits_begin = 0, visits_end = 0;  // barrier, see ObstacleTable::visits
};

/// All obstacles that were ever made. Only grows.
class ObstacleTable {
 public:
  ObstacleId add_point(AgentId agent, sat::Lit allowed, Visit visit);
  ObstacleId add_edge(AgentId agent, sat::Lit allowed, VertexId from, VertexId to, Timestep t);
  /// Requires first <= last.
  ObstacleId add_range(AgentId agent, sat::Lit allowed, VertexId vertex, Timestep first,
                       Timestep last);
  ObstacleId add_end(AgentId agent, sat::Lit allowed, VertexId vertex);
  ObstacleId add_elsewhere(AgentId agent, sat::Lit allowed, VertexId vertex);
  /// Requires at least one visit.
  ObstacleId add_barrier(AgentId agent, sat::Lit allowed, std::span<const Visit> visits);

  [[nodiscard]] const Obstacle& operator[](ObstacleId id) const { return obstacles_[id.index()]; }
  [[nodiscard]] std::size_t size() const noexcept { return obstacles_.size(); }
  /// Of a barrier. Valid until the next barrier is added.
  [[nodiscard]] std::span<const Visit> visits(const Obstacle& barrier) const {
    return std::span(visits_).subspan(barrier.visits_begin,
                                      barrier.visits_end - barrier.visits_begin);
  }
  /// True if the path does what the obstacle forbids. It ends with a rest for ever, or its agent
  /// leaves there.
  [[nodiscard]] bool hits(ObstacleId id, const Path& path, bool leaves = false) const;
  /// The last timestep from which on the obstacle forbids to rest in `vertex` for ever; -1: it
  /// never does.
  [[nodiscard]] Timestep last_block(const Obstacle& obstacle, VertexId vertex) const;

 private:
  ObstacleId add(const Obstacle& obstacle);
  std::vector<Obstacle> obstacles_;
  std::vector<Visit> visits_;
};

}  // namespace quadrille::discrete
