// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <string_view>
#include <utility>

#include "quadrille/discrete/plan.hpp"
#include "quadrille/sat/bounds.hpp"
#include "solve/desk.hpp"
#include "solve/run.hpp"

namespace quadrille::discrete {

/// The bounds of a search: what it knows of plans, and the lower bound that follows from its own
/// cores, which it does not mix with what others tell. For the makespan the sum of costs breaks
/// ties between plans.
class Incumbent final : public sat::Bounds {
 public:
  /// `known` outlives it, has its plans, and learns its lower bound by `share` and in the end.
  Incumbent(Objective objective, Knowledge& known) : objective_(objective), known_(known) {
    if (known.plan) sum_ = known.plan->cost(Objective::sum_of_costs);
  }
  ~Incumbent() override { share(); }
  Incumbent(const Incumbent&) = delete;
  Incumbent& operator=(const Incumbent&) = delete;

  void share() noexcept { known_.raise(lower()); }
  /// Keeps `plan`, which has to be valid, if it is the cheapest; true if so. O(agents).
  /// `origin`: what the statistics tell of it if it is the first one; empty: what others told.
  bool offer(std::shared_ptr<const Plan> plan, std::string_view origin);
  bool offer(Plan plan, std::string_view origin) {
    return offer(std::make_shared<const Plan>(std::move(plan)), origin);
  }
  /// Requires one.
  [[nodiscard]] const Plan& plan() const { return *known_.plan; }
  /// The same. Plans may take gigabytes: whoever keeps one shares it.
  [[nodiscard]] const std::shared_ptr<const Plan>& shared_plan() const { return known_.plan; }

  /// Whose accepted models become plans from now on; null: nobody's.
  void set_run(const Run* run) noexcept { run_ = run; }
  void offer_accepted() override { offer(run_->plan(), "search"); }
  [[nodiscard]] std::optional<Cost> upper() const override { return known_.cost; }
  [[nodiscard]] Cost incumbent_cost_of(AgentId agent) const override {
    return arrival(plan().paths[agent]);
  }

 private:
  const Objective objective_;
  Knowledge& known_;
  const Run* run_ = nullptr;
  Cost sum_ = 0;
};

}  // namespace quadrille::discrete
