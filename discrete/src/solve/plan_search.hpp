// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "neighbourhoods/draft_repair.hpp"
#include "quadrille/core/effort.hpp"
#include "quadrille/discrete/plan_improver.hpp"
#include "quadrille/discrete/primal.hpp"
#include "quadrille/sat/strategy.hpp"
#include "solve/incumbent.hpp"
#include "solve/marginal_gain.hpp"
#include "solve/second_chance.hpp"

namespace quadrille::discrete {

/// What steps of those that make plans take, and how many there are in an effort. Measured: 200 to
/// 600 ns each, a quarter of one of the search for the bound.
[[nodiscard]] constexpr Effort effort_of_plans(std::int64_t steps) {
  return steps * Effort::nanoseconds(625) / 2;
}
[[nodiscard]] constexpr std::int64_t steps_of_plans(Effort effort) {
  return 2 * effort / Effort::nanoseconds(625);
}

/// What the strategies that look for plans work with. All outlive them.
struct PlanSearchContext {
  const Instance& instance;
  std::shared_ptr<const GoalDistances> distances;
  std::shared_ptr<const GoalDistances> priced_distances;  ///< The same, or with prices of goals.
  /// In which a first plan is looked for: the same where each agent has one goal, else with goals
  /// that were chosen. Null distances: there are none, and no first plan is looked for.
  const Instance& first_instance;
  std::shared_ptr<const GoalDistances> first_distances;
  Objective objective = Objective::sum_of_costs;
  std::uint32_t seed = 0;
  PrimalSearch::Part part = PrimalSearch::Part::all;  ///< Of the search for a first plan.
  Incumbent& incumbent;
  LimitMonitor& limits;
  const Settings& settings;
};

/// Looks for a plan of any cost.
class FirstPlan final : public sat::Strategy {
 public:
  explicit FirstPlan(const PlanSearchContext& context) : context_(context) {
    if (context.first_distances)
      search_.emplace(context.first_instance, context.first_distances, context.seed, context.part);
  }

  /// Requires a slice with effort.
  [[nodiscard]] sat::Outcome advance(sat::Slice slice) override;
  /// No plan comes any more, or no cheaper one.
  [[nodiscard]] bool is_over() const noexcept { return !search_ || search_->is_over(); }
  /// The searches that all begins with are not done.
  [[nodiscard]] bool is_at_guides() const noexcept { return search_ && search_->is_at_guides(); }
  /// See PrimalSearch.
  [[nodiscard]] bool is_worth_waiting_for() const noexcept {
    return search_ && search_->is_worth_waiting_for();
  }
  /// Of all slices; a slice may take more than it is given, because guides are not cut.
  [[nodiscard]] Effort effort() const noexcept {
    return search_ ? effort_of_plans(search_->effort()) : Effort();
  }

 private:
  const PlanSearchContext context_;
  std::optional<PrimalSearch> search_;
  std::optional<Cost> told_;  // What the plan costs that the incumbent was told of.
};

/// Makes the incumbent cheaper by large-neighbourhood search; and a rival of it, which is made of
/// the paths of the search from below: these cost little and collide in places.
class PlanImprovement final : public sat::Strategy {
 public:
  explicit PlanImprovement(const PlanSearchContext& context)
      : context_(context), repair_(context.instance, context.distances, context.seed) {}

  /// Tells where paths can be had that may collide, or none; they are taken when they are wanted.
  void offer_draft(const std::function<Plan()>& draft);
  /// Requires an incumbent, and a slice with effort. The incumbent, or a second chance instead of
  /// it, gets all of the slice (a quarter while the first draft is being repaired). A draft that is
  /// being repaired gets another slice, and when that is done the rival gets one more.
  [[nodiscard]] sat::Outcome advance(sat::Slice slice) override;
  /// The first draft is being repaired: what comes of it is a better incumbent than long
  /// improvement of a first plan makes, as a rule. Measured: 1,000 agents on
  /// warehouse-20-40-10-2-1, first plan 288,507; improved for 10 s 208,543; the draft repaired
  /// after 6 s 168,735. It is not all that is done, because on crowded maps it is dropped in the
  /// end.
  [[nodiscard]] bool is_at_first_draft() const noexcept {
    return num_drafts_ == 1 && repair_.is_at_work();
  }
  [[nodiscard]] bool has_second_chance() const noexcept {
    return second_chance_ && second_chance_->is_at_work();
  }
  /// What is under way shows its gain in the end only.
  [[nodiscard]] bool is_hopeful() const noexcept {
    return is_at_first_draft() || has_second_chance();
  }
  /// Of the last slice, in all.
  [[nodiscard]] Effort effort() const noexcept { return effort_; }

 private:
  bool improve(PlanImprover& improver, Effort effort);
  void take_second_chance(Effort effort);
  void improve_draft(Effort effort);

  const PlanSearchContext context_;
  DraftRepair repair_;
  std::optional<PlanImprover> improver_, rival_;
  std::optional<SecondChance> second_chance_;
  std::int64_t num_drafts_ = 0;
  Effort effort_;
};

/// The schedule of both beside a search that raises the lower bound: as much effort as their
/// marginal gain deserves.
class PlanSearch {
 public:
  explicit PlanSearch(const PlanSearchContext& context);

  /// Looks for a first plan for a while, then improves a dear one. To be called until it returns
  /// false: there is a plan that gains little any more, or it is hard to find and others should
  /// have their turn.
  [[nodiscard]] bool start();
  /// To be called often with the effort of the search so far. `draft` tells the paths that the
  /// search had at last, see Run::draft; null: they are for another one. `after_slice`, unless
  /// null, is called again and again.
  void advance(Effort search_effort, const std::function<Plan()>& draft,
               const std::function<void()>& after_slice);
  /// What others told has made the incumbent cheaper by `less`: nobody here gained that. 0 for the
  /// first incumbent.
  void hear(Cost less);
  /// For plans so far, first ones not counted.
  [[nodiscard]] Effort effort() const noexcept { return effort_; }
  /// Instead of both, where a search in another thread has all the time that it needs. First the
  /// guided searches, to the end.
  void begin();
  /// Then looks for plans for a while. `draft` as above. Returns what it counts for
  /// among threads.
  Effort work(const std::function<Plan()>& draft);

 private:
  void count_search(Effort search_effort);
  [[nodiscard]] bool is_first_plan_due() const;
  [[nodiscard]] Effort most_first_effort() const {
    return Effort::microseconds(context_.settings.plans_first_effort);
  }
  void improve_first_plan();

  const PlanSearchContext context_;
  FirstPlan first_plan_;
  PlanImprovement improvement_;
  MarginalGain gain_;
  Effort long_slice_;
  Effort credit_;       // for plans that is due
  Effort seen_effort_;  // of the search, counted
  Effort effort_;
  bool is_hopeful_ = false;  // credit is for the first draft
  // Of the improvement before the search.
  bool is_improvement_due_ = true;
  Effort next_look_;
  Cost gain_since_look_ = 0;
  Cost seen_lower_ = 0;
  std::optional<Cost> seen_upper_;
};

}  // namespace quadrille::discrete
