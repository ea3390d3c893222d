// SPDX-License-Identifier: MIT
#include "session/bound_cache.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>

namespace quadrille::continuous {
namespace {

constexpr std::size_t kMaxAnswers = 16, kMaxDrafts = 2;

/// That all agents together cost at least the bound.
Attribution undivided(std::size_t num_agents, Objective objective, Cost bound) {
  Attribution all;
  all.objective = objective;
  all.agents = IdVector<AgentId, AgentCharge>(num_agents);
  all.lower_bound = bound;
  Raise raise{RaiseKind::total, bound, {}, {}};
  for (const AgentId i : IdRange<AgentId>(num_agents)) raise.agents.push_back(i);
  all.raises.push_back(std::move(raise));
  return all;
}

std::size_t num_paths(const IdVector<AgentId, Path>& paths) {
  return static_cast<std::size_t>(
      std::count_if(paths.begin(), paths.end(), [](const Path& path) { return !path.empty(); }));
}

/// Whether the agent may take the path: edges may be closed that it used.
bool is_open(const Instance& instance, AgentId agent, const Path& path) {
  const ClassId c = instance.class_of(agent);
  for (std::size_t k = 1; k < path.size(); ++k) {
    const auto out = instance.out_edges(c, path[k - 1].vertex);
    const bool fits = std::any_of(out.begin(), out.end(), [&](EdgeId e) {
      return instance.roadmap().edge(e).to == path[k].vertex &&
             instance.duration(c, e) == path[k].arrive - path[k - 1].depart;
    });
    if (!fits) return false;
  }
  return true;
}

}  // namespace

void BoundCache::add(const Situation& situation, Objective objective, const SolveOutcome& outcome) {
  if (outcome.internal_error || outcome.status == Status::infeasible) return;
  Answer answer{situation, {}, objective, {}, outcome.plan};
  for (const auto& [member, task] : situation.tasks) answer.members.push_back(member);
  // A bound that the user knows is no proof.
  if (!outcome.rests_on_known_bound) {
    answer.proved = outcome.attribution;
    if (!answer.proved && !answer.members.empty())
      answer.proved = undivided(answer.members.size(), objective, outcome.lower_bound);
  }
  answers_.push_front(std::move(answer));
  if (answers_.size() > kMaxAnswers) answers_.pop_back();
}

void BoundCache::advance(const History& history) {
  const Situation& before = history.before;
  // What was done on a road that was closed then is no beginning of a plan of then.
  std::erase_if(answers_, [&](const Answer& answer) {
    const auto& closed = answer.situation.closed;
    return !std::includes(before.closed.begin(), before.closed.end(), closed.begin(), closed.end());
  });
  const Ticks time = history.after.begin - before.begin;
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
      const Later& done = history.members.at(member);
      if (done.ends) answer.arrived.insert(member);
      if (path == nullptr || path->empty()) continue;
      Later planned = later(*path, time);
      *path = planned.is_where(done) ? std::move(planned.rest) : Path();
    }
  }
}

bool BoundCache::is_same(const Answer& answer, MemberId member, const Task& now) {
  const auto then = answer.situation.tasks.find(member);
  return then != answer.situation.tasks.end() && then->second == now &&
         !answer.lost.contains(member);
}

std::vector<GroupBound> BoundCache::bounds(const Situation& now, Objective objective) const {
  std::vector<GroupBound> bounds;
  for (const Answer& answer : answers_)
    if (answer.objective == objective && answer.proved)
      if (auto bound = bound_of(answer, now)) bounds.push_back(std::move(*bound));
  return bounds;
}

std::optional<GroupBound> BoundCache::bound_of(const Answer& answer, const Situation& now) {
  const auto& closed = answer.situation.closed;
  // With an edge that was closed then there may be cheaper plans.
  if (!std::includes(now.closed.begin(), now.closed.end(), closed.begin(), closed.end()))
    return std::nullopt;
  /// Those who have the same task now, by agent then.
  std::vector<std::optional<AgentId>> same(answer.members.size());
  std::size_t index = 0;
  for (const auto& [member, task] : now.tasks) {
    const auto then = answer.situation.tasks.find(member);
    if (is_same(answer, member, task) && !answer.arrived.contains(member))
      same[static_cast<std::size_t>(std::distance(answer.situation.tasks.begin(), then))] =
          AgentId(index);
    ++index;
  }
  const auto are_same = [&](const std::vector<AgentId>& agents) {
    return std::all_of(agents.begin(), agents.end(),
                       [&](AgentId i) { return same[i.index()].has_value(); });
  };
  const Attribution& proved = *answer.proved;
  GroupBound bound;
  std::set<AgentId> group;  // then
  Cost raised = 0;
  for (const Raise& raise : proved.raises) {
    raised += raise.amount;
    if (!are_same(raise.agents) || !are_same(raise.bystanders)) continue;
    if (proved.objective == Objective::makespan) {
      group.clear();
      bound.cost = proved.free_bound + raised;
    } else {
      bound.cost += raise.amount;
    }
    group.insert(raise.agents.begin(), raise.agents.end());
    group.insert(raise.bystanders.begin(), raise.bystanders.end());
  }
  if (group.empty()) return std::nullopt;
  for (const AgentId then : group) {
    if (proved.objective == Objective::sum_of_costs) bound.cost += proved.agents[then].free_cost;
    bound.agents.push_back(*same[then.index()]);
  }
  // Everybody has spent so much of it, at most.
  const auto times = proved.objective == Objective::makespan
                         ? std::int64_t{1}
                         : static_cast<std::int64_t>(bound.agents.size());
  bound.cost -= times * as_cost(answer.elapsed);
  std::sort(bound.agents.begin(), bound.agents.end());
  return bound;
}

std::vector<IdVector<AgentId, Path>> BoundCache::drafts(const Situation& now,
                                                        const Instance& instance) const {
  std::vector<IdVector<AgentId, Path>> drafts;
  for (const Answer& answer : answers_)
    if (answer.plan) drafts.push_back(paths_of(answer, now, instance));
  std::erase_if(drafts, [](const auto& paths) { return num_paths(paths) == 0; });
  std::stable_sort(drafts.begin(), drafts.end(),
                   [](const auto& a, const auto& b) { return num_paths(a) > num_paths(b); });
  if (drafts.size() > kMaxDrafts) drafts.resize(kMaxDrafts);
  return drafts;
}

IdVector<AgentId, Path> BoundCache::paths_of(const Answer& answer, const Situation& now,
                                             const Instance& instance) {
  IdVector<AgentId, Path> paths(instance.num_agents());
  std::size_t index = 0;
  for (const auto& [member, task] : now.tasks) {
    const AgentId i(index++);
    const auto then = answer.situation.tasks.find(member);
    if (!is_same(answer, member, task)) continue;
    const AgentId then_i(
        static_cast<std::size_t>(std::distance(answer.situation.tasks.begin(), then)));
    Path path = answer.plan->paths[then_i];
    if (path.empty()) continue;
    // The place of one that is under way may have another number now.
    path.front().vertex = instance.agent(i).start;
    if (is_open(instance, i, path)) paths[i] = std::move(path);
  }
  return paths;
}

}  // namespace quadrille::continuous
