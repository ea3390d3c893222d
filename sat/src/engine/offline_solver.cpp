// SPDX-License-Identifier: MIT
#include "engine/offline_solver.hpp"

#include <vector>

#include "quadrille/sat/proof_log.hpp"

namespace quadrille::sat {
namespace {

EngineOptions offline_options(const Engine& engine) {
  EngineOptions options;
  if (engine.proof() != nullptr) options.derivations = &engine.proof()->offline();
  options.inprocessing = true;
  return options;
}

}  // namespace

OfflineSolver::OfflineSolver(Engine& engine)
    : source_(engine), solver_(nullptr, offline_options(engine)) {}

void OfflineSolver::catch_up() {
  // The same numbers mean the same variables.
  while (solver_.num_variables() < source_.num_variables()) static_cast<void>(solver_.new_lit());
  std::vector<Lit> clause;
  for (const Lit lit : source_.take_clauses()) {
    if (lit.valid()) {
      clause.push_back(lit);
      continue;
    }
    solver_.add_clause({why::Core{}, clause, {}, false});
    clause.clear();
  }
}

Verdict OfflineSolver::solve(std::span<const Lit> assumptions, LimitMonitor& limits,
                             const SolveBudget& budget) {
  catch_up();
  return solver_.solve(assumptions, limits, budget);
}

bool OfflineSolver::candidate_has(Lit lit) const {
  return lit.variable() <= solver_.num_variables() && solver_.model_value(lit);
}

void OfflineSolver::add_statistics(Statistics& statistics) const {
  Statistics own;
  solver_.add_statistics(own);
  statistics.sat_calls += own.sat_calls;
  statistics.conflicts += own.conflicts;
  statistics.decisions += own.decisions;
}

}  // namespace quadrille::sat
