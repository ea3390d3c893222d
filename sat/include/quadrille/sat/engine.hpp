// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "quadrille/core/effort.hpp"
#include "quadrille/core/export.hpp"
#include "quadrille/core/limits.hpp"
#include "quadrille/core/statistics.hpp"
#include "quadrille/sat/derivation.hpp"
#include "quadrille/sat/lemma.hpp"
#include "quadrille/sat/theory.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::sat {

class ProofLog;

enum class Verdict { sat, unsat, unknown };

struct EngineOptions {
  std::uint32_t seed = 0;      ///< Of the solver's random choices, 0 .. 2'000'000'000.
  bool initial_phase = false;  ///< The value that the solver tries first for a variable.
  /// Let clauses that imply something at an earlier level leave later decisions alone, and long
  /// jumps back be short. Otherwise the solver goes back to where each clause takes effect.
  bool chronological = true;
  /// Let the variables that implied those of a learned clause count as active, too.
  bool bump_reasons = true;
  /// What a conflict takes, besides the work of the theory: the more, the larger the formulas.
  Effort effort_of_conflict = Effort::microseconds(375);
  bool inprocessing = false;  ///< Let the solver rewrite the formula between conflicts.
  bool keep_clauses = false;  ///< For Engine::take_clauses.
  /// Hears every clause; null: nobody. Must outlive the engine.
  ClauseObserver* observer = nullptr;
  /// Hears how the solver comes to its clauses; null: nobody, and the solver keeps no account of
  /// it. The search is the same. Must outlive the engine.
  DerivationObserver* derivations = nullptr;
  /// What counters and searches that use the engine tell of themselves, see Engine::proof; null:
  /// they do not. To be set as `observer` and `derivations`, too.
  ProofLog* proof = nullptr;
};

/// Limits of one call of solve, besides those of the LimitMonitor. Meeting one gives `unknown`.
struct SolveBudget {
  std::optional<int> conflicts = std::nullopt;
  std::optional<int> decisions = std::nullopt;
  std::optional<Effort> effort = std::nullopt;  ///< Ends the solve soon after that.
};

/// The DPLL(MAPF) engine: an incremental SAT solver that consults a theory while it searches.
/// Deterministic for given calls and seed. One thread.
class Engine {
 public:
  /// `theory` may be null (plain SAT solving); otherwise it outlives the engine.
  explicit Engine(Theory* theory, const EngineOptions& options = {});
  ~Engine();
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  /// A new variable's positive literal. Not during solve: see TheoryContext::new_lit.
  [[nodiscard]] Lit new_lit();
  /// Adds a clause for good. Not during solve: see TheoryContext::add_lemma.
  void add_clause(const Lemma& lemma);
  /// Which value the solver tries first for the variable of `lit`: `lit` true.
  void set_phase(Lit lit);
  void clear_phase(Lit lit);

  /// Searches for an assignment that satisfies all clauses, the assumptions and the theory.
  /// `unknown` only when `limits` or `budget` ended the search. Throws what theory and observer
  /// throw, and std::bad_alloc; then there is no verdict, and the engine must not solve again.
  [[nodiscard]] Verdict solve(std::span<const Lit> assumptions, LimitMonitor& limits,
                              const SolveBudget& budget = {});
  /// Requires that the last verdict was sat and a literal that is older than that verdict. Clauses
  /// may have been added since.
  [[nodiscard]] bool model_value(Lit lit) const;
  /// Requires that the last verdict was unsat. Some of its assumptions that cannot hold together,
  /// in the order in which they were given; empty if the clauses alone are unsatisfiable.
  [[nodiscard]] std::vector<Lit> core() const;

  /// Of the engine and its theory so far.
  [[nodiscard]] Effort effort() const;
  /// Variables so far: 1 to this number.
  [[nodiscard]] int num_variables() const;
  /// All clauses that the engine was given since the last call, lemmas of the theory included, each
  /// ended by no literal. Requires EngineOptions::keep_clauses. Not during solve.
  [[nodiscard]] std::vector<Lit> take_clauses();

  /// EngineOptions::proof.
  [[nodiscard]] ProofLog* proof() const noexcept { return proof_; }

  /// Adds what this engine did to `statistics` (sat_calls, conflicts, decisions, variables,
  /// clauses, collision_clauses, models_checked).
  void add_statistics(Statistics& statistics) const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
  ProofLog* const proof_;
};

}  // namespace quadrille::sat

QUADRILLE_API_END
