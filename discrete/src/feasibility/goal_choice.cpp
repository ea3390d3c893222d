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

/// Assigns goals to agents, a goal to one agent only.
class GoalMatching {
 public:
  static constexpr std::size_t kNobody = SIZE_MAX;

  GoalMatching(const Instance& instance, const GoalReach& reach)
      : instance_(instance),
        owner_(instance.graph().num_vertices(), kNobody),
        seen_(instance.graph().num_vertices(), 0),
        asker_(instance.graph().num_vertices()) {
    for (const std::vector<Reach>& own : reach.agents) {
      std::vector<VertexId> near;
      for (const Reach& to : own) near.push_back(reach.goals[to.goal]);
      near_.push_back(std::move(near));
    }
  }

  /// Agents that can only end at fewer goals than they are; empty if all have a goal of their own.
  /// Augmenting paths, found breadth first.
  [[nodiscard]] std::vector<AgentId> match() {
    for (const AgentId i : instance_.agent_ids())
      if (auto crowd = augment(i); !crowd.empty()) return crowd;
    return {};
  }
  /// Those of an agent that it can reach, nearest first.
  [[nodiscard]] const std::vector<VertexId>& near(AgentId i) const { return near_[i]; }

 private:
  std::vector<AgentId> augment(AgentId first) {
    ++round_;
    std::vector<AgentId> queue{first};
    for (std::size_t head = 0; head < queue.size(); ++head)
      for (const VertexId goal : near_[queue[head]]) {
        if (seen_[goal] == round_) continue;
        seen_[goal] = round_;
        asker_[goal] = queue[head];
        if (owner_[goal] != kNobody) {
          queue.emplace_back(owner_[goal]);
          continue;
        }
        // Each takes the goal it asked for, and leaves its own to the one who asked for that.
        for (std::optional<VertexId> free = goal; free;) {
          const AgentId taker = asker_[*free];
          const auto left = std::find_if(near_[taker].begin(), near_[taker].end(),
                                         [&](VertexId v) { return owner_[v] == taker.index(); });
          owner_[*free] = taker.index();
          free = left == near_[taker].end() ? std::nullopt : std::optional<VertexId>(*left);
        }
        return {};
      }
    std::sort(queue.begin(), queue.end());
    return queue;
  }

  const Instance& instance_;
  IdVector<AgentId, std::vector<VertexId>> near_;
  IdVector<VertexId, std::size_t> owner_;  // an agent
  IdVector<VertexId, std::int64_t> seen_;  // in the round with that number
  IdVector<VertexId, AgentId> asker_;
  std::int64_t round_ = 0;
};

Instance with_goals(const Instance& instance, const std::vector<VertexId>& goals) {
  std::vector<Agent> agents;
  for (const AgentId i : instance.agent_ids())
    agents.push_back({instance.agents()[i].start, goals[i.index()]});
  return instance.with_agents(std::move(agents)).value();
}

Feasibility crowded(const std::vector<AgentId>& agents) {
  std::string who;
  for (std::size_t k = 0; k < agents.size(); ++k)
    who += (k == 0                   ? ""
            : k + 1 == agents.size() ? " and "
                                     : ", ") +
           std::to_string(agents[k].value());
  if (agents.size() == 1) return {false, "agent " + who + " cannot reach any of its goals", agents};
  return {false,
          "agents " + who + " can only end at " + std::to_string(agents.size() - 1) +
              (agents.size() == 2 ? " goal" : " different goals"),
          agents};
}

/// All choices, one after the other: agents in their order, each with its goals from the nearest
/// on.
class Choices {
 public:
  Choices(const Instance& instance, const GoalMatching& matching)
      : instance_(instance),
        matching_(matching),
        is_taken_(instance.graph().num_vertices(), false) {}

  /// The next one; nullopt if there is none, or if the steps are used up.
  std::optional<std::vector<VertexId>> next(std::int64_t& steps) {
    if (!at_.empty()) release();
    while (at_.size() < instance_.num_agents() || is_open_) {
      if (!is_open_) at_.push_back(0);
      is_open_ = false;
      const auto& near = matching_.near(AgentId(at_.size() - 1));
      std::size_t& k = at_.back();
      while (k < near.size() && is_taken_[near[k]]) ++k;
      if (--steps <= 0) return std::nullopt;
      if (k < near.size()) {
        is_taken_[near[k]] = true;
        continue;
      }
      at_.pop_back();
      if (at_.empty()) return std::nullopt;
      release();
    }
    std::vector<VertexId> goals;
    for (std::size_t i = 0; i < at_.size(); ++i)
      goals.push_back(matching_.near(AgentId(i))[at_[i]]);
    return goals;
  }

 private:
  void release() {
    is_taken_[matching_.near(AgentId(at_.size() - 1))[at_.back()]] = false;
    ++at_.back();
    is_open_ = true;
  }

  const Instance& instance_;
  const GoalMatching& matching_;
  std::vector<std::size_t> at_;  // by agent: which of its goals
  IdVector<VertexId, bool> is_taken_;
  bool is_open_ = false;  // the last one of these needs its next goal
};

}  // namespace

GoalChoice choose_goals(const Instance& instance, LimitMonitor* limits) {
  LimitMonitor none{Limits{}};
  LimitMonitor& monitor = limits != nullptr ? *limits : none;
  const auto reach = find_goal_reach(instance, monitor);
  if (!reach) return {{}, std::nullopt};
  GoalMatching matching(instance, *reach);
  if (const auto crowd = matching.match(); !crowd.empty()) return {crowded(crowd), std::nullopt};
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
  Choices choices(instance, matching);
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
