// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <list>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "quadrille/core/attribution.hpp"
#include "quadrille/core/export.hpp"
#include "quadrille/core/ids.hpp"
#include "quadrille/core/member.hpp"
#include "quadrille/core/outcome.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::solve {

/// Proved: these agents alone, as if there were no others, cost at least `cost` together (makespan:
/// one of them).
struct GroupBound {
  std::vector<AgentId> agents;  ///< Increasing.
  Cost cost = 0;
};

/// What all cost at least by such bounds and by what each agent costs alone, `free_costs`. Bounds
/// of groups that have nobody in common are added up (makespan: the largest counts): first those
/// that exceed the free costs of their agents most.
[[nodiscard]] Cost bound_of_all(std::vector<GroupBound> groups,
                                const IdVector<AgentId, Cost>& free_costs, Objective objective);

/// What an attribution says of those of its agents that have the same task `elapsed` later, by
/// agent then: a bound for each group that its raises connect; for the makespan the last one.
void add_bounds(const Attribution& proved, const IdVector<AgentId, std::optional<AgentId>>& same,
                Cost elapsed, std::vector<GroupBound>& bounds);

/// A session at one time. `Domain`: see AnswerCache.
template <class Domain>
struct Situation {
  std::map<MemberId, typename Domain::Task> tasks;  ///< In the order of the instance's agents.
  std::set<typename Domain::Closed> closed;
  typename Domain::Time begin{};  ///< Instance::now. What is learned counts from here.

  [[nodiscard]] std::vector<MemberId> members() const {
    std::vector<MemberId> members;
    for (const auto& [member, task] : tasks) members.push_back(member);
    return members;
  }
};

/// What the members have done between two situations of the same roads: plans of the later one are
/// what is left of plans of the earlier one that begin with this.
template <class Domain>
struct History {
  Situation<Domain> before, after;
  std::map<MemberId, typename Domain::Later> members;  ///< Of `before`.
};

/// Time goes on until `now`, and everybody follows its path of the plan, on which it is then where
/// Domain::later says for `at`. `rest_of(task, later, agent)` is what somebody still has to do;
/// nullopt: it has left. Requires a plan of the situation, with agents in the order of the members.
template <class Domain, class RestOf>
[[nodiscard]] History<Domain> follow(const Situation<Domain>& before,
                                     const typename Domain::Plan& plan, typename Domain::Time now,
                                     typename Domain::Time at, const RestOf& rest_of) {
  History<Domain> history{before, before, {}};
  history.after.begin = now;
  std::size_t index = 0;
  for (const auto& [member, task] : before.tasks) {
    const AgentId i(index++);
    auto done = Domain::later(plan.paths[i], at);
    if (auto rest = rest_of(task, done, i))
      history.after.tasks.at(member) = *std::move(rest);
    else
      history.after.tasks.erase(member);
    history.members.emplace(member, std::move(done));
  }
  return history;
}

/// The last answers of a session, and what they say about another situation on the same roads. Why
/// that is true: docs/soundness/sessions.md. `Domain` knows, all static:
///
///     Task, Closed, Time          what a member has to do, what may be closed, and when
///     Instance, Path, Plan, Outcome
///     Later                       where a member is on its path, and what is left of it: `ends`,
///                                 `rest`, and `is_where(other)`
///     later(path, time)           for a time that counts from the path's beginning
///     adopt(path, instance, i)    puts the path on the agent's start; whether all that it uses is
///                                 open
///     as_cost(time)
template <class Domain>
class AnswerCache {
 public:
  using Situation = solve::Situation<Domain>;
  using History = solve::History<Domain>;
  using Instance = typename Domain::Instance;
  using Path = typename Domain::Path;
  using Paths = IdVector<AgentId, Path>;
  using Time = typename Domain::Time;

  /// The answer for a situation.
  void add(const Situation& situation, Objective objective,
           const typename Domain::Outcome& outcome);
  /// Time has gone on. Of members whose task is not that of `before` nothing is known any more.
  void advance(const History& history);
  void clear() { answers_.clear(); }

  /// Bounds of groups of agents of `now`.
  [[nodiscard]] std::vector<GroupBound> bounds(const Situation& now, Objective objective) const;
  /// Paths of answers, of which `instance`, that of `now`, allows all, most first; at most two.
  [[nodiscard]] std::vector<Paths> drafts(const Situation& now, const Instance& instance) const;

 private:
  static constexpr std::size_t kMaxAnswers = 16, kMaxDrafts = 2;

  struct Answer {
    Situation situation;
    std::vector<MemberId> members;  // by agent
    Objective objective = Objective::sum_of_costs;
    std::optional<Attribution> proved;
    std::optional<typename Domain::Plan> plan;
    /// Since then. Tasks are those of now, except of members that are `lost`.
    Time elapsed{};
    std::set<MemberId> lost = {};
    /// Have arrived since then: what they cost has come to an end, which bounds know nothing of.
    /// Those that leave them out may be better ones.
    std::set<MemberId> arrived = {};
  };
  /// That all agents together cost at least the bound.
  [[nodiscard]] static Attribution undivided(std::size_t num_agents, Objective objective,
                                             Cost bound);
  [[nodiscard]] static std::size_t num_paths(const Paths& paths) {
    return static_cast<std::size_t>(
        std::count_if(paths.begin(), paths.end(), [](const Path& path) { return !path.empty(); }));
  }
  /// Whether the member has the task of then, or what is left of it.
  [[nodiscard]] static bool is_same(const Answer& answer, MemberId member,
                                    const typename Domain::Task& now);
  /// Who of an answer's agents has the same task now, by agent then.
  using Same = IdVector<AgentId, std::optional<AgentId>>;
  [[nodiscard]] static Same same_of(const Answer& answer, const Situation& now);
  static void add_bounds_of(const Answer& answer, const Situation& now,
                            std::vector<GroupBound>& bounds);
  [[nodiscard]] static Paths paths_of(const Answer& answer, const Situation& now,
                                      const Instance& instance);

  std::list<Answer> answers_;  // the last one first
};

template <class Domain>
Attribution AnswerCache<Domain>::undivided(std::size_t num_agents, Objective objective,
                                           Cost bound) {
  Attribution all;
  all.objective = objective;
  all.agents = IdVector<AgentId, AgentCharge>(num_agents);
  all.lower_bound = bound;
  Raise raise{RaiseKind::total, bound, {}, {}};
  for (const AgentId i : IdRange<AgentId>(num_agents)) raise.agents.push_back(i);
  all.raises.push_back(std::move(raise));
  return all;
}

template <class Domain>
void AnswerCache<Domain>::add(const Situation& situation, Objective objective,
                              const typename Domain::Outcome& outcome) {
  if (outcome.internal_error || outcome.status == Status::infeasible) return;
  Answer answer{situation, situation.members(), objective, {}, outcome.plan, Time{}};
  // A bound that the user knows is no proof.
  if (!outcome.rests_on_known_bound) {
    answer.proved = outcome.attribution;
    if (!answer.proved && !answer.members.empty())
      answer.proved = undivided(answer.members.size(), objective, outcome.lower_bound);
  }
  answers_.push_front(std::move(answer));
  if (answers_.size() > kMaxAnswers) answers_.pop_back();
}

template <class Domain>
void AnswerCache<Domain>::advance(const History& history) {
  const Situation& before = history.before;
  // What was done on a road that was closed then is no beginning of a plan of then.
  std::erase_if(answers_, [&](const Answer& answer) {
    const auto& closed = answer.situation.closed;
    return !std::includes(before.closed.begin(), before.closed.end(), closed.begin(), closed.end());
  });
  const Time time = history.after.begin - before.begin;
  for (Answer& answer : answers_) {
    answer.elapsed += time;
    for (std::size_t index = 0; index < answer.members.size(); ++index) {
      const MemberId member = answer.members[index];
      Path* const path = answer.plan ? &answer.plan->paths[AgentId(index)] : nullptr;
      const auto now = before.tasks.find(member), then = history.after.tasks.find(member);
      if (now == before.tasks.end() || then == history.after.tasks.end() ||
          !is_same(answer, member, now->second)) {
        answer.lost.insert(member);
        continue;
      }
      answer.situation.tasks.at(member) = then->second;
      const typename Domain::Later& done = history.members.at(member);
      if (done.ends) answer.arrived.insert(member);
      if (path == nullptr || path->empty()) continue;
      auto planned = Domain::later(*path, time);
      *path = planned.is_where(done) ? std::move(planned.rest) : Path();
    }
  }
}

template <class Domain>
bool AnswerCache<Domain>::is_same(const Answer& answer, MemberId member,
                                  const typename Domain::Task& now) {
  const auto then = answer.situation.tasks.find(member);
  return then != answer.situation.tasks.end() && then->second == now &&
         !answer.lost.contains(member);
}

template <class Domain>
std::vector<GroupBound> AnswerCache<Domain>::bounds(const Situation& now,
                                                    Objective objective) const {
  std::vector<GroupBound> bounds;
  for (const Answer& answer : answers_)
    if (answer.objective == objective && answer.proved) add_bounds_of(answer, now, bounds);
  return bounds;
}

template <class Domain>
typename AnswerCache<Domain>::Same AnswerCache<Domain>::same_of(const Answer& answer,
                                                                const Situation& now) {
  Same same(answer.members.size());
  std::size_t index = 0;
  for (const auto& [member, task] : now.tasks) {
    const AgentId i(index++);
    if (!is_same(answer, member, task)) continue;
    const auto then = answer.situation.tasks.find(member);
    same[AgentId(static_cast<std::size_t>(std::distance(answer.situation.tasks.begin(), then)))] =
        i;
  }
  return same;
}

template <class Domain>
void AnswerCache<Domain>::add_bounds_of(const Answer& answer, const Situation& now,
                                        std::vector<GroupBound>& bounds) {
  const auto& closed = answer.situation.closed;
  // With an edge that was closed then there may be cheaper plans.
  if (!std::includes(now.closed.begin(), now.closed.end(), closed.begin(), closed.end())) return;
  const Same same = same_of(answer, now);
  Same on_their_way = same;
  for (std::size_t i = 0; i < answer.members.size(); ++i)
    if (answer.arrived.contains(answer.members[i])) on_their_way[AgentId(i)].reset();
  const std::int64_t elapsed = Domain::as_cost(answer.elapsed);
  add_bounds(*answer.proved, same, elapsed, bounds);
  if (on_their_way != same) add_bounds(*answer.proved, on_their_way, elapsed, bounds);
}

template <class Domain>
std::vector<typename AnswerCache<Domain>::Paths> AnswerCache<Domain>::drafts(
    const Situation& now, const Instance& instance) const {
  std::vector<Paths> drafts;
  for (const Answer& answer : answers_)
    if (answer.plan) drafts.push_back(paths_of(answer, now, instance));
  std::erase_if(drafts, [](const auto& paths) { return num_paths(paths) == 0; });
  std::stable_sort(drafts.begin(), drafts.end(),
                   [](const auto& a, const auto& b) { return num_paths(a) > num_paths(b); });
  if (drafts.size() > kMaxDrafts) drafts.resize(kMaxDrafts);
  return drafts;
}

template <class Domain>
typename AnswerCache<Domain>::Paths AnswerCache<Domain>::paths_of(const Answer& answer,
                                                                  const Situation& now,
                                                                  const Instance& instance) {
  Paths paths(instance.num_agents());
  std::size_t index = 0;
  for (const auto& [member, task] : now.tasks) {
    const AgentId i(index++);
    const auto then = answer.situation.tasks.find(member);
    if (!is_same(answer, member, task)) continue;
    const AgentId then_i(
        static_cast<std::size_t>(std::distance(answer.situation.tasks.begin(), then)));
    Path path = answer.plan->paths[then_i];
    if (!path.empty() && Domain::adopt(path, instance, i)) paths[i] = std::move(path);
  }
  return paths;
}

}  // namespace quadrille::solve

QUADRILLE_API_END
