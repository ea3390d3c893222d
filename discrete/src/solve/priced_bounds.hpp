// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "feasibility/goal_reach.hpp"
#include "solve/incumbent.hpp"

namespace quadrille::discrete {

/// The bounds of a search whose costs include prices of goals, which all plans pay.
class PricedBounds final : public sat::Bounds {
 public:
  /// Both outlive it.
  PricedBounds(Incumbent& incumbent, const PricedGoals& goals)
      : incumbent_(incumbent), goals_(goals) {
    raise(incumbent.lower() + goals.paid);
  }

  /// The incumbent learns the lower bound.
  void share() noexcept { incumbent_.raise(lower() - goals_.paid); }

  [[nodiscard]] std::optional<Cost> upper() const override {
    const std::optional<Cost> cost = incumbent_.upper();
    return cost ? std::optional<Cost>(*cost + goals_.paid) : std::nullopt;
  }
  [[nodiscard]] Cost incumbent_cost_of(AgentId agent) const override {
    const VertexId goal = incumbent_.plan().paths[agent].back();
    return incumbent_.incumbent_cost_of(agent) + (*goals_.prices)[goal];
  }
  void offer_accepted() override { incumbent_.offer_accepted(); }

 private:
  Incumbent& incumbent_;
  const PricedGoals& goals_;
};

}  // namespace quadrille::discrete
