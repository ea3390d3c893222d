// SPDX-License-Identifier: MIT
#include "quadrille/lazy/recorder.hpp"

#include <algorithm>

namespace quadrille::lazy {
namespace {

/// The agents of a collision lemma: those that it names, and those that its clause says nothing
/// about, because they do what collides whatever happens.
struct Parties {
  std::vector<AgentId> named, silent;
};

Parties parties_of(const sat::Why& why, std::span<const sat::Usage> usages) {
  Parties parties;
  const auto add = [](std::vector<AgentId>& agents, AgentId i) {
    if (std::find(agents.begin(), agents.end(), i) == agents.end()) agents.push_back(i);
  };
  if (const auto* pair = std::get_if<sat::why::Pair>(&why))
    parties.named = {pair->first, pair->second};
  for (const sat::Usage& usage : usages) add(parties.named, usage.agent);
  if (const auto* rectangle = std::get_if<sat::why::Rectangle>(&why))
    for (const AgentId i : {rectangle->horizontal, rectangle->vertical})
      if (std::find(parties.named.begin(), parties.named.end(), i) == parties.named.end())
        parties.silent.push_back(i);
  return parties;
}

}  // namespace

Recorder::Recorder(const Vocabulary& vocabulary, std::size_t num_agents, sat::ClauseObserver* next)
    : PassingObserver(next),
      vocabulary_(vocabulary),
      is_unconditional_(num_agents, false),
      has_ceiling_(num_agents, false) {}

void Recorder::on_lemma(const sat::Lemma& lemma) {
  PassingObserver::on_lemma(lemma);
  if (sat::is_collision(lemma.why)) {
    usages_.insert(usages_.end(), lemma.usages.begin(), lemma.usages.end());
    collisions_.emplace_back(lemma.why, usages_.size());
  } else if (const auto* path = std::get_if<sat::why::Path>(&lemma.why)) {
    if (!has_cost_of(path->agent, lemma.clause)) is_unconditional_[path->agent] = true;
  } else if (const auto* explicit_path = std::get_if<sat::why::ExplicitPath>(&lemma.why)) {
    is_unconditional_[explicit_path->agent] = true;
  } else if (const auto* ceiling = std::get_if<sat::why::Ceiling>(&lemma.why)) {
    has_ceiling_[ceiling->agent] = true;
  }
}

bool Recorder::has_cost_of(AgentId agent, std::span<const sat::Lit> clause) const {
  return std::any_of(clause.begin(), clause.end(), [&](sat::Lit lit) {
    const auto variable = vocabulary_.variable(lit);
    return variable.kind == Vocabulary::VariableKind::cost && variable.agent == agent;
  });
}

sat::Dependence Recorder::dependence(bool has_plan) const {
  sat::Dependence dependence(is_unconditional_.size());
  std::vector<AgentId> unconditional, with_ceiling;
  for (const AgentId i : IdRange<AgentId>(is_unconditional_.size())) {
    if (has_ceiling_[i]) with_ceiling.push_back(i);
    if (!is_unconditional_[i]) continue;
    dependence.set_unconditional(i);
    unconditional.push_back(i);
  }
  // Otherwise nobody knows whether they can all do what they have to.
  if (!has_plan) dependence.imply({}, unconditional);
  // It cannot be assumed that they cost more.
  dependence.imply({}, with_ceiling);
  for_each_collision([&](const sat::Why& why, std::span<const sat::Usage> usages) {
    const Parties parties = parties_of(why, usages);
    if (!parties.silent.empty())
      dependence.imply(parties.named, parties.silent);
    else if (parties.named.size() == 2)
      dependence.link(parties.named[0], parties.named[1]);
  });
  for (const Vocabulary::GoalObstacle& goal : vocabulary_.goal_obstacles())
    dependence.link(goal.agent, goal.resident);
  return dependence;
}

}  // namespace quadrille::lazy
