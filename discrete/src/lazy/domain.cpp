// SPDX-License-Identifier: MIT
#include "lazy/domain.hpp"

#include <algorithm>

#include "quadrille/core/contract.hpp"

namespace quadrille::discrete {

DiscreteDomain::DiscreteDomain(LazyModel& model, LimitMonitor& limits, ExplicitPaths::Price price)
    : model_(model),
      limits_(limits),
      paths_(model.instance()),
      trailed_paths_(paths_, model),
      search_(model, paths_, limits),
      clauses_(model, paths_),
      explicit_paths_(model, price) {
  set_free_paths();
}

void DiscreteDomain::set_free_paths() {
  for (const AgentId i : model_.instance().agent_ids()) {
    const Path* path = search_.find_cheapest(i, {}, model_.distances(i).free_cost()).path();
    QUADRILLE_REQUIRE(path != nullptr, "nothing hinders an agent that is alone");
    paths_.replace(i, *path);
  }
  LazyTrail free_costs(trailed_paths_, num_agents(), lazy::kNoCap);
  for (const AgentId i : model_.instance().agent_ids())
    free_costs.lower_cap(i, model_.free_cost(i));
  Separation separation(paths_, free_costs, search_, limits_);
  constexpr int kRounds = 3;
  for (int round = 0; round < kRounds && !limits_.exhausted_now() && separation.bypass_all();
       ++round) {
  }
}

Plan DiscreteDomain::plan() const {
  Plan plan;
  for (const AgentId i : model_.instance().agent_ids()) plan.paths.push_back(paths_.path(i));
  return plan;
}

void DiscreteDomain::on_explained(const lazy::Explanation& lemma, const LazyTrail& trail,
                                  FormulaWriter& writer) {
  decisions_.on_path_lemma(lemma.clause);
  explicit_paths_.on_path_lemma(lemma.agent, cap_of(trail, lemma.agent), writer);
}

void DiscreteDomain::before_conflicts(LazyTrail& trail) {
  Separation parting = separation(trail);
  while (!limits_.exhausted_now() && parting.bypass_all()) {
  }
}

std::vector<Encounter> DiscreteDomain::conflicts(LazyTrail& trail) {
  std::vector<Encounter> collisions = separation(trail).collisions();
  std::stable_sort(collisions.begin(), collisions.end(),
                   [](const Encounter& a, const Encounter& b) { return a.timestep < b.timestep; });
  return collisions;
}

}  // namespace quadrille::discrete
