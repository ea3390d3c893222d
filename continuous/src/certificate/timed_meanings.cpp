// SPDX-License-Identifier: MIT
#include "certificate/timed_meanings.hpp"

#include <algorithm>

namespace quadrille::continuous {

using sat::CertificateWriter;
namespace why = sat::why;

namespace {

constexpr int kEncounterRule = 12, kCeilingRule = 13, kPairRule = 14;

}  // namespace

TimedMeanings::TimedMeanings(Model& model, int num_variables)
    : model_(model),
      standing_(model.scene(), num_variables),
      contacts_(model.scene()),
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
  if (const auto* path = std::get_if<why::Path>(&reason))
    declare_goals(path->agent, clause, writer);
  if (const auto* pair = std::get_if<why::Pair>(&reason)) {
    declare_goals(pair->first, clause, writer);
    declare_goals(pair->second, clause, writer);
    contacts_.write(party(pair->first, clause), party(pair->second, clause), writer);
  }
}

void TimedMeanings::declare_goals(AgentId agent, std::span<const sat::Lit> clause,
                                  CertificateWriter& writer) const {
  for (const ObstacleId goal : goals_around(agent, clause))
    if (const auto [made, is_new] = variables_.try_emplace(goal, num_variables_ + 1); is_new) {
      ++num_variables_;
      declare(made->second, model_.obstacles()[goal], writer);
    }
}

PairContacts::Party TimedMeanings::party(AgentId agent, std::span<const sat::Lit> clause) const {
  PairContacts::Party party{agent, model_.cost_bound(agent)};
  for (const sat::Lit lit : clause)
    if (const auto meaning = model_.variable(lit);
        meaning.kind == Model::VariableKind::cost && meaning.agent == agent)
      party.most = std::min(party.most, meaning.cost - 1);
  return party;
}

sat::ProofMeanings::Rule TimedMeanings::rule_of_paths(int number,
                                                      std::initializer_list<AgentId> agents,
                                                      std::span<const sat::Lit> clause) const {
  Rule rule{number, {}};
  for (const AgentId agent : agents) rule.parameters.push_back(agent_number(agent));
  for (const AgentId agent : agents) {
    if (const int standing = standing_.variable(agent); standing != 0)
      rule.parameters.push_back(standing);
    for (const ObstacleId goal : goals_around(agent, clause))
      rule.parameters.push_back(variables_.at(goal));
  }
  return rule;
}

sat::ProofMeanings::Rule TimedMeanings::rule_of(const sat::Why& reason,
                                                std::span<const sat::Lit> clause) const {
  if (const auto* path = std::get_if<why::Path>(&reason))
    return rule_of_paths(kPathRule, {path->agent}, clause);
  if (const auto* pair = std::get_if<why::Pair>(&reason))
    return rule_of_paths(kPairRule, {pair->first, pair->second}, clause);
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
