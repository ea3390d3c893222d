// SPDX-License-Identifier: MIT
#include "theory/domain.hpp"

#include <algorithm>
#include <map>

#include "quadrille/core/contract.hpp"

namespace quadrille::continuous {

ContinuousDomain::ContinuousDomain(Model& model)
    : model_(model),
      paths_(model),
      search_(model),
      finder_(model.instance(), &model.limits()),
      bans_(model.instance().roadmap()),
      clauses_(model, finder_, bans_),
      pair_lemmas_(model),
      meetings_(model.scene()) {
  for (const AgentId i : model.instance().agent_ids()) {
    const TimedPath* path = search_.find(i, {}, kAnyCost).path();
    QUADRILLE_REQUIRE(path != nullptr, "goals can be reached");
    paths_.set_path(i, make_path(i, *path));
  }
}

Plan ContinuousDomain::plan() const {
  Plan plan;
  for (const AgentId i : model_.instance().agent_ids())
    plan.paths.push_back(with_stops(model_.instance(), i, paths_.path(i)->path));
  return plan;
}

Cost ContinuousDomain::current_cost(AgentId i, const PathTrail& trail) const {
  return std::max(paths_.cost(paths_.path(i)), trail.floor(i));
}

void ContinuousDomain::on_explained(const lazy::Explanation& lemma, const PathTrail& trail,
                                    FormulaWriter& writer) {
  if (lemma.bound >= kAnyCost) return;
  pair_lemmas_.set_path_effort(search_.effort());
  std::map<AgentId, int> due_to;
  for (const ObstacleId id : lemma.blamed)
    for (const AgentId j : model_.obstacles()[id].partners) ++due_to[j];
  const AgentId i = lemma.agent;
  for (const auto& [j, count] : due_to) {
    if (count < 2) continue;
    if (pair_lemmas_.note_explanation({i, std::min(lemma.bound - 1, trail.cap(i)), lemma.blamed},
                                      {j, trail.cap(j), trail.active(j)}, writer))
      return;
  }
}

std::vector<Encounter> ContinuousDomain::conflicts(const PathTrail& /*trail*/) {
  for (const AgentId i : model_.instance().agent_ids())
    meetings_.put(i, paths_.path(i)->steps, paths_.path(i)->version);
  return meetings_.encounters();
}

std::vector<ObstacleId> ContinuousDomain::exclude(const Encounter& e, const PathTrail& trail,
                                                  FormulaWriter& writer) {
  if (do_ends_overlap(e.first, e.second))
    return clauses_.exclude_ends(end_of(e.first), end_of(e.second), writer);
  if (note_collision(e, trail, writer)) return {};
  return clauses_.exclude(e, as_ticks(current_cost(e.first, trail)),
                          as_ticks(current_cost(e.second, trail)), writer);
}

EncounterClauses::End ContinuousDomain::end_of(AgentId i) const {
  const TimedPath& path = paths_.path(i)->path;
  const Instance& instance = model_.instance();
  return {i, path.moves.empty() ? instance.agent(i).start
                                : instance.roadmap().edge(path.moves.back().edge).to};
}

// Two agents who have no choice end apart: seen when the instance was made.
bool ContinuousDomain::do_ends_overlap(AgentId i, AgentId j) {
  const Instance& instance = model_.instance();
  const Agent &a = instance.agent(i), &b = instance.agent(j);
  if (a.leaves || b.leaves || (a.goals.is_single() && b.goals.is_single())) return false;
  return model_.contacts().overlap(instance.class_of(i), end_of(i).goal, instance.class_of(j),
                                   end_of(j).goal);
}

bool ContinuousDomain::note_collision(const Encounter& e, const PathTrail& trail,
                                      FormulaWriter& writer) {
  pair_lemmas_.set_path_effort(search_.effort());
  const auto party = [&](AgentId i) { return PairLemmas::Party{i, trail.cap(i), trail.active(i)}; };
  return pair_lemmas_.note_collision(party(e.first), party(e.second), writer);
}

}  // namespace quadrille::continuous
