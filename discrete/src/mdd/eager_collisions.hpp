// SPDX-License-Identifier: MIT
#pragma once

#include "mdd/cell_table.hpp"
#include "mdd/collisions.hpp"
#include "mdd/mdd_model.hpp"

namespace quadrille::discrete {

/// Writes all collision clauses of an MddModel before solving, as MDD-SAT does.
class EagerCollisions {
 public:
  /// `model` outlives this.
  explicit EagerCollisions(const MddModel& model);
  /// Writes the clauses over variables made since the last call, and older ones. False if `limits`
  /// ended that early.
  [[nodiscard]] bool extend(sat::Engine& engine, LimitMonitor& limits);

 private:
  void add_ends(sat::Lit end, const MddModel::Variable& var, const CollisionClauses::Sink& sink);
  void add_swaps(sat::Lit x, const MddModel::Variable& var, const CollisionClauses::Sink& sink);
  /// True if all clauses of literals with smaller variables are written, those of `lit` included.
  [[nodiscard]] bool is_known(sat::Lit lit, sat::Lit newest) const {
    return lit.valid() && lit.variable() <= newest.variable();
  }

  const MddModel& model_;
  CollisionClauses clauses_;
  CellTable<std::vector<sat::Lit>> users_;  // X literals of each cell, written ones only
  int written_end_ = 1;
};

}  // namespace quadrille::discrete
