// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "model/trace.hpp"
#include "paths/agent_distances.hpp"
#include "paths/obstacle_map.hpp"
#include "quadrille/core/limits.hpp"

namespace quadrille::discrete {

/// Cheapest paths of one agent around its obstacles: safe interval path planning (Phillips and
/// Likhachev, ICRA 2011) with exact distances. Searched are a state of the agent and a span of time
/// in which no obstacle forbids it, so that time and memory follow the vertices and the obstacles,
/// however late the agent has to arrive.
class SafeIntervalSearch {
 public:
  /// Searches throw LimitReached when `limits` are met; null: there are none.
  explicit SafeIntervalSearch(std::size_t num_vertices, LimitMonitor* limits = nullptr)
      : limits_(limits), heads_(num_vertices) {}

  /// Finds a cheapest path of at most `max_cost`. False if there is none. `first_hits`, one per
  /// slot of the obstacles or none if they do not matter, is lowered to the smallest slack at which
  /// a slot blocked a step out of a state that can be reached; complete for all slacks below that
  /// of the path found, or up to the limit if none was. `obstacles` are loaded for the agent.
  [[nodiscard]] bool find(const AgentDistances& distances, const ObstacleMap& obstacles,
                          Timestep max_cost, std::span<Timestep> first_hits, Path& path);

  /// States expanded so far by all searches.
  [[nodiscard]] std::int64_t effort() const noexcept { return effort_; }

 private:
  using LabelIndex = std::uint32_t;
  /// From `begin` to `end`, both included.
  struct Interval {
    Timestep begin, end;
    Timestep arrival;  // The earliest one known.
  };
  /// The intervals of a state, in the search with that stamp.
  struct Head {
    std::uint32_t stamp = 0;
    std::uint32_t begin = 0, end = 0;
  };
  struct Label {
    VertexId vertex;  // a place; see `state`
    std::uint32_t interval;
    Timestep time;  // Of arrival.
    LabelIndex parent;
    VertexId state;
  };
  struct Query {
    const AgentDistances& distances;
    const ObstacleMap& obstacles;
    Timestep max_cost;
    std::span<Timestep> first_hits;
  };

  void start_search(const AgentDistances& distances);
  /// Of a state, in order of time; made when they are asked for first.
  Head intervals_of(const Query& query, VertexId state);
  void add(const Query& query, VertexId state, std::uint32_t interval, Timestep time,
           LabelIndex parent);
  void expand(const Query& query, LabelIndex from);
  void reach(const Query& query, LabelIndex from, VertexId to);
  static void hit(const Query& query, std::uint32_t slot, VertexId state, Timestep t);
  /// Whether the agent may end there once it has come to that interval.
  [[nodiscard]] bool is_end(const Query& query, const Label& label) const;

  LimitMonitor* limits_;
  std::int64_t effort_ = 0;
  std::uint32_t stamp_ = 0;
  IdVector<VertexId, Head> heads_;
  std::vector<Interval> intervals_;
  std::vector<Label> labels_;
  std::vector<std::vector<LabelIndex>> open_;  // By slack.
  std::vector<std::pair<Timestep, Timestep>> visits_;
};

}  // namespace quadrille::discrete
