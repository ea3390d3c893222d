// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "quadrille/continuous/instance.hpp"
#include "quadrille/continuous/plan.hpp"
#include "quadrille/core/limits.hpp"
#include "traffic/scene.hpp"

namespace quadrille::continuous {

/// Prices of goals that agents share, as a part of the roadmap: with them the least costs of all
/// agents, each alone, come to what a cheapest assignment of goals costs.
///
/// Who ends at a goal with a price makes one more move, in place, to a vertex that nothing leads
/// out of. The move takes as long as the price, and no one is elsewhere for it at any moment: so
/// the plans of both instances are the same, but for costs (docs/soundness/continuous.md).
class PricedGoals {
 public:
  /// nullopt where prices change nothing, or if a limit was met. Requires that the instance begins
  /// at 0.
  [[nodiscard]] static std::optional<PricedGoals> make(const Instance& instance,
                                                       LimitMonitor& limits);

  /// With prices. The ids of agents, and of vertices that both have, are the same.
  [[nodiscard]] const Instance& instance() const noexcept { return *priced_; }
  /// All prices. In every plan agents pay those of the goals at which somebody ends, and the others
  /// are fees.
  [[nodiscard]] Cost paid() const noexcept { return paid_; }
  /// Of goals that plans need not use.
  [[nodiscard]] const std::vector<Fee>& fees() const noexcept { return fees_; }

  /// Makes a plan of the instance one of that with prices, of the same arrivals at goals.
  void enter(Plan& plan) const;
  /// And back: the costs less prices are no higher, because nobody waits at a goal for the move.
  void leave(Plan& plan) const;

 private:
  /// What a goal costs, and the vertex where whoever has paid is.
  struct Price {
    VertexId goal, end;
    Ticks ticks;
  };
  PricedGoals() = default;
  /// Null if the goal has none.
  [[nodiscard]] const Price* find(VertexId goal) const;
  /// False where the rules of instances do not allow for it.
  [[nodiscard]] bool build(const Instance& instance);

  std::vector<Price> prices_;  // by goal, increasing
  std::optional<Instance> priced_;
  std::vector<Fee> fees_;
  Cost paid_ = 0;
};

}  // namespace quadrille::continuous
