// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "model/trace.hpp"
#include "quadrille/core/limits.hpp"
#include "quadrille/core/random.hpp"
#include "quadrille/discrete/goal_distances.hpp"
#include "quadrille/discrete/instance.hpp"
#include "reservations/reservations.hpp"
#include "reservations/tie_breaker.hpp"

namespace quadrille::discrete {

/// Earliest paths of single agents among moving obstacles: safe interval path planning (Phillips
/// and Likhachev, ICRA 2011) with exact distances. A state is a vertex and one of the gaps between
/// the stays there, so neither time nor memory depends on the horizon. With prices of goals in the
/// distances, arrivals are those at the goal and its price.
class PathPlanner {
 public:
  /// All outlive this object.
  PathPlanner(const Instance& instance, const GoalDistances& distances, Random& random);

  /// A path of least arrival that collides with no reserved path, now or after its end, and arrives
  /// by `latest`; a random one among several. nullopt if there is none, if it would take more than
  /// `effort`, or if a limit was met. Requires that the start is free at timestep 0.
  std::optional<Path> find(AgentId agent, const Reservations& reservations, Timestep latest,
                           std::int64_t effort, LimitMonitor& limits);
  /// States expanded by all calls.
  [[nodiscard]] std::int64_t effort() const noexcept { return effort_; }

 private:
  using LabelIndex = std::uint32_t;
  struct Label {
    VertexId vertex;
    std::uint32_t gap;  // Before this stay of the vertex.
    Timestep time;      // Of arrival.
    Timestep gap_end;
    LabelIndex parent;
    LabelIndex next_here;  // Labels of the same vertex.
    bool outdated;         // An earlier arrival in the same gap is known.
    bool is_end;           // It stays there, and has paid.
  };
  /// What an expansion knows of its label.
  struct Origin {
    VertexId vertex;
    LabelIndex from;
    Timestep first;  // Arrival of who leaves at once.
    Timestep gap_end;
    VertexId back;  // Where it came from, if the gap there has not ended; else `vertex`.
    std::uint32_t back_gap = 0;
    Timestep back_gap_end = 0;
  };
  struct Head {
    std::uint32_t search = 0;
    LabelIndex first = kNoLabel;
  };

  bool begin(AgentId agent, const Reservations& reservations, Timestep latest);
  void expand(LabelIndex from);
  void reach(const Origin& origin, VertexId to);
  void add(VertexId v, std::uint32_t gap, Timestep time, Timestep gap_end, LabelIndex parent,
           Timestep distance);
  void put(const Label& label, Timestep estimate);

  const Instance& instance_;
  const GoalDistances& distances_;
  TieBreaker ties_;
  std::int64_t effort_ = 0;

  // Of the current search.
  std::uint32_t search_ = 0;
  GoalDistances::Row row_;
  const Goals* goals_ = nullptr;
  const Reservations* reservations_ = nullptr;
  Timestep earliest_ = 0, latest_ = 0;  // No arrival before, none after.
  IdVector<VertexId, Head> heads_;
  std::vector<Label> labels_;
  std::vector<std::vector<LabelIndex>> buckets_;  // By estimated arrival - earliest_.
  std::size_t num_buckets_ = 0;                   // In use; the others are empty.
};

}  // namespace quadrille::discrete
