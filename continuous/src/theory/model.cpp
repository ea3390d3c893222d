// SPDX-License-Identifier: MIT
#include "theory/model.hpp"

#include <algorithm>
#include <utility>

#include "quadrille/core/contract.hpp"

namespace quadrille::continuous {

Model::Model(Scene& scene)
    : Vocabulary(scene.instance().num_agents(), Costs::positive), scene_(scene) {
  static_assert(kAnyCost == lazy::kNoCap);
  QUADRILLE_REQUIRE(scene.is_complete(), "the distances to all goals are known");
}

ObstacleId Model::usage(AgentId agent, std::vector<Ban> bans, AgentId partner,
                        FormulaWriter& writer, bool& is_new) {
  const Ban cause = bans.front();
  std::sort(bans.begin(), bans.end());
  const auto [at, inserted] = usages_.try_emplace({agent, bans}, obstacles_.next_id());
  is_new = inserted;
  if (inserted) {
    const sat::Lit allowed = new_usage(agent, at->second, writer);
    obstacles_.push_back({agent, allowed, std::move(bans), {}, cause});
  }
  auto& partners = obstacles_[at->second].partners;
  if (partner != agent && std::find(partners.begin(), partners.end(), partner) == partners.end())
    partners.push_back(partner);
  return at->second;
}

ObstacleId Model::keep_off_goal(AgentId agent, AgentId resident, VertexId goal, Ticks tick,
                                FormulaWriter& writer, bool& is_new) {
  Rest rest{resident, goal, as_cost(tick)};
  if (!instance().agent(resident).goals.is_single()) {
    bool is_new_end = false;
    rest.may_end = obstacles_[end(resident, goal, agent, writer, is_new_end)].allowed;
  }
  const auto make = [&](sat::Lit allowed) {
    const ObstacleId made = obstacles_.next_id();
    obstacles_.push_back({agent, allowed, goal_bans(agent, resident, goal, tick), {resident}, {}});
    return made;
  };
  const auto [id, inserted] = goal_obstacle(agent, rest, writer, make);
  is_new = inserted;
  return id;
}

void Model::take(VertexId goal, FormulaWriter& writer) {
  std::vector<MayEndElsewhere> all;
  for (const AgentId i : instance().agent_ids()) {
    const Goals& goals = instance().agent(i).goals;
    if (!goals.contains(goal)) continue;
    // Whoever has no other goal takes it in every plan.
    if (goals.is_single()) return;
    std::vector<Ban> elsewhere;
    for (const VertexId other : goals.vertices())
      if (other != goal) elsewhere.push_back(Ban::end(other));
    bool is_new = false;
    const ObstacleId id = usage(i, std::move(elsewhere), i, writer, is_new);
    all.push_back({i, id, obstacles_[id].allowed});
  }
  take(goal, all, writer);
}

// Let the resident arrive for good before `tick`, that is at tick - 1 or earlier. Moves that
// collide with a stay from tick - 1 on for ever collide with one from earlier on. A stay near the
// goal collides if it ends after the arrival, and ending after tick - 1 is enough.
std::vector<Ban> Model::goal_bans(AgentId agent, AgentId resident, VertexId goal, Ticks tick) {
  const ClassId a = instance().class_of(agent), b = instance().class_of(resident);
  const auto& near = contacts().near_vertex(b, goal, a);
  std::vector<Ban> bans;
  for (const EdgeId e : near.edges)
    if (const auto window = contacts().window(a, e, b, goal))
      bans.push_back(Ban::start(e, starts_meeting(*window, tick - 1, kForever)));
  for (const VertexId v : near.vertices)
    if (contacts().overlap(a, v, b, goal)) bans.push_back(Ban::stay(v, {tick - 1, kForever}));
  return bans;
}

}  // namespace quadrille::continuous
