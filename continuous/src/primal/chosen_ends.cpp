// SPDX-License-Identifier: MIT
#include "primal/chosen_ends.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "paths/earliest_visits.hpp"

namespace quadrille::continuous {
namespace {

/// Gives each agent a goal. After Kuhn, "The Hungarian method for the assignment problem", Naval
/// Research Logistics 1955: who finds a goal taken asks its owner to take another one. Where one
/// goal is in the way of several, nobody is asked: so it may fail where there is a choice.
class Choice {
 public:
  explicit Choice(Scene& scene)
      : scene_(scene), near_(scene.instance().num_agents()), end_(scene.instance().num_agents()) {}

  bool choose() {
    const Instance& instance = scene_.instance();
    for (const AgentId i : instance.agent_ids()) rank_goals(i);
    for (const AgentId i : instance.agent_ids()) {
      is_asked_.assign(instance.num_agents(), false);
      if (!find_end(i)) return false;
    }
    return true;
  }
  [[nodiscard]] VertexId end(AgentId i) const { return *end_[i]; }

 private:
  void rank_goals(AgentId i) {
    scene_.limits().check();
    const std::vector<Ticks> visits = earliest_visits(scene_.instance(), i);
    std::vector<std::pair<Ticks, VertexId>> ranked;
    for (const VertexId goal : scene_.instance().agent(i).goals.vertices())
      if (visits[goal.index()] < kForever) ranked.emplace_back(visits[goal.index()], goal);
    std::sort(ranked.begin(), ranked.end());
    for (const auto& [ticks, goal] : ranked) near_[i].push_back(goal);
  }

  // Depth first: as deep as there are agents at most.
  bool find_end(AgentId i) {
    scene_.limits().check();
    is_asked_[i] = true;
    for (const VertexId goal : near_[i]) {
      const std::vector<AgentId> owners = who_is_in_the_way(i, goal);
      if (owners.size() > 1) continue;
      if (!owners.empty() && (is_asked_[owners.front()] || !find_another(owners.front(), goal, i)))
        continue;
      end_[i] = goal;
      return true;
    }
    return false;
  }

  /// For `owner`, while `taker` has taken a goal.
  bool find_another(AgentId owner, VertexId goal, AgentId taker) {
    const std::optional<VertexId> old_owner = end_[owner], old_taker = end_[taker];
    end_[owner].reset();
    end_[taker] = goal;
    if (find_end(owner)) return true;
    end_[owner] = old_owner;
    end_[taker] = old_taker;
    return false;
  }

  [[nodiscard]] std::vector<AgentId> who_is_in_the_way(AgentId i, VertexId goal) {
    const Instance& instance = scene_.instance();
    std::vector<AgentId> found;
    if (instance.agent(i).leaves) return found;
    for (const AgentId j : instance.agent_ids())
      if (j != i && end_[j] && !instance.agent(j).leaves &&
          scene_.contacts().overlap(instance.class_of(i), goal, instance.class_of(j), *end_[j]))
        found.push_back(j);
    return found;
  }

  Scene& scene_;
  IdVector<AgentId, std::vector<VertexId>> near_;  // goals, the nearest one first
  IdVector<AgentId, std::optional<VertexId>> end_;
  IdVector<AgentId, bool> is_asked_;  // in this round
};

}  // namespace

std::optional<Instance> with_chosen_ends(Scene& scene) {
  const Instance& instance = scene.instance();
  Choice choice(scene);
  if (!choice.choose()) return std::nullopt;
  std::vector<Agent> agents;
  for (const AgentId i : instance.agent_ids()) {
    agents.push_back(instance.agent(i));
    agents.back().goals = choice.end(i);
  }
  auto made = instance.with_agents(std::move(agents));
  if (!made) return std::nullopt;
  return std::move(made).value();
}

}  // namespace quadrille::continuous
