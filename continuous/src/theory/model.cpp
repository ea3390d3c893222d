// SPDX-License-Identifier: MIT
#include "theory/model.hpp"

#include <algorithm>
#include <utility>

#include "quadrille/core/contract.hpp"

namespace quadrille::continuous {

using sat::Lit;

Model::Model(Scene& scene) : scene_(scene), thresholds_(scene.instance().num_agents()) {
  QUADRILLE_REQUIRE(scene.is_complete(), "the distances to all goals are known");
}

void Model::remember(Lit lit, const Variable& variable) {
  const auto index = static_cast<std::size_t>(lit.variable());
  if (variables_.size() <= index) variables_.resize(index + 1);
  variables_[index] = variable;
  literals_.push_back(lit.positive() ? lit : ~lit);
}

Model::Variable Model::variable(Lit lit) const {
  const auto index = static_cast<std::size_t>(lit.variable());
  return index < variables_.size() ? variables_[index] : Variable{};
}

Lit Model::at_least(AgentId agent, Cost cost, FormulaWriter& writer) {
  Threshold& known = threshold(agent, cost, writer);
  known.is_natural = true;
  return known.at_least;
}

Lit Model::above(AgentId agent, Cost cap, FormulaWriter& writer) {
  return threshold(agent, cap + 1, writer).at_least;
}

Model::Threshold& Model::threshold(AgentId agent, Cost cost, FormulaWriter& writer) {
  QUADRILLE_REQUIRE(cost > free_cost(agent), "nobody costs less than its free cost");
  auto& known = thresholds_[agent];
  const auto at = std::lower_bound(known.begin(), known.end(), cost,
                                   [](const Threshold& t, Cost c) { return t.cost < c; });
  if (at != known.end() && at->cost == cost) return *at;
  const Lit made = writer.new_lit();
  remember(made, {VariableKind::cost, agent, cost, ObstacleId()});
  const auto index = static_cast<std::size_t>(at - known.begin());
  known.insert(at, {cost, made, false});
  const auto order = [&](Lit stronger, Lit weaker) {
    const Lit clause[] = {~stronger, weaker};
    writer.add({sat::LemmaKind::order, clause, {}, false});
  };
  if (as_ticks(cost) >= arrival_bound(instance(), agent)) {
    const Lit clause[] = {~made};
    writer.add({sat::LemmaKind::order, clause, {}, false});
  }
  if (index > 0) order(made, known[index - 1].at_least);
  if (index + 1 < known.size()) order(known[index + 1].at_least, made);
  return known[index];
}

ObstacleId Model::usage(AgentId agent, std::vector<Ban> bans, AgentId partner,
                        FormulaWriter& writer, bool& is_new) {
  const Ban cause = bans.front();
  std::sort(bans.begin(), bans.end());
  const auto [at, inserted] = usages_.try_emplace({agent, bans}, obstacles_.next_id());
  is_new = inserted;
  if (inserted) {
    // Variables are false by default in the solver: what is forbidden is the exception.
    const Lit allowed = ~writer.new_lit();
    remember(allowed, {VariableKind::usage, agent, 0, at->second});
    obstacles_.push_back({agent, allowed, std::move(bans), {}, cause});
  }
  auto& partners = obstacles_[at->second].partners;
  if (std::find(partners.begin(), partners.end(), partner) == partners.end())
    partners.push_back(partner);
  return at->second;
}

// Let the resident arrive for good before `tick`, that is at tick - 1 or earlier. Moves that
// collide with a stay from tick - 1 on for ever collide with one from earlier on. A stay near the
// goal collides if it ends after the arrival, and ending after tick - 1 is enough.
ObstacleId Model::keep_off_goal(AgentId agent, AgentId resident, Ticks tick, FormulaWriter& writer,
                                bool& is_new) {
  const auto [at, inserted] =
      goals_.try_emplace(std::make_tuple(agent, resident, tick), obstacles_.next_id());
  is_new = inserted;
  if (!inserted) return at->second;
  const Lit later = at_least(resident, as_cost(tick), writer);
  const ClassId a = instance().class_of(agent), b = instance().class_of(resident);
  const VertexId goal = instance().agent(resident).goal;
  const auto& near = contacts().near_vertex(b, goal, a);
  std::vector<Ban> bans;
  for (const EdgeId e : near.edges)
    if (const auto window = contacts().window(a, e, b, goal))
      bans.push_back(Ban::start(e, starts_meeting(*window, tick - 1, kForever)));
  for (const VertexId v : near.vertices)
    if (contacts().overlap(a, v, b, goal)) bans.push_back(Ban::stay(v, {tick - 1, kForever}));
  obstacles_.push_back({agent, later, std::move(bans), {resident}, {}});
  return at->second;
}

}  // namespace quadrille::continuous
