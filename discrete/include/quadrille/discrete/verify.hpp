// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "quadrille/discrete/instance.hpp"
#include "quadrille/discrete/plan.hpp"

namespace quadrille::discrete {

/// One broken rule of a plan.
struct Violation {
  enum class Kind {
    path_count,    ///< Not one path per agent.
    empty_path,    ///< A path without vertices.
    bad_vertex,    ///< A vertex that the graph does not have.
    wrong_start,   ///< The path begins elsewhere.
    wrong_goal,    ///< The path ends elsewhere.
    not_adjacent,  ///< A move between `timestep` and the next one that is no edge.
    vertex,        ///< Two agents in one vertex at `timestep`, goal stays included.
    swap,          ///< Two agents cross an edge in opposite directions from `timestep` on.
  };
  Kind kind;
  AgentId agent;
  std::optional<AgentId> other;  ///< For vertex and swap; larger than `agent`.
  VertexId vertex;               ///< Of `agent`, at `timestep`.
  Timestep timestep = 0;
  std::string message;  ///< One sentence that names agents, place and timestep.
};

struct VerifyReport {
  std::vector<Violation> violations;  ///< In order of timestep, then agent; all of them.
  Cost sum_of_costs = 0;              ///< Meaningful when there are no violations.
  Cost makespan = 0;
  [[nodiscard]] bool valid() const noexcept { return violations.empty(); }
};

/// Replays a plan. Shares no code with any search: a plan that passes is a plan.
/// O(agents * makespan) expected time.
[[nodiscard]] VerifyReport verify(const Instance& instance, const Plan& plan);

}  // namespace quadrille::discrete
