// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "cost/excess_counter.hpp"
#include "quadrille/core/random.hpp"
#include "quadrille/sat/cost_search.hpp"
#include "quadrille/sat/strategy.hpp"

namespace quadrille::sat {

/// Large neighbourhood search over costs, not over paths: all but some agents may cost what they
/// cost in the incumbent, and the sum has to fall.
class CostNeighbourhoods final : public Strategy {
 public:
  /// Both outlive it.
  CostNeighbourhoods(const CostSearchContext& context, ExcessCounter& counter);

  /// `found` never: a plan that proves to be optimal closes the bounds.
  [[nodiscard]] Outcome advance(Slice slice) override;

 private:
  const CostSearchContext context_;
  ExcessCounter& counter_;
  Random random_{1};
  std::size_t num_free_;  // agents of a neighbourhood that may cost anything
};

}  // namespace quadrille::sat
