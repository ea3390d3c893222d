// SPDX-License-Identifier: MIT
#include "quadrille/sat/cost_search.hpp"

#include "quadrille/core/contract.hpp"

namespace quadrille::sat {

SearchReport search_upwards(Engine& engine, BoundedProblem& problem, LimitMonitor& limits,
                            const BoundListener& on_bound) {
  SearchReport report{SearchReport::End::stopped, problem.lower_bound()};
  std::vector<Lit> assumptions;
  while (true) {
    if (on_bound) on_bound(report.lower_bound);
    assumptions.clear();
    if (limits.exhausted_now() || !problem.assume_at_most(report.lower_bound, limits, assumptions))
      return report;
    Verdict verdict = engine.solve(assumptions, limits);
    while (verdict == Verdict::sat && !problem.accept_model())
      verdict = engine.solve(assumptions, limits);
    if (verdict == Verdict::unknown) return report;
    if (verdict == Verdict::sat) {
      report.end = SearchReport::End::found;
      return report;
    }
    const std::vector<Lit> core = engine.core();
    if (core.empty()) {
      report.end = SearchReport::End::exhausted;
      return report;
    }
    const Cost next = problem.next_bound(report.lower_bound, core);
    QUADRILLE_REQUIRE(next >= report.lower_bound, "bounds only grow");
    report.lower_bound = next;
  }
}

}  // namespace quadrille::sat
