// SPDX-License-Identifier: MIT
#include "descent.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "quadrille/core/contract.hpp"

namespace quadrille::sat {
namespace {

/// Measured on open maps: plans at the optimum are found as fast as plans well above it. A bound
/// that is too low costs a turn or, at best, raises the lower bound.
constexpr Cost kFirstStep = 8;

/// A totalizer of n inputs that counts up to k has about n k^2 / 2 clauses, and nothing interrupts
/// it while it grows.
Cost largest_excess(std::size_t num_inputs) {
  constexpr Cost kMaxSize = 2'000'000;
  Cost k = kFirstStep;
  while (static_cast<Cost>(num_inputs) * (k + 1) * (k + 1) <= kMaxSize) ++k;
  return k;
}

}  // namespace

Descent::Descent(Engine& engine, AgentCostProblem& problem, PlanStore& plans, LimitMonitor& limits,
                 Cost base, std::size_t num_inputs, Totalizer::Input excess)
    : engine_(engine),
      problem_(problem),
      plans_(plans),
      limits_(limits),
      base_(base),
      max_excess_(largest_excess(num_inputs)),
      excess_(engine, num_inputs, std::move(excess)),
      max_step_(kFirstStep) {}

Cost Descent::advance(Cost lower_bound, std::int64_t conflicts) {
  const std::int64_t end = limits_.conflicts() + conflicts;
  while (limits_.conflicts() < end && !limits_.exhausted_now()) {
    Cost target = std::min(lower_bound + max_step_, base_ + max_excess_);
    if (const auto best = plans_.best_cost()) target = std::min(target, *best - 1);
    if (target < lower_bound) break;
    const Lit dearer = excess_.at_least(static_cast<int>(target - base_) + 1);
    QUADRILLE_REQUIRE(dearer.valid(), "an agent's cost has no end");
    const std::array assumptions{~dearer};
    problem_.on_solve(true);
    Verdict verdict;
    do {
      const std::int64_t rest =
          std::clamp<std::int64_t>(end - limits_.conflicts(), 1, std::numeric_limits<int>::max());
      verdict = engine_.solve(assumptions, limits_, {static_cast<int>(rest), {}});
    } while (verdict == Verdict::sat && !problem_.accept_model());
    if (verdict == Verdict::sat) {
      plans_.take_accepted();
    } else if (verdict == Verdict::unsat) {
      lower_bound = target + 1;
    } else {
      max_step_ *= 2;
      break;
    }
  }
  return lower_bound;
}

}  // namespace quadrille::sat
