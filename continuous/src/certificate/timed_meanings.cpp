// SPDX-License-Identifier: MIT
#include "certificate/timed_meanings.hpp"

namespace quadrille::continuous {

using sat::CertificateWriter;
namespace why = sat::why;

namespace {

constexpr int kEncounterRule = 12, kCeilingRule = 13;

}  // namespace

TimedMeanings::TimedMeanings(const Model& model, int num_variables)
    : model_(model),
      standing_(model.scene(), num_variables),
      num_variables_(standing_.last_variable()) {
  for (const auto& goal : model.goal_obstacles())
    goals_[{goal.agent, model.obstacles()[goal.obstacle].allowed.dimacs()}] = goal.obstacle;
}

// Usages are negated variables, as in certificates: a variable says "does not". Costs are the
// opposite of "costs at most".
bool TimedMeanings::declare(int variable, CertificateWriter& writer) const {
  using Kind = Model::VariableKind;
  const auto meaning = model_.variable(sat::Lit::from_dimacs(variable));
  switch (meaning.kind) {
    case Kind::auxiliary:
    case Kind::own:
    case Kind::rest:  // of agents with several goals
    case Kind::left_over:
      return false;
    case Kind::usage:
      declare(variable, model_.obstacles()[meaning.obstacle], writer);
      return true;
    case Kind::cost:
      writer.negate(variable);
      declare_cost(variable, meaning.agent, meaning.cost - 1, writer);
      return true;
  }
  return false;
}

std::vector<ObstacleId> TimedMeanings::goals_around(AgentId agent,
                                                    std::span<const sat::Lit> clause) const {
  std::vector<ObstacleId> around;
  for (const sat::Lit lit : clause)
    if (const auto goal = goals_.find({agent, lit.dimacs()}); goal != goals_.end())
      around.push_back(goal->second);
  return around;
}

void TimedMeanings::prepare(const sat::Why& reason, std::span<const sat::Lit> clause,
                            CertificateWriter& writer) const {
  const auto* path = std::get_if<why::Path>(&reason);
  if (path == nullptr) return;
  for (const ObstacleId goal : goals_around(path->agent, clause))
    if (const auto [made, is_new] = variables_.try_emplace(goal, num_variables_ + 1); is_new) {
      ++num_variables_;
      declare(made->second, model_.obstacles()[goal], writer);
    }
}

sat::ProofMeanings::Rule TimedMeanings::rule_of(const sat::Why& reason,
                                                std::span<const sat::Lit> clause) const {
  if (const auto* path = std::get_if<why::Path>(&reason)) {
    Rule rule{kPathRule, {agent_number(path->agent)}};
    if (const int standing = standing_.variable(path->agent); standing != 0)
      rule.parameters.push_back(standing);
    for (const ObstacleId goal : goals_around(path->agent, clause))
      rule.parameters.push_back(variables_.at(goal));
    return rule;
  }
  if (const auto* order = std::get_if<why::Order>(&reason))
    return {kPathRule, {agent_number(order->agent)}};
  if (std::holds_alternative<why::Moves>(reason) || std::holds_alternative<why::Stay>(reason))
    return {kEncounterRule, {}};
  if (const auto* ceiling = std::get_if<why::Ceiling>(&reason)) {
    // By its deadline, or in plans that are cheap enough.
    const auto meaning = model_.variable(clause.front());
    if (meaning.cost >= model_.cost_bound(ceiling->agent))
      return {kPathRule, {agent_number(ceiling->agent)}};
    return {kCeilingRule, {}};
  }
  return {};
}

}  // namespace quadrille::continuous
