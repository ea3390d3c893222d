// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "quadrille/continuous/instance.hpp"
#include "quadrille/continuous/plan.hpp"
#include "quadrille/core/export.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::continuous {

/// One broken rule of a plan.
struct Violation {
  enum class Kind {
    path_count,    ///< Not one path per agent.
    empty_path,    ///< A path without stops.
    bad_vertex,    ///< A vertex that the roadmap does not have.
    bad_time,      ///< Not from `now` on, later than supported, or a departure before arrival.
    wrong_start,   ///< The path begins elsewhere.
    wrong_goal,    ///< The path ends elsewhere.
    not_adjacent,  ///< A move along no edge.
    too_early,     ///< A move that begins before the agent's release.
    too_late,      ///< An arrival after the agent's deadline.
    closed_edge,   ///< A move along an edge that is not open to the agent's group.
    waits,         ///< An agent that is under way at `now` and stops there.
    duration,      ///< A move that takes longer or shorter than its edge does.
    collision,     ///< The interiors of two agents' bodies meet.
    obstacle,      ///< Those of an agent and of a moving obstacle meet.
    whole_moves,   ///< Two moves at one time that may not (Instance::has_whole_moves).
  };
  Kind kind;
  AgentId agent;
  std::optional<AgentId> other;  ///< Of two agents; larger than `agent`.
  /// When the step begins in which it happens; of a collision the last tick before bodies overlap.
  Ticks tick = 0;
  std::string message;  ///< One sentence that names agents, place and time as the input counts.
  /// Of collisions of two agents: a moment, in ticks, at which the bodies are nearest.
  std::optional<double> nearest = std::nullopt;
};

[[nodiscard]] std::string_view to_string(
    Violation::Kind kind) noexcept;  ///< "path-count" | ... | "whole-moves"
/// The free space between two agents over all time.
struct Clearance {
  AgentId agent;
  AgentId other;
  double gap = 0;   ///< Length units; distance of the centres minus radii, rounded to double.
  double tick = 0;  ///< A moment at which it is that small.
};

struct VerifyReport {
  /// All broken rules of the paths first, then all collisions by tick: what goes on
  /// from one move to the next is one.
  std::vector<Violation> violations;
  /// The least ones of all pairs of agents with sound paths that take some time and are there at
  /// the same time: as many as were asked for, least first, then by agent, then other. For the
  /// reader's information: collisions are decided in exact arithmetic.
  std::vector<Clearance> clearances;
  /// Meaningful when there are no violations. From the instance's `now`.
  Cost sum_of_costs = 0, makespan = 0;
  [[nodiscard]] bool valid() const noexcept { return violations.empty(); }
};

inline constexpr std::size_t kAllClearances = std::numeric_limits<std::size_t>::max();

/// Replays a plan from `now` on over all time, goal stays included. Shares no code with the search
/// or with geometry/: a plan that passes is a plan. Takes any plan, however broken. Where few are
/// near each other at a time, time is proportional to moves times the logarithm of the number of
/// agents. `kAllClearances` takes time and memory for each pair of agents.
[[nodiscard]] VerifyReport verify(const Instance& instance, const Plan& plan,
                                  std::size_t num_clearances = 1);

}  // namespace quadrille::continuous

QUADRILLE_API_END
