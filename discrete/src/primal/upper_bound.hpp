// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

#include "primal/plan_repair.hpp"
#include "quadrille/discrete/primal.hpp"

namespace quadrille::discrete {

/// The best plan known while a search raises the lower bound. Works in slices. These, and what the
/// search did since the last one, are counted in elementary steps, never by clocks, so that all
/// stays deterministic. Slices get a share of the time that becomes smaller while they find
/// nothing. Half of each goes to the best plan, half to a rival made of the search's current paths.
class UpperBound {
 public:
  UpperBound(const Instance& instance, Objective objective,
             std::shared_ptr<const GoalDistances> distances, std::uint32_t seed);

  /// Looks for a first plan for a while. To be called until it returns false: there is a plan, or
  /// it is hard to find and others should have their turn.
  [[nodiscard]] bool start(LimitMonitor& limits);
  /// To be called often with the steps of the search so far; true if the best plan is cheaper now.
  /// `draft` tells the paths that the search has at the moment, see Run::draft.
  bool advance(std::int64_t search_effort, const std::function<Plan()>& draft,
               LimitMonitor& limits);

  /// Keeps this plan if it is the cheapest.
  void take(const Plan& plan);

  /// Of the best plan; nullopt if there is none.
  [[nodiscard]] std::optional<Cost> cost() const;
  /// Requires a plan.
  [[nodiscard]] const Plan& plan() const { return improver_->plan(); }

 private:
  bool work(const Plan& draft, LimitMonitor& limits);
  /// Makes a plan of the search's paths, which cost little, and improves it for a while.
  void try_draft(const Plan& draft, LimitMonitor& limits);
  void take_first_plan();

  const Instance& instance_;
  const Objective objective_;
  const std::shared_ptr<const GoalDistances> distances_;
  const std::uint32_t seed_;
  PrimalSearch first_;
  std::optional<PlanImprover> improver_;
  PlanRepair repair_;
  std::optional<PlanImprover> rival_;  // of plans made of drafts
  std::int64_t share_;                 // the search gets so many times the effort of a slice
  std::int64_t due_;                   // search effort
  std::int64_t start_effort_ = 0;
  std::int64_t extra_effort_ = 0;  // of the last slice, for its draft
};

}  // namespace quadrille::discrete
