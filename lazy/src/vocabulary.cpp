// SPDX-License-Identifier: MIT
#include "quadrille/lazy/vocabulary.hpp"

#include <algorithm>

#include "quadrille/core/contract.hpp"

namespace quadrille::lazy {

using sat::Lit;

void Vocabulary::remember(Lit lit, const Variable& variable) {
  const auto index = static_cast<std::size_t>(lit.variable());
  if (variables_.size() <= index) variables_.resize(index + 1);
  variables_[index] = variable;
}

std::vector<Lit> Vocabulary::literals() const {
  std::vector<Lit> literals;
  for (std::size_t v = 1; v < variables_.size(); ++v)
    if (const auto kind = variables_[v].kind;
        kind == VariableKind::usage || kind == VariableKind::cost || kind == VariableKind::rest)
      literals.push_back(Lit::from_dimacs(static_cast<int>(v)));
  return literals;
}

Lit Vocabulary::at_least(AgentId agent, Cost cost, FormulaWriter& writer) {
  Rung& known = rung(agent, cost, writer);
  known.is_natural = true;
  return known.at_least;
}

Lit Vocabulary::above(AgentId agent, Cost cap, FormulaWriter& writer) {
  return rung(agent, cap + 1, writer).at_least;
}

Vocabulary::Rung& Vocabulary::rung(AgentId agent, Cost cost, FormulaWriter& writer) {
  auto& ladder = ladders_[agent];
  const auto at = std::lower_bound(ladder.begin(), ladder.end(), cost,
                                   [](const Rung& rung, Cost c) { return rung.cost < c; });
  if (at != ladder.end() && at->cost == cost) return *at;
  QUADRILLE_REQUIRE(cost > free_cost(agent), "nobody costs less than its free cost");
  const Lit fresh = writer.new_lit();
  const Lit made = costs_are_ == Costs::positive ? fresh : ~fresh;
  remember(made, {VariableKind::cost, agent, cost, ObstacleId(), 0, {}});
  const auto index = static_cast<std::size_t>(at - ladder.begin());
  ladder.insert(at, {cost, made, false});
  const auto order = [&](Lit stronger, Lit weaker) {
    const Lit clause[] = {~stronger, weaker};
    writer.add({sat::why::Order{agent}, clause, {}, false});
  };
  if (cost >= cost_bound(agent)) {
    const Lit clause[] = {~made};
    writer.add({sat::why::Ceiling{agent}, clause, {}, false});
  }
  if (index > 0) order(made, ladder[index - 1].at_least);
  if (index + 1 < ladder.size()) order(ladder[index + 1].at_least, made);
  return ladder[index];
}

Lit Vocabulary::rests(const Rest& rest, FormulaWriter& writer) {
  const auto key = std::make_tuple(rest.resident, rest.goal, rest.cost);
  if (const auto known = rests_.find(key); known != rests_.end()) return known->second;
  const Lit costs_more = at_least(rest.resident, rest.cost, writer);
  const Lit made = writer.new_lit();
  remember(made, {VariableKind::rest, rest.resident, rest.cost, ObstacleId(), 0, rest.goal});
  rests_.emplace(key, made);
  const Lit clause[] = {~rest.may_end, costs_more, made};
  writer.add({sat::why::Rest{rest.resident}, clause, {}, false});
  return made;
}

Lit Vocabulary::left_over(VertexId goal, FormulaWriter& writer) {
  Lit& known = left_over_[goal];
  if (known.valid()) return known;
  known = writer.new_lit();
  remember(known, {VariableKind::left_over, {}, 0, ObstacleId(), 0, goal});
  return known;
}

void Vocabulary::take(VertexId goal, std::span<const MayEndElsewhere> elsewhere,
                      FormulaWriter& writer) {
  std::vector<Lit> clause{left_over(goal, writer)};
  std::vector<sat::Usage> usages;
  for (const MayEndElsewhere& one : elsewhere) {
    clause.push_back(~one.allowed);
    usages.push_back({one.agent, one.obstacle.value()});
  }
  writer.add({sat::why::Taken{goal}, clause, usages, false});
}

Lit Vocabulary::new_usage(AgentId agent, ObstacleId obstacle, FormulaWriter& writer) {
  const Lit allowed = ~writer.new_lit();
  remember(allowed, {VariableKind::usage, agent, 0, obstacle, 0, {}});
  return allowed;
}

Lit Vocabulary::new_own(AgentId agent, std::uint32_t own, FormulaWriter& writer) {
  const Lit made = writer.new_lit();
  remember(made, {VariableKind::own, agent, 0, ObstacleId(), own, {}});
  return made;
}

}  // namespace quadrille::lazy
