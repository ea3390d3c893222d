// SPDX-License-Identifier: MIT
#include "cost/excess_counter.hpp"

#include "quadrille/core/contract.hpp"
#include "quadrille/sat/proof_log.hpp"

namespace quadrille::sat {
namespace {

/// A totalizer of n inputs that counts up to k has about n k^2 / 2 clauses, and nothing interrupts
/// it while it grows.
Cost largest_excess(std::size_t num_inputs) {
  constexpr Cost kMaxSize = 2'000'000, kLeast = 8;
  Cost k = kLeast;
  while (static_cast<Cost>(num_inputs) * (k + 1) * (k + 1) <= kMaxSize) ++k;
  return k;
}

}  // namespace

ExcessCounter::ExcessCounter(Engine& engine, Cost base, std::size_t num_inputs,
                             Totalizer::Input excess)
    : engine_(engine),
      base_(base),
      largest_(base + largest_excess(num_inputs)),
      total_(engine, num_inputs, std::move(excess)) {}

Lit ExcessCounter::above(Cost cost) {
  QUADRILLE_REQUIRE(cost >= base_ && cost <= largest_, "the counter reaches so far");
  const Lit lit = total_.at_least(static_cast<int>(cost - base_) + 1);
  QUADRILLE_REQUIRE(lit.valid(), "an agent's cost has no end");
  return lit;
}

void ExcessCounter::note_bound(Cost bound) {
  if (engine_.proof() != nullptr)
    engine_.proof()->claim_by_excess(proof_number(), bound, above(bound - 1));
}

}  // namespace quadrille::sat
