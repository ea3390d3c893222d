// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "traffic/square_grid.hpp"
#include "traffic/steps.hpp"

namespace quadrille::continuous {

/// The paths of all agents by the squares that they come through, and the first collision of each
/// two of them. A path that is replaced is compared with those that come near it, at about the same
/// time; memory is that of the paths and of the collisions.
class Meetings {
 public:
  /// `scene` outlives the object. At first nobody is anywhere.
  explicit Meetings(Scene& scene);

  /// Replaces the agent's path. `version` tells it from others; the same one again: nothing
  /// changes. `steps` stay where they are until the path is replaced.
  void put(AgentId agent, const std::vector<Step>& steps, std::uint64_t version);
  /// The first encounter of each two agents that collide, in the order of the agents.
  [[nodiscard]] std::vector<Encounter> encounters();

  /// Of two agents' paths, so far.
  [[nodiscard]] std::int64_t num_comparisons() const noexcept { return num_comparisons_; }

 private:
  /// An agent is somewhere in a square for some of this time, if ever.
  struct Passage {
    AgentId agent;
    Ticks begin = 0, end = 0;
  };
  struct Entry {
    const std::vector<Step>* steps = nullptr;
    std::uint64_t version = 0;
    std::vector<std::size_t> squares;  // each once
    bool is_changed = false;           // since encounters() was asked last
    std::uint32_t seen = 0;            // in which query
  };
  void take_out(AgentId agent);
  void compare(AgentId agent);

  Scene& scene_;
  SquareGrid grid_;
  std::vector<std::vector<Passage>> squares_;
  IdVector<AgentId, Entry> entries_;
  std::vector<AgentId> changed_;
  std::map<std::pair<AgentId, AgentId>, Encounter> found_;
  IdVector<AgentId, std::set<AgentId>> met_;
  std::uint32_t query_ = 0;
  std::int64_t num_comparisons_ = 0;
};

}  // namespace quadrille::continuous
