// SPDX-License-Identifier: MIT
#include "cost/core_counter.hpp"

#include <array>
#include <utility>

#include "quadrille/sat/proof_log.hpp"

namespace quadrille::sat {

CoreCounter::CoreCounter(Engine& engine, int height, Level level)
    : engine_(engine), height_(height), level_(std::move(level)) {
  if (engine_.proof() != nullptr) proof_number_ = engine_.proof()->add_counter();
}

Totalizer& CoreCounter::counter(int level) {
  while (counters_.size() < static_cast<std::size_t>(level)) {
    const auto lits = level_(static_cast<int>(counters_.size()) + 1);
    // The inputs are literals: numbers of 0 or 1.
    counters_.emplace_back(engine_, lits.size(), [lits](std::size_t input, int k) {
      return k == 1 ? lits[input] : Lit();
    });
    ProofLog* const proof = engine_.proof();
    if (proof == nullptr) continue;
    std::vector<ProofItem> items(lits.size());
    for (std::size_t at = 0; at < lits.size(); ++at) items[at].literal = lits[at];
    proof->set_inputs(counters_.back().proof_number(), std::move(items));
    proof->add_level(proof_number_, counters_.back().proof_number());
  }
  return counters_[static_cast<std::size_t>(level) - 1];
}

Lit CoreCounter::at_least(int level, int count) {
  if (level > height_) return {};
  int& reached = reached_[count];
  for (; reached < level; ++reached) {
    const Lit lit = counter(reached + 1).at_least(count);
    if (!lit.valid()) return {};
    if (reached == 0) continue;
    const std::array order{~lit, counter(reached).at_least(count)};
    engine_.add_clause({why::Counter{}, order, {}, false});
  }
  return counter(level).at_least(count);
}

/// The lower levels first: they follow from the higher ones.
void CoreCounter::retire() {
  for (Totalizer& counter : counters_) counter.retire();
}

}  // namespace quadrille::sat
