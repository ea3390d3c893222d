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
/// hold: rests forbid a goal for ever, crossings a whole
/// rectangle, meetings in a corridor either passage.
class EncounterClauses {
 public:
  /// Both outlive the object.
  EncounterClauses(LazyModel& model, const PathIndex& paths)
      : model_(model), paths_(paths), corridors_(model.instance().graph()) {}

  /// Writes what excludes the encounter, unless that was written before: not all of the usages that
  /// are returned are allowed. `cap` is what the first agent may cost at most, kForever if
  /// anything.
  std::vector<ObstacleId> exclude(const Encounter& encounter, Timestep cap, FormulaWriter& writer);

 private:
  /// Each returns nothing if it does not apply.
  std::vector<ObstacleId> exclude_corridor(const Encounter& encounter, FormulaWriter& writer);
  std::vector<ObstacleId> exclude_rectangle(const Encounter& encounter, FormulaWriter& writer);
  void write(std::vector<ObstacleId>& usages, FormulaWriter& writer);

  LazyModel& model_;
  const PathIndex& paths_;
  Corridors corridors_;
  std::set<std::vector<ObstacleId>> written_;
};

}  // namespace quadrille::discrete
