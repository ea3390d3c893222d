// SPDX-License-Identifier: MIT
#pragma once

#include "quadrille/continuous/session.hpp"
#include "quadrille/solve/answers.hpp"
#include "session/history.hpp"
#include "solve/warm_start.hpp"

namespace quadrille::continuous {

/// The middle of a move.
struct UnderWay {
  EdgeId edge;
  Ticks behind = 0;
  friend bool operator==(const UnderWay&, const UnderWay&) = default;
};

/// What a member of a session has to do.
struct Task {
  Agent agent;  ///< The start of one that is under way is the tail of its edge.
  std::optional<UnderWay> under_way = {};
  friend bool operator==(const Task&, const Task&) = default;
};

/// What solve::AnswerCache asks for.
struct AnswerDomain {
  using Task = continuous::Task;
  using Closed = EdgeId;
  using Time = Ticks;
  using Instance = continuous::Instance;
  using Path = continuous::Path;
  using Plan = continuous::Plan;
  using Outcome = SolveOutcome;
  using Later = continuous::Later;

  [[nodiscard]] static Later later(const Path& path, Ticks time) {
    return continuous::later(path, time);
  }
  [[nodiscard]] static bool adopt(Path& path, const Instance& instance, AgentId agent);
  [[nodiscard]] static Cost as_cost(Ticks time) { return continuous::as_cost(time); }
};
using Situation = solve::Situation<AnswerDomain>;
using History = solve::History<AnswerDomain>;
using BoundCache = solve::AnswerCache<AnswerDomain>;

}  // namespace quadrille::continuous
