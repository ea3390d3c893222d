// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "paths/obstacles.hpp"
#include "quadrille/discrete/instance.hpp"

namespace quadrille::discrete {

/// Where two current paths collide.
struct Encounter {
  enum class Kind {
    vertex,  ///< Both are in `vertex` at `timestep`.
    swap,    ///< `first` moves from `vertex` to `to` at `timestep`, `second` moves back.
    rest,  ///< `first` rests in `vertex`, its goal, since `timestep` or before; `second` is there.
  };
  Kind kind = Kind::vertex;
  AgentId first, second;
  VertexId vertex, to;
  Timestep timestep = 0;
  friend bool operator==(const Encounter&, const Encounter&) = default;
};

/// One current path per agent, indexed by place. Replacing a path costs time in the path's length
/// (and in the stays at its vertices), and so does counting its collisions.
class PathIndex {
 public:
  /// `instance` outlives the index. All paths are empty at first; an agent without a path is
  /// nowhere.
  explicit PathIndex(const Instance& instance);

  /// `path` begins at the agent's start and ends with its arrival at its goal.
  void replace(AgentId agent, const Path& path);
  [[nodiscard]] const Path& path(AgentId agent) const { return paths_[agent]; }
  /// Requires a path.
  [[nodiscard]] Timestep cost(AgentId agent) const {
    return static_cast<Timestep>(paths_[agent].size()) - 1;
  }

  /// With how many other agents `agent` would collide by moving (or waiting) from `from` to `to`
  /// so that it arrives at `t`.
  [[nodiscard]] int collisions_of_step(AgentId agent, VertexId from, VertexId to,
                                       Timestep t) const {
    int count = 0;
    const std::int32_t resident = resident_[to];
    if (resident >= 0 && AgentId(static_cast<std::size_t>(resident)) != agent &&
        rests_since(AgentId(static_cast<std::size_t>(resident))) < t)
      ++count;
    for (const Stay& stay : stays_[to]) {
      if (!stay.is_near(t) || stay.agent == agent) continue;
      if (stay.end >= t) {
        ++count;
      } else if (from != to) {
        const Path& other = paths_[stay.agent];
        if (static_cast<Timestep>(other.size()) > t && other[static_cast<std::size_t>(t)] == from)
          ++count;
      }
    }
    return count;
  }
  /// How many times others pass the agent's goal after `arrival`.
  [[nodiscard]] int collisions_of_rest(AgentId agent, Timestep arrival) const;
  /// How many collisions the agent's path has.
  [[nodiscard]] int num_collisions(AgentId agent) const;
  /// How many collisions another path of the agent would have, which begins at its start and ends
  /// with its arrival at its goal.
  [[nodiscard]] int num_collisions(AgentId agent, const Path& path) const;
  /// All collisions among current paths; each pair's are in the order of time.
  [[nodiscard]] const std::vector<Encounter>& collisions();

 private:
  /// From `begin` to `end`, both included; without the rest at the goal.
  struct Stay {
    Timestep begin, end;
    AgentId agent;
    // One comparison each, which the processor can foresee because it fails nearly always: with one
    // for each end, searches take 1.12 times as long, all in all.
    [[nodiscard]] bool contains(Timestep t) const noexcept {
      return static_cast<std::uint32_t>(t - begin) <= static_cast<std::uint32_t>(end - begin);
    }
    /// Contains `t` or the timestep before.
    [[nodiscard]] bool is_near(Timestep t) const noexcept {
      return static_cast<std::uint32_t>(t - begin) <= static_cast<std::uint32_t>(end - begin) + 1;
    }
  };
  [[nodiscard]] Timestep rests_since(AgentId agent) const {
    return paths_[agent].empty() ? kForever : cost(agent);
  }
  /// The stay of `path` that begins at `t`.
  static Stay stay_at(AgentId agent, const Path& path, std::size_t t);
  void collect(AgentId agent, std::vector<Encounter>& out) const;
  void collect_rest(AgentId agent, std::vector<Encounter>& out) const;

  const Instance& instance_;
  IdVector<AgentId, Path> paths_;
  IdVector<VertexId, std::vector<Stay>> stays_;
  IdVector<VertexId, std::int32_t> resident_;  // whose goal it is, -1: nobody's
  std::vector<Encounter> collisions_;
  std::vector<AgentId> changed_;  // paths replaced since collisions_ was right
  IdVector<AgentId, char> is_changed_;
  mutable std::vector<Encounter> scratch_;
};

}  // namespace quadrille::discrete
