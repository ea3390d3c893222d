// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "primal/plan_repair.hpp"
#include "quadrille/discrete/primal.hpp"
#include "quadrille/sat/strategy.hpp"
#include "solve/incumbent.hpp"
#include "solve/marginal_gain.hpp"

namespace quadrille::discrete {

/// What the strategies that look for plans work with. All outlive them.
struct PlanSearchContext {
  const Instance& instance;
  std::shared_ptr<const GoalDistances> distances;
  Objective objective = Objective::sum_of_costs;
  std::uint32_t seed = 0;
  Incumbent& incumbent;
  LimitMonitor& limits;
};

/// Looks for a plan of any cost.
class FirstPlan final : public sat::Strategy {
 public:
  explicit FirstPlan(const PlanSearchContext& context)
      : context_(context), search_(context.instance, context.distances, context.seed) {}

  /// Requires a slice with effort.
  [[nodiscard]] sat::Outcome advance(sat::Slice slice) override;

 private:
  const PlanSearchContext context_;
  PrimalSearch search_;
};

/// Makes the incumbent cheaper by large-neighbourhood search; and a rival of it, which is made of
/// the paths of the search from below: these cost little and collide in places.
class PlanImprovement final : public sat::Strategy {
 public:
  explicit PlanImprovement(const PlanSearchContext& context)
      : context_(context), repair_(context.instance, context.distances, context.seed) {}

  /// Paths for the next slice, which may collide; no paths: none.
  void set_draft(Plan draft) { draft_ = std::move(draft); }
  /// Requires an incumbent, and a slice with effort: so much for the incumbent, and so much again
  /// for a rival if there is a draft. What the draft itself costs comes on top, twice.
  [[nodiscard]] sat::Outcome advance(sat::Slice slice) override;
  /// What the last slice did beyond its effort.
  [[nodiscard]] std::int64_t extra_effort() const noexcept { return extra_effort_; }
  /// The draft of the last slice became the incumbent.
  [[nodiscard]] bool draft_was_good() const noexcept { return draft_was_good_; }

 private:
  void improve_draft(std::int64_t effort);

  const PlanSearchContext context_;
  PlanRepair repair_;
  std::optional<PlanImprover> improver_, rival_;
  Plan draft_;
  std::int64_t extra_effort_ = 0;
  bool draft_was_good_ = false;
};

/// The schedule of both beside a search that raises the lower bound. Slices, and what the search
/// did since the last one, are counted in elementary steps, never by clocks, so that all stays
/// deterministic.
class PlanSearch {
 public:
  explicit PlanSearch(const PlanSearchContext& context);

  /// Looks for a first plan for a while. To be called until it returns false: there is a plan, or
  /// it is hard to find and others should have their turn.
  [[nodiscard]] bool start();
  /// To be called often with the steps of the search so far. `draft` tells the paths that the
  /// search had at last, see Run::draft.
  void advance(std::int64_t search_effort, const std::function<Plan()>& draft);

 private:
  void count_search(std::int64_t search_effort);
  void take_turn(const std::function<Plan()>& draft);

  const PlanSearchContext context_;
  FirstPlan first_plan_;
  PlanImprovement improvement_;
  MarginalGain gain_;
  std::int64_t slice_;
  std::int64_t credit_ = 0;       // steps for plans that are due
  std::int64_t seen_effort_ = 0;  // of the search, counted
  Cost seen_lower_ = 0;
  std::optional<Cost> seen_upper_;
  std::int64_t effort_to_draft_, draft_wait_ = 1;
  std::int64_t start_effort_ = 0;
};

}  // namespace quadrille::discrete
