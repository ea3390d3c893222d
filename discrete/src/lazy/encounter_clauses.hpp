// SPDX-License-Identifier: MIT
#pragma once

#include <set>
#include <span>
#include <vector>

#include "lazy/lazy_model.hpp"
#include "paths/corridors.hpp"
#include "paths/path_index.hpp"

namespace quadrille::discrete {

/// Turns collisions of current paths into clauses over usage literals, the widest that are known to
/// hold. A collision with an agent at rest excludes its goal for ever, or that two agents end
/// there; one where two paths cross, the crossing of a whole rectangle; one in a corridor, that
/// both pass it in these times.
class EncounterClauses {
 public:
  /// Both outlive the object.
  EncounterClauses(LazyModel& model, const PathIndex& paths)
      : model_(model), paths_(paths), corridors_(model.instance().graph()) {}

  /// Writes the clause "not all of these usages are allowed", which excludes the encounter, unless
  /// it was written before, and returns the usages. `cap`: the most that the first agent may cost;
  /// kForever if there is no such bound.
  std::vector<ObstacleId> exclude(const Encounter& encounter, Timestep cap, FormulaWriter& writer);

 private:
  /// Each returns nothing if it does not apply.
  std::vector<ObstacleId> exclude_corridor(const Encounter& encounter, FormulaWriter& writer);
  std::vector<ObstacleId> exclude_rectangle(const Encounter& encounter, FormulaWriter& writer);
  /// Without the window of an agent that is there whatever it does.
  std::vector<ObstacleId> exclude_windows(const Encounter& encounter, FormulaWriter& writer);
  void write(std::vector<ObstacleId>& usages, const sat::Why& why, FormulaWriter& writer);

  LazyModel& model_;
  const PathIndex& paths_;
  Corridors corridors_;
  std::set<std::vector<ObstacleId>> written_;
};

}  // namespace quadrille::discrete
