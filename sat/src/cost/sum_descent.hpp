// SPDX-License-Identifier: MIT
#pragma once

#include "cost/excess_counter.hpp"
#include "quadrille/sat/cost_search.hpp"
#include "quadrille/sat/strategy.hpp"

namespace quadrille::sat {

/// The search from above over all plans: asks for one that costs little more than the lower bound,
/// with a bound on the sum as the only assumption. A refutation raises the lower bound.
class SumDescent final : public Strategy {
 public:
  /// All outlive it.
  SumDescent(const CostSearchContext& context, ExcessCounter& counter)
      : context_(context), counter_(counter) {}

  [[nodiscard]] Outcome advance(Slice slice) override;

 private:
  const CostSearchContext context_;
  ExcessCounter& counter_;
  /// How far above the lower bound a plan is asked for. Measured on open maps: plans at the optimum
  /// are found as fast as plans well above it. A bound that is too low costs a slice or, at best,
  /// raises the lower bound.
  Cost step_ = 8;
};

}  // namespace quadrille::sat
