// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mdd/cell_table.hpp"
#include "mdd/collisions.hpp"
#include "mdd/mdd_model.hpp"
#include "quadrille/core/effort.hpp"
#include "quadrille/discrete/solver.hpp"
#include "quadrille/sat/theory.hpp"

namespace quadrille::discrete {

/// Keeps agents apart inside the SAT search: the theory of DPLL(MAPF) (Capek and Surynek 2021,
/// SoCS) over the literals of an MddModel.
///
/// Literals on the engine's stack are *entered* into a table of who is where, in order; what each
/// one collides with among those before it is found in O(degree) then. The check schedule decides
/// when that happens. Complete assignments are checked on the paths that they contain.
class CollisionTheory final : public sat::Theory {
 public:
  /// `model` outlives the theory. It may be extended between solves, followed by `on_extended`.
  CollisionTheory(const MddModel& model, const CheckSchedule& schedule);

  /// To be called before a solve after the model was extended.
  void on_extended();
  /// For each literal that was announced.
  [[nodiscard]] Effort effort() const noexcept override {
    return num_announced_ * Effort::nanoseconds(2500);
  }
  /// Times the consistency of an assignment was looked at.
  [[nodiscard]] std::int64_t num_checks() const noexcept { return num_checks_; }

  void on_assign(std::span<const sat::Lit> newly_true) override;
  void on_retract(std::size_t kept) override;
  void check(sat::Extent extent, sat::TheoryContext& context) override;
  sat::Lemma explain(sat::Lit implied, std::vector<sat::Lit>& clause) override;

 private:
  struct Entered {
    sat::Lit lit;
    sat::Lit previous;  // what the table had in its place; not of X literals: invalid
  };
  /// True if the schedule asks for a look at a partial assignment now.
  [[nodiscard]] bool is_due(const sat::TheoryContext& context);
  /// Number of fractions of the schedule that `assigned` of `variables` reaches.
  [[nodiscard]] std::size_t stage(std::size_t assigned, std::size_t variables) const;
  void enter_all(sat::TheoryContext& context);
  /// Looks for collisions of what agents do from their starts on, as far as that is known. X
  /// literals that are true besides are left over from other assignments: a model may have any
  /// number of them, and no path uses them.
  void check_walks(sat::TheoryContext& context);
  /// Undoes `enter` of all but the first `kept`.
  void leave(std::size_t kept);
  void enter(sat::Lit x, sat::TheoryContext& context);
  void enter_early_rest(sat::Lit not_late, sat::TheoryContext& context);
  void enter_end(const MddModel::Variable& var, sat::TheoryContext& context);
  /// Not both x, of a vertex, and the end of a resident there, if that is where it ends.
  void keep_out(sat::Lit x, AgentId resident, sat::TheoryContext& context);
  void find_swaps(sat::Lit x, const MddModel::Variable& var, const CollisionClauses::Sink& sink);
  /// An agent that leaves is at its goal in the model, but is known to have left.
  [[nodiscard]] bool is_gone(sat::Lit x, const sat::TheoryContext& context) const;
  void deny_others(sat::Lit x, const MddModel::Variable& var, sat::TheoryContext& context);
  void check_paths(sat::TheoryContext& context);

  const MddModel& model_;
  CheckSchedule schedule_;
  CollisionClauses clauses_;
  std::vector<sat::Lit> stack_;
  std::vector<Entered> entered_;             // a prefix of stack_; with fractions nobody for long
  CellTable<sat::Lit> occupant_;             // the last entered X literal of each cell
  CellTable<std::vector<sat::Lit>> rivals_;  // propagate: all X literals of each cell
  int rivals_end_ = 0;                       // variables below are in rivals_
  std::vector<sat::Lit> reason_;             // propagate: by variable, the X that denies it
  std::array<sat::Usage, 2> reason_usages_;  // of the last explanation
  std::size_t stages_done_ = 0;
  std::size_t num_variables_ = 1;
  std::int64_t num_checks_ = 0, num_announced_ = 0;
};

}  // namespace quadrille::discrete
