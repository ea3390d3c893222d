// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "quadrille/core/export.hpp"
#include "quadrille/discrete/instance.hpp"
#include "quadrille/discrete/plan.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::discrete {

/// One broken rule of a plan.
struct Violation {
  enum class Kind {
    path_count,    ///< Not one path per agent.
    bad_time,      ///< The plan does not begin when the instance does.
    empty_path,    ///< A path without vertices.
    bad_vertex,    ///< A vertex that the graph does not have.
    wrong_start,   ///< The path begins elsewhere.
    wrong_goal,    ///< The path ends elsewhere than at a goal of the agent.
    not_adjacent,  ///< A move between `timestep` and the next one that is no edge.
    turn,          ///< A move that begins before the agent can have turned to face that way.
    too_early,     ///< A move that begins before the agent's release.
    too_late,      ///< An arrival after the agent's deadline.
    waypoint,      ///< One is not visited, or not after the one before it.
    obstacle,      ///< A vertex or an edge is used while it is blocked.
    vertex,        ///< Two agents in one vertex at `timestep`, goal stays included.
    too_close,     ///< An agent in a vertex in which another one was too few timesteps before.
    swap,          ///< Two agents cross an edge in opposite directions from `timestep` on.
  };
  Kind kind;
  AgentId agent;
  std::optional<AgentId> other;  ///< For vertex, too_close and swap; larger than `agent`.
  VertexId vertex;               ///< Of `agent`, at `timestep`; too_close: where both were.
  Timestep timestep = 0;         ///< Absolute, as the instance counts.
  std::string message;           ///< One sentence that names agents, place and timestep.
};

[[nodiscard]] std::string_view to_string(
    Violation::Kind kind) noexcept;  ///< "path-count" | ... | "vertex-conflict" | ...
struct VerifyReport {
  /// In order of timestep, then agent. Every agent that breaks a rule is named at every timestep at
  /// which its path does so; in a crowd, with one of the others instead of with each of them.
  /// Agents that already stay at the end of their paths are named only with agents that arrive. An
  /// agent that leaves is gone after its arrival; how often its path repeats its end means nothing.
  std::vector<Violation> violations;
  /// Meaningful when there are no violations. From the instance's `now`.
  Cost sum_of_costs = 0, makespan = 0;
  [[nodiscard]] bool valid() const noexcept { return violations.empty(); }
};

/// Replays a plan. Shares no code with any search: a plan that passes is a plan.
/// Takes any plan, however broken. Expected time, and the number of violations, are linear in the
/// size of the plan and the graph, and in the size of the plan for each blockage.
[[nodiscard]] VerifyReport verify(const Instance& instance, const Plan& plan);

}  // namespace quadrille::discrete

QUADRILLE_API_END
