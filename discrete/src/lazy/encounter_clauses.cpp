// SPDX-License-Identifier: MIT
#include "lazy/encounter_clauses.hpp"

#include <algorithm>

#include "paths/rectangle.hpp"

namespace quadrille::discrete {

std::vector<ObstacleId> EncounterClauses::exclude(const Encounter& e, Timestep cap,
                                                  FormulaWriter& writer) {
  const auto& agents = model_.instance().agents();
  if (e.kind == Encounter::Kind::rest && paths_.path(e.second).back() == e.vertex &&
      !agents[e.second].leaves)
    return {model_.end(e.first, e.vertex, writer), model_.end(e.second, e.vertex, writer)};
  // The other one keeps off from `robust` timesteps before the rest on.
  const Timestep rest_from = e.second_timestep() + model_.instance().rules().robust;
  if (e.kind == Encounter::Kind::rest && cap - model_.price(e.vertex) <= rest_from &&
      !model_.distances(e.second).is_inevitable(e.vertex, e.second_timestep()))
    return {model_.keep_off_goal(e.second, e.first, {e.vertex, rest_from}, writer)};
  const bool may_widen = e.gap == 0 && agents[e.first].waypoints.empty() &&
                         agents[e.second].waypoints.empty() && !model_.instance().poses();
  if (e.kind != Encounter::Kind::rest && may_widen)
    if (auto usages = exclude_corridor(e, writer); !usages.empty()) return usages;
  if (e.kind == Encounter::Kind::swap)
    return {model_.edge(e.first, e.vertex, e.to, e.timestep, writer),
            model_.edge(e.second, e.vertex, e.to, e.timestep, writer)};
  if (e.kind == Encounter::Kind::vertex && may_widen)
    if (auto usages = exclude_rectangle(e, writer); !usages.empty()) return usages;
  return exclude_windows(e, writer);
}

std::vector<ObstacleId> EncounterClauses::exclude_windows(const Encounter& e,
                                                          FormulaWriter& writer) {
  std::vector<ObstacleId> usages;
  const Timestep first = std::min(e.timestep, e.second_timestep());
  for (const AgentId i : {e.first, e.second})
    if (!model_.distances(i).is_inevitable(e.vertex, first))
      usages.push_back(model_.window(i, e.vertex, first, writer));
  // Clauses about two come with the windows.
  if (usages.size() < 2) write(usages, sat::why::Vertex{}, writer);
  return usages;
}

std::vector<ObstacleId> EncounterClauses::exclude_corridor(const Encounter& e,
                                                           FormulaWriter& writer) {
  const auto exits =
      corridors_.find(model_.distances(e.first), model_.distances(e.second), paths_, e);
  if (!exits) return {};
  std::vector<ObstacleId> usages;
  for (const Corridors::Exit& exit : {exits->first, exits->second})
    usages.push_back(model_.range(exit.agent, exit.vertex, exit.first, exit.last, writer));
  write(usages, sat::why::Corridor{corridors_.is_inside(e.vertex) ? e.vertex : e.to}, writer);
  return usages;
}

std::vector<ObstacleId> EncounterClauses::exclude_rectangle(const Encounter& e,
                                                            FormulaWriter& writer) {
  const auto& layout = model_.instance().graph().layout();
  if (!layout) return {};
  const auto rectangle =
      find_rectangle(*layout, model_.distances(e.first), model_.distances(e.second), paths_, e);
  if (!rectangle) return {};
  std::vector<ObstacleId> usages;
  for (const Rectangle::Side& side : rectangle->sides)
    if (!side.inevitable) usages.push_back(model_.barrier(side.agent, side.visits, writer));
  write(usages, rectangle->why, writer);
  return usages;
}

void EncounterClauses::write(std::vector<ObstacleId>& ids, const sat::Why& why,
                             FormulaWriter& writer) {
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  if (!written_.insert(ids).second) return;
  std::vector<sat::Lit> clause;
  std::vector<sat::Usage> usages;
  for (const ObstacleId id : ids) {
    clause.push_back(~model_.obstacles()[id].allowed);
    usages.push_back({model_.obstacles()[id].agent, id.value()});
  }
  writer.add({why, clause, usages, false});
}

}  // namespace quadrille::discrete
