// SPDX-License-Identifier: MIT
#include "encounter_clauses.hpp"

#include <algorithm>
#include <array>

#include "rectangle.hpp"

namespace quadrille::discrete {

void EncounterClauses::exclude(const Encounter& e, Timestep cap, FormulaWriter& writer) {
  if (e.kind == Encounter::Kind::rest && cap <= e.timestep) {
    model_.keep_off_goal(e.second, e.first, e.timestep, writer);
    return;
  }
  if (e.kind != Encounter::Kind::rest && exclude_corridor(e, writer)) return;
  if (e.kind == Encounter::Kind::swap) {
    static_cast<void>(model_.edge(e.first, e.vertex, e.to, e.timestep, writer));
    static_cast<void>(model_.edge(e.second, e.vertex, e.to, e.timestep, writer));
    return;
  }
  if (e.kind == Encounter::Kind::vertex && exclude_rectangle(e, writer)) return;
  static_cast<void>(model_.point(e.first, {e.vertex, e.timestep}, writer));
  static_cast<void>(model_.point(e.second, {e.vertex, e.timestep}, writer));
}

bool EncounterClauses::exclude_corridor(const Encounter& e, FormulaWriter& writer) {
  const auto exits =
      corridors_.find(model_.distances(e.first), model_.distances(e.second), paths_, e);
  if (!exits) return false;
  const auto usage = [&](const Corridors::Exit& exit) {
    return model_.range(exit.agent, exit.vertex, exit.first, exit.last, writer);
  };
  write(std::array{usage(exits->first), usage(exits->second)}, writer);
  return true;
}

bool EncounterClauses::exclude_rectangle(const Encounter& e, FormulaWriter& writer) {
  const auto& layout = model_.instance().graph().layout();
  if (!layout) return false;
  const auto rectangle = find_rectangle(*layout, model_.distances(e.first),
                                        model_.distances(e.second), paths_, e);
  if (!rectangle) return false;
  std::vector<ObstacleId> usages;
  for (const Rectangle::Side& side : rectangle->sides)
    if (!side.inevitable) usages.push_back(model_.barrier(side.agent, side.visits, writer));
  write(usages, writer);
  return true;
}

void EncounterClauses::write(std::span<const ObstacleId> obstacles, FormulaWriter& writer) {
  std::vector<ObstacleId> ids(obstacles.begin(), obstacles.end());
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  if (!written_.insert(ids).second) return;
  std::vector<sat::Lit> clause;
  std::vector<sat::Usage> usages;
  for (const ObstacleId id : ids) {
    clause.push_back(~model_.obstacles()[id].allowed);
    usages.push_back({model_.obstacles()[id].agent, id.value()});
  }
  writer.add({sat::LemmaKind::collision, clause, usages, false});
}

}  // namespace quadrille::discrete
