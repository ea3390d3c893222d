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
    /// `first` rests in `vertex`, one of its goals, since `timestep` or before; `second` is there,
    /// and perhaps rests there as well from then on.
    rest,
  };
  Kind kind = Kind::vertex;
  AgentId first, second;
  VertexId vertex, to;
  Timestep timestep = 0;  ///< Of `first`.
  /// `second` is there that much later, or before: where rules keep agents apart in time, too.
  Timestep gap = 0;
  [[nodiscard]] Timestep second_timestep() const noexcept { return timestep + gap; }
  friend bool operator==(const Encounter&, const Encounter&) = default;
};

/// One current path per agent, indexed by place. Replacing a path costs time in the path's length
/// (and in the stays at its vertices), and so does counting its collisions.
class PathIndex {
 public:
  /// `instance` outlives the index. All paths are empty at first; an agent without a path is
  /// nowhere.
  explicit PathIndex(const Instance& instance);

  /// `path` begins at the agent's start and ends with its arrival at one of its goals, where it
  /// rests, or leaves.
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
    if (robust_ > 0) return encounters_at(agent, to, t);
    int count = 0;
    for (std::int32_t at = resident_[to]; at >= 0;) {
      const AgentId resident(static_cast<std::size_t>(at));
      if (resident != agent && cost(resident) < t) ++count;
      at = next_resident_[resident];
    }
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
  /// How many times others pass that goal after the agent's `arrival` there.
  [[nodiscard]] int collisions_of_rest(AgentId agent, VertexId goal, Timestep arrival) const;
  /// How many collisions the agent's path has, as the two functions above count them: without those
  /// of its start at timestep 0, which all its paths have.
  [[nodiscard]] int num_collisions(AgentId agent) const;
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
  /// The stay of `path` that begins at `t`.
  static Stay stay_at(AgentId agent, const Path& path, std::size_t t);
  void remove_resident(AgentId agent);
  void add_resident(AgentId agent);
  void collect(AgentId agent, std::vector<Encounter>& out) const;
  void collect_rest(AgentId agent, std::vector<Encounter>& out) const;
  [[nodiscard]] bool leaves(AgentId agent) const { return instance_.agents()[agent].leaves; }

  // The same where nobody may be in a vertex within some timesteps after another. Counted are pairs
  // of timesteps, which both agents count alike.
  [[nodiscard]] int encounters_at(AgentId agent, VertexId v, Timestep t) const;
  [[nodiscard]] int encounters_of_rest(AgentId agent, VertexId goal, Timestep arrival) const;
  void collect_robust(AgentId agent, std::vector<Encounter>& out) const;

  const Instance& instance_;
  const Timestep robust_;
  IdVector<AgentId, Path> paths_;
  IdVector<VertexId, std::vector<Stay>> stays_;
  // Those whose paths end there, to rest, as a list: an agent, -1 at the end. Of goals that no two
  // agents have in common there is one at most.
  IdVector<VertexId, std::int32_t> resident_;
  IdVector<AgentId, std::int32_t> next_resident_;
  std::vector<Encounter> collisions_;
  std::vector<AgentId> changed_;  // paths replaced since collisions_ was right
  IdVector<AgentId, char> is_changed_;
  mutable std::vector<Encounter> scratch_;
};

}  // namespace quadrille::discrete
