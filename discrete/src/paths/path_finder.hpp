// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "paths/agent_distances.hpp"
#include "paths/obstacle_map.hpp"
#include "paths/path_index.hpp"
#include "paths/safe_interval_search.hpp"
#include "quadrille/core/limits.hpp"

namespace quadrille::discrete {

/// Searches for paths of one agent around its obstacles, over the agent's states and slack: a wait
/// adds 1 to the slack, a move 0, 1 or 2, or more where edges lead one way. Memory follows the
/// number of the agent's states and of those expanded by one search, not the horizon.
class PathFinder {
 public:
  /// Searches throw LimitReached when `limits` are met; null: there are none.
  explicit PathFinder(std::size_t num_vertices, LimitMonitor* limits = nullptr)
      : limits_(limits), heads_(num_vertices), safe_intervals_(num_vertices, limits) {}

  struct Query {
    AgentId agent;
    const AgentDistances& distances;
    const ObstacleMap& obstacles;  ///< Loaded for the agent.
    Timestep max_cost = 0;
    const PathIndex* others = nullptr;    ///< Whose collisions to avoid; null: nobody's.
    std::int64_t max_effort = INT64_MAX;  ///< Of find_quietest: states to expand before giving up.
  };

  /// Finds a cheapest path of at most `max_cost`, among these one with few collisions. False if
  /// there is none. Afterwards `first_hits` tells which obstacles were in the way. Where others
  /// pass the goal late, and where the search takes long, it gives up looking at collisions, see
  /// SafeIntervalSearch: its effort follows the vertices and not the slack.
  [[nodiscard]] bool find_cheapest(const Query& query, Path& path);
  /// By slot: the smallest slack at which an obstacle blocked a step of the last `find_cheapest`,
  /// kNoHit if it did not. Complete for all slacks below that of the path found, or up to the limit
  /// if none was; but when the path costs as little as the goals allow, it may be empty of
  /// hits, since the obstacles in the goal alone say why there is none that is cheaper.
  [[nodiscard]] std::span<const Timestep> first_hits() const noexcept { return first_hits_; }
  static constexpr Timestep kNoHit = INT32_MAX;

  /// Finds a path of at most `max_cost` with the fewest collisions, if they are less than `below`.
  /// Requires `others`.
  [[nodiscard]] bool find_quietest(const Query& query, int below, Path& path);

  /// States expanded so far by all searches.
  [[nodiscard]] std::int64_t effort() const noexcept { return effort_ + safe_intervals_.effort(); }

 private:
  using ClosedIndex = std::uint32_t;
  static constexpr ClosedIndex kNone = UINT32_MAX;
  struct State {
    VertexId vertex;  // a state of the agent
    ClosedIndex parent;
  };
  struct Closed {
    State state;
    Timestep slack;
    ClosedIndex earlier;  // The state of the same vertex that was closed before it.
  };
  /// The closed states of a vertex, in the search with that stamp.
  struct Head {
    std::uint32_t stamp = 0;
    Timestep largest = -1;  // slack
    ClosedIndex last = kNone;
  };
  using Buckets = std::vector<std::vector<State>>;

  enum class End { found, none, gave_up };
  /// All states by increasing slack, up to a number of them.
  End sweep(const Query& query, std::int64_t max_effort, Path& path);
  /// Looks for a path that arrives at the earliest rest and not before, ahead and in depth, as one
  /// goes to the goal and waits beside it. False if that takes long, or if there is none. Requires
  /// that goals have no prices.
  bool dive(const Query& query, Path& path);
  void start_search(const AgentDistances& distances);
  static void push(Buckets& buckets, Timestep at, State state);
  /// Whether the state was expanded. Takes time in the states of the vertex that were, none in a
  /// search that closes them by increasing slack and asks for no smaller one.
  [[nodiscard]] bool is_closed(VertexId v, Timestep slack) const;
  ClosedIndex close(State state, Timestep slack);
  /// Calls `push(vertex, slack, arrival)` for each step that is new and `hit(slot, slack)` for each
  /// obstacle that blocks one.
  template <class Hit, class Push>
  void expand(const Query& query, VertexId v, Timestep slack, const Hit& hit, const Push& push);
  /// Of a state that is not the first one.
  [[nodiscard]] Timestep slack_after(const AgentDistances& distances, State state) const;
  /// The path that ends with a closed state.
  void trace(const Query& query, ClosedIndex last, Path& path) const;

  LimitMonitor* limits_;
  std::int64_t effort_ = 0;
  std::uint32_t stamp_ = 0;
  IdVector<VertexId, Head> heads_;
  std::vector<Closed> closed_;
  std::vector<Buckets> open_;  // cheapest: by slack modulo its steps; quietest: by collisions
  std::vector<Timestep> first_hits_;
  std::vector<std::pair<Timestep, VertexId>> steps_;  // by slack, of the state expanded
  SafeIntervalSearch safe_intervals_;
};

}  // namespace quadrille::discrete
