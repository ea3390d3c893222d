// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <utility>

#include "quadrille/core/member.hpp"
#include "quadrille/discrete/instance.hpp"
#include "quadrille/discrete/plan.hpp"
#include "quadrille/discrete/solver.hpp"
#include "quadrille/solve/answers.hpp"

namespace quadrille::discrete {

/// Where an agent is some timesteps after the beginning of its path, and what is left of it.
struct Later {
  VertexId at;
  bool ends = false;  ///< There it stays.
  Path rest;          ///< From `at` on.

  /// Whether the rest of one path is one of the other one, too.
  [[nodiscard]] bool is_where(const Later& other) const { return at == other.at; }
};

/// Requires a path that is not empty, and `time` >= 0.
[[nodiscard]] Later later(const Path& path, Timestep time);

/// What the agent still has to do after so many timesteps of the path: visits to waypoints count
/// from the beginning of the path on.
[[nodiscard]] Agent rest_of(const Agent& agent, const Path& path, Timestep time);

/// What solve::AnswerCache asks for.
struct AnswerDomain {
  using Task = Agent;
  /// A vertex, or the ends of an edge, the smaller one first.
  using Closed = std::pair<VertexId, std::optional<VertexId>>;
  using Time = Timestep;
  using Instance = discrete::Instance;
  using Path = discrete::Path;
  using Plan = discrete::Plan;
  using Outcome = SolveOutcome;
  using Later = discrete::Later;

  [[nodiscard]] static Later later(const Path& path, Timestep time) {
    return discrete::later(path, time);
  }
  [[nodiscard]] static bool adopt(const Path& path, const Instance& instance, AgentId agent);
  [[nodiscard]] static Cost as_cost(Timestep time) { return time; }
};
using Situation = solve::Situation<AnswerDomain>;
using History = solve::History<AnswerDomain>;
using BoundCache = solve::AnswerCache<AnswerDomain>;

}  // namespace quadrille::discrete
