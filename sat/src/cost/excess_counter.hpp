// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <utility>

#include "quadrille/core/outcome.hpp"
#include "quadrille/sat/totalizer.hpp"

namespace quadrille::sat {

/// Bounds what plans cost in all: `base` and the sum of some inputs, every agent's cost among them.
class ExcessCounter {
 public:
  /// Adds no clause yet. `engine` and what the inputs refer to outlive the counter.
  ExcessCounter(Engine& engine, Cost base, std::size_t num_inputs, Totalizer::Input excess);

  [[nodiscard]] Cost base() const noexcept { return base_; }
  /// The largest cost that `above` may be asked for: farther from the base the counter would have
  /// more than about a million clauses.
  [[nodiscard]] Cost largest() const noexcept { return largest_; }
  /// The literal "the plan costs more than `cost`". Requires base <= cost <= largest.
  [[nodiscard]] Lit above(Cost cost);
  [[nodiscard]] int proof_number() const noexcept { return total_.proof_number(); }
  /// Tells the proof log that no plan costs less than `bound`: the last verdict refuted the
  /// negation of `above(bound - 1)`.
  void note_bound(Cost bound);
  /// Ends its use, for good. Only destruction may follow.
  void retire() { total_.retire(); }

 private:
  Engine& engine_;
  const Cost base_, largest_;
  Totalizer total_;
};

}  // namespace quadrille::sat
