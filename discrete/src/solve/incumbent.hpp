// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "quadrille/discrete/plan.hpp"
#include "quadrille/sat/bounds.hpp"
#include "solve/run.hpp"

namespace quadrille::discrete {

/// The bounds of a solve, with the cheapest plan that any strategy has found. For the makespan the
/// sum of costs breaks ties.
class Incumbent final : public sat::Bounds {
 public:
  explicit Incumbent(Objective objective) : objective_(objective) {}

  /// Keeps `plan`, which has to be valid, if it is the cheapest; true if so. O(agents), and a copy.
  bool offer(const Plan& plan);
  /// Requires one.
  [[nodiscard]] const Plan& plan() const { return plan_.value(); }

  /// Whose accepted models become plans from now on; null: nobody's.
  void set_run(const Run* run) noexcept { run_ = run; }
  void offer_accepted() override { offer(run_->plan()); }
  [[nodiscard]] std::optional<Cost> upper() const override { return cost_; }
  [[nodiscard]] Cost incumbent_cost_of(AgentId agent) const override {
    return arrival(plan().paths[agent]);
  }

 private:
  const Objective objective_;
  const Run* run_ = nullptr;
  std::optional<Plan> plan_;
  std::optional<Cost> cost_;
  Cost sum_ = 0;
};

}  // namespace quadrille::discrete
