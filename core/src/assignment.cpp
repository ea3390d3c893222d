// SPDX-License-Identifier: MIT
#include "quadrille/core/assignment.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <numeric>
#include <queue>
#include <utility>

namespace quadrille {
namespace {

constexpr std::size_t kNobody = std::numeric_limits<std::size_t>::max();
constexpr Cost kFar = std::numeric_limits<Cost>::max();

class Hungarian {
 public:
  Hungarian(const std::vector<std::vector<Reach>>& reach, std::size_t num_goals)
      : reach_(reach),
        owner_(num_goals, kNobody),
        price_(num_goals, 0),
        distance_(num_goals, kFar),
        asker_(num_goals, kNobody),
        is_final_(num_goals, false),
        goal_of_(reach.size(), kNobody),
        own_cost_(reach.size(), 0) {}

  std::optional<Assignment> run(LimitMonitor& limits) {
    for (std::size_t agent = 0; agent < reach_.size(); ++agent)
      if (limits.exhausted() || !augment(agent)) return std::nullopt;
    return Assignment{std::move(goal_of_), std::move(price_)};
  }

 private:
  /// One search of the kind of Dijkstra's from a new agent to the nearest free goal. What an edge
  /// costs is what an agent would pay more there than where it is.
  bool augment(std::size_t agent) {
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    reached_.clear();
    settled_.clear();
    relax(agent, 0, cheapest(agent), queue);
    while (!queue.empty()) {
      const auto [distance, goal] = queue.top();
      queue.pop();
      if (is_final_[goal]) continue;
      is_final_[goal] = true;
      if (owner_[goal] == kNobody) {
        raise_prices(distance);
        take(goal);
        forget();
        return true;
      }
      settled_.push_back(goal);
      const std::size_t owner = owner_[goal];
      relax(owner, distance, own_cost_[owner] + price_[goal], queue);
    }
    forget();
    return false;
  }

  using Entry = std::pair<Cost, std::size_t>;
  [[nodiscard]] Cost cheapest(std::size_t agent) const {
    Cost least = kFar;
    for (const Reach& to : reach_[agent]) least = std::min(least, to.cost + price_[to.goal]);
    return least;
  }
  template <class Queue>
  void relax(std::size_t agent, Cost distance, Cost paid, Queue& queue) {
    for (const Reach& to : reach_[agent]) {
      const Cost there = distance + to.cost + price_[to.goal] - paid;
      if (is_final_[to.goal] || there >= distance_[to.goal]) continue;
      if (distance_[to.goal] == kFar) reached_.push_back(to.goal);
      distance_[to.goal] = there;
      asker_[to.goal] = agent;
      queue.emplace(there, to.goal);
    }
  }
  /// So that nobody who was asked would rather be elsewhere.
  void raise_prices(Cost distance) {
    for (const std::size_t goal : settled_) price_[goal] += distance - distance_[goal];
  }
  /// Each takes the goal that it asked for, and leaves its own to the one who asked for that.
  void take(std::size_t goal) {
    while (goal != kNobody) {
      const std::size_t agent = asker_[goal];
      owner_[goal] = agent;
      const auto to = std::find_if(reach_[agent].begin(), reach_[agent].end(),
                                   [&](const Reach& one) { return one.goal == goal; });
      own_cost_[agent] = to->cost;
      goal = std::exchange(goal_of_[agent], goal);
    }
  }
  void forget() {
    for (const std::size_t goal : reached_) {
      distance_[goal] = kFar;
      is_final_[goal] = false;
    }
  }

  const std::vector<std::vector<Reach>>& reach_;
  std::vector<std::size_t> owner_;  // by goal
  std::vector<Cost> price_;
  // Of one search.
  std::vector<Cost> distance_;
  std::vector<std::size_t> asker_;
  std::vector<bool> is_final_;
  std::vector<std::size_t> reached_, settled_;
  std::vector<std::size_t> goal_of_;  // by agent
  std::vector<Cost> own_cost_;        // there
};

}  // namespace

std::optional<Assignment> cheapest_assignment(const std::vector<std::vector<Reach>>& reach,
                                              std::size_t num_goals, LimitMonitor& limits) {
  return Hungarian(reach, num_goals).run(limits);
}

std::vector<AgentId> find_crowd(const std::vector<std::vector<Reach>>& reach,
                                std::size_t num_goals) {
  std::vector<std::size_t> owner(num_goals, kNobody), asker(num_goals, kNobody);
  std::vector<std::size_t> goal_of(reach.size(), kNobody), seen(num_goals, kNobody);
  for (std::size_t first = 0; first < reach.size(); ++first) {
    std::vector<std::size_t> queue{first};
    std::size_t free = kNobody;
    for (std::size_t head = 0; head < queue.size() && free == kNobody; ++head)
      for (const Reach& to : reach[queue[head]]) {
        if (seen[to.goal] == first) continue;
        seen[to.goal] = first;
        asker[to.goal] = queue[head];
        if (owner[to.goal] == kNobody) {
          free = to.goal;
          break;
        }
        queue.push_back(owner[to.goal]);
      }
    if (free == kNobody) {
      std::sort(queue.begin(), queue.end());
      std::vector<AgentId> crowd;
      for (const std::size_t agent : queue) crowd.emplace_back(agent);
      return crowd;
    }
    // Each takes the goal that it asked for, and leaves its own to the one who asked for that.
    while (free != kNobody) {
      owner[free] = asker[free];
      free = std::exchange(goal_of[owner[free]], free);
    }
  }
  return {};
}

std::string describe_crowd(const std::vector<AgentId>& agents) {
  std::string who;
  for (std::size_t k = 0; k < agents.size(); ++k)
    who += (k == 0                   ? ""
            : k + 1 == agents.size() ? " and "
                                     : ", ") +
           std::to_string(agents[k].value());
  if (agents.size() == 1) return "agent " + who + " cannot reach any of its goals";
  return "agents " + who + " can only end at " + std::to_string(agents.size() - 1) +
         (agents.size() == 2 ? " goal" : " different goals");
}

std::vector<bool> may_be_left_over(const std::vector<std::vector<Reach>>& reach,
                                   std::size_t num_goals) {
  // Goals that an agent can choose among are in one part: the part of a goal is that of its root.
  std::vector<std::size_t> parent(num_goals);
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&](std::size_t goal) {
    while (parent[goal] != goal) goal = parent[goal] = parent[parent[goal]];
    return goal;
  };
  for (const auto& goals : reach)
    for (const Reach& to : goals) parent[root(to.goal)] = root(goals.front().goal);
  std::vector<std::size_t> num_left(num_goals, 0);
  for (std::size_t goal = 0; goal < num_goals; ++goal) ++num_left[root(goal)];
  for (const auto& goals : reach)
    if (!goals.empty()) --num_left[root(goals.front().goal)];
  std::vector<bool> may_be_left(num_goals);
  for (std::size_t goal = 0; goal < num_goals; ++goal) may_be_left[goal] = num_left[root(goal)] > 0;
  return may_be_left;
}

}  // namespace quadrille
