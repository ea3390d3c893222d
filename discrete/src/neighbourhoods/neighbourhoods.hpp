// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "neighbourhoods/gathering.hpp"
#include "quadrille/core/random.hpp"
#include "quadrille/discrete/goal_distances.hpp"
#include "quadrille/discrete/instance.hpp"
#include "quadrille/discrete/plan.hpp"
#include "reservations/reservations.hpp"

namespace quadrille::discrete {

/// Chooses the agents that get new paths together.
class Neighbourhoods {
 public:
  enum class Rule {
    delayed,  ///< A delayed agent, and those in its way when it tries to be faster.
    place,    ///< Agents that pass a part of the map at about the same time.
    any,      ///< Any agents.
  };

  /// All outlive this object. `paths` are trimmed and are those in `reservations` whenever `choose`
  /// is called.
  Neighbourhoods(const Instance& instance, const GoalDistances& distances,
                 const IdVector<AgentId, Path>& paths, const Reservations& reservations,
                 Random& random);

  /// At most `size` agents, at least one. `seed` is in it for Rule::delayed. Requires agents.
  std::vector<AgentId> choose(Rule rule, std::size_t size, AgentId seed);

 private:
  void walk(AgentId agent, std::size_t size);
  void fill_up(std::size_t size);

  const Instance& instance_;
  const GoalDistances& distances_;
  const IdVector<AgentId, Path>& paths_;
  const Reservations& reservations_;
  Random& random_;
  Gathering chosen_;
};

}  // namespace quadrille::discrete
