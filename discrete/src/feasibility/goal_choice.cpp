// SPDX-License-Identifier: MIT
#include "feasibility/goal_choice.hpp"

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "feasibility/goal_reach.hpp"
#include "quadrille/core/assignment.hpp"

namespace quadrille::discrete {
namespace {

/// Steps for choices other than the first one, about a tenth of a second. Each choice takes as many
/// as the graph has vertices and edges.
constexpr std::int64_t kMostSteps = 10'000'000;

Instance with_goals(const Instance& instance, const std::vector<VertexId>& goals) {
  std::vector<Agent> agents;
  for (const AgentId i : instance.agent_ids())
    agents.push_back({instance.agents()[i].start, goals[i.index()]});
  return instance.with_agents(std::move(agents)).value();
}

/// All choices, one after the other: agents in their order, each with its goals from the nearest
/// on.
class Choices {
 public:
  Choices(const Instance& instance, const GoalReach& reach)
      : instance_(instance), reach_(reach), is_taken_(reach.goals.size(), false) {}

  /// The next one; nullopt if there is none, or if the steps are used up.
  std::optional<std::vector<VertexId>> next(std::int64_t& steps) {
    if (!at_.empty()) release();
    while (at_.size() < instance_.num_agents() || is_open_) {
      if (!is_open_) at_.push_back(0);
      is_open_ = false;
      const std::vector<Reach>& near = reach_.agents[at_.size() - 1];
      std::size_t& k = at_.back();
      while (k < near.size() && is_taken_[near[k].goal]) ++k;
      if (--steps <= 0) return std::nullopt;
      if (k < near.size()) {
        is_taken_[near[k].goal] = true;
        continue;
      }
      at_.pop_back();
      if (at_.empty()) return std::nullopt;
      release();
    }
    std::vector<VertexId> goals;
    for (std::size_t i = 0; i < at_.size(); ++i)
      goals.push_back(reach_.goals[reach_.agents[i][at_[i]].goal]);
    return goals;
  }

 private:
  void release() {
    is_taken_[reach_.agents[at_.size() - 1][at_.back()].goal] = false;
    ++at_.back();
    is_open_ = true;
  }

  const Instance& instance_;
  const GoalReach& reach_;
  std::vector<std::size_t> at_;  // by agent: which of its goals
  std::vector<bool> is_taken_;   // by goal
  bool is_open_ = false;         // the last one of these needs its next goal
};

}  // namespace

GoalChoice choose_goals(const Instance& instance, LimitMonitor* limits) {
  LimitMonitor none{Limits{}};
  LimitMonitor& monitor = limits != nullptr ? *limits : none;
  const auto reach = find_goal_reach(instance, monitor);
  if (!reach) return {{}, std::nullopt};
  if (auto crowd = find_crowd(reach->agents, reach->goals.size()); !crowd.empty()) {
    std::string reason = describe_crowd(crowd);
    return {{false, std::move(reason), std::move(crowd)}, std::nullopt};
  }
  const auto cheapest = cheapest_assignment(reach->agents, reach->goals.size(), monitor);
  if (!cheapest) return {{}, std::nullopt};
  std::vector<VertexId> nearest;
  for (const std::size_t goal : cheapest->goals) nearest.push_back(reach->goals[goal]);
  Instance first = with_goals(instance, nearest);
  Feasibility verdict = check_feasibility(first);
  if (verdict.feasible) return {{}, std::move(first)};
  std::int64_t edges = 0;
  for (const VertexId v : IdRange<VertexId>(instance.graph().num_vertices()))
    edges += static_cast<std::int64_t>(instance.graph().neighbours(v).size());
  const auto price = static_cast<std::int64_t>(instance.graph().num_vertices()) + edges;
  std::int64_t steps = kMostSteps;
  Choices choices(instance, *reach);
  while (const auto goals = choices.next(steps)) {
    if (limits != nullptr && limits->exhausted()) return {{}, std::nullopt};
    Instance candidate = with_goals(instance, *goals);
    if (check_feasibility(candidate).feasible) return {{}, std::move(candidate)};
    if ((steps -= price) <= 0) break;
  }
  if (steps <= 0) {
    Feasibility undecided;
    undecided.is_decided = false;
    return {std::move(undecided), std::nullopt};
  }
  verdict.reason = "there is no plan whichever goals are chosen; with the nearest ones, " +
                   std::move(verdict.reason);
  return {std::move(verdict), std::nullopt};
}

}  // namespace quadrille::discrete
