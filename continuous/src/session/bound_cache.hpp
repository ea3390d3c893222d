// SPDX-License-Identifier: MIT
#pragma once

#include <list>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "quadrille/continuous/session.hpp"
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

/// A session at one time.
struct Situation {
  std::map<MemberId, Task> tasks;  ///< In the order of the instance's agents.
  std::set<EdgeId> closed;
  Ticks begin = 0;  ///< Instance::now. What is learned counts from here.
};

/// What the members have done between two situations of the same roads: plans of the later one are
/// what is left of plans of the earlier one that begin with this.
struct History {
  Situation before, after;
  std::map<MemberId, Later> members;  ///< Of `before`.
};

/// The last answers of a session, and what they say about another situation on the same roadmap.
/// Why that is true: docs/soundness/sessions.md.
class BoundCache {
 public:
  /// The answer for a situation.
  void add(const Situation& situation, Objective objective, const SolveOutcome& outcome);

  /// Time has gone on. Of members whose task is not that of `before` nothing is known any more.
  void advance(const History& history);

  /// Bounds of groups of agents of `now`, at most one of each answer.
  [[nodiscard]] std::vector<GroupBound> bounds(const Situation& now, Objective objective) const;
  /// Paths of answers, of which `instance`, that of `now`, allows all, most first; at most two.
  [[nodiscard]] std::vector<IdVector<AgentId, Path>> drafts(const Situation& now,
                                                            const Instance& instance) const;

 private:
  struct Answer {
    Situation situation;
    std::vector<MemberId> members;  // by agent
    Objective objective = Objective::sum_of_costs;
    std::optional<Attribution> proved;
    std::optional<Plan> plan;
    /// Since then. Tasks are those of now, except of members that are `lost`.
    Ticks elapsed = 0;
    std::set<MemberId> lost = {};
    /// Have arrived since then: what they cost has come to an end, which bounds know nothing of.
    std::set<MemberId> arrived = {};
  };
  /// Whether the member has the task of then, or what is left of it.
  [[nodiscard]] static bool is_same(const Answer& answer, MemberId member, const Task& now);
  [[nodiscard]] static std::optional<GroupBound> bound_of(const Answer& answer,
                                                          const Situation& now);
  [[nodiscard]] static IdVector<AgentId, Path> paths_of(const Answer& answer, const Situation& now,
                                                        const Instance& instance);

  std::list<Answer> answers_;  // the last one first
};

}  // namespace quadrille::continuous
