// SPDX-License-Identifier: MIT
#include "solve/search.hpp"

#include <algorithm>
#include <functional>
#include <memory>
#include <new>
#include <optional>
#include <utility>

#include "primal/plan_merger.hpp"
#include "quadrille/core/free_bound.hpp"
#include "quadrille/core/internal_error.hpp"
#include "quadrille/core/progress.hpp"
#include "quadrille/discrete/goal_distances.hpp"
#include "quadrille/sat/cost_search.hpp"
#include "solve/incumbent.hpp"
#include "solve/plan_search.hpp"
#include "solve/run.hpp"

namespace quadrille::discrete {
namespace {

/// What the agents cost when each is alone.
Attribution free_charges(const Instance& instance, const GoalDistances& distances,
                         Objective objective) {
  Attribution attribution;
  attribution.objective = objective;
  for (const AgentId i : instance.agent_ids()) {
    const Cost cost = distances(i, instance.agents()[i].start);
    attribution.agents.push_back({cost, {}});
  }
  attribution.free_bound = free_bound(instance.agent_ids(), objective,
                                      [&](AgentId i) { return attribution.agents[i].free_cost; });
  return attribution;
}

/// One solve, with what all systems have in common: bounds from both sides.
class Search final : private sat::YieldPoint {
 public:
  Search(const Instance& instance, const SolveOptions& options, const Tuning& tuning,
         LimitMonitor& limits, SolveOutcome& outcome, Companion* companion)
      : instance_(instance),
        options_(options),
        tuning_(tuning),
        limits_(limits),
        outcome_(outcome),
        companion_(companion),
        role_(companion != nullptr ? companion->role() : Role::both),
        progress_(options.on_progress, options.progress_interval_s, limits),
        incumbent_(options.objective),
        known_(options.known_lower_bound.value_or(0)) {}

  void run() {
    incumbent_.raise(known_);
    if (options_.initial_plan) {
      Plan plan = *options_.initial_plan;
      trim(plan);
      incumbent_.offer(plan);
    }
    try {
      search();
    } catch (const LimitReached&) {
    } catch (const InternalError& error) {
      outcome_.internal_error = Error{ErrorCode::internal, error.message, {}};
    } catch (const std::bad_alloc&) {
      // The search's memory is free again: the bound and the best plan are the answer.
      outcome_.stop = StopReason::memory;
    }
    run_ = nullptr;
    if (!free_bound_) learn_free_bound(nullptr);
    outcome_.lower_bound = lower();
    outcome_.rests_on_known_bound = known_ > *free_bound_ && lower() <= known_;
    if (outcome_.internal_error || !incumbent_.upper()) return;
    if (*incumbent_.upper() < lower() && !is_bound_refuted()) {
      outcome_.internal_error = Error{ErrorCode::internal, "a plan costs less than the bound", {}};
      return;
    }
    outcome_.plan = incumbent_.plan();
    outcome_.status = incumbent_.upper() == lower() ? Status::optimal : Status::feasible;
  }

 private:
  void search() {
    enter(Phase::set_up);
    const auto distances = companion_ != nullptr ? companion_->distances(limits_)
                                                 : GoalDistances::make(instance_, limits_);
    learn_free_bound(distances.get());
    if (!distances) return;
    if (options_.explain)
      outcome_.attribution = free_charges(instance_, *distances, options_.objective);
    if (options_.first_plan) begin_plans(distances);
    if (role_ == Role::plans)
      look_for_plans();
    else if (!limits_.exhausted_now())
      search_costs(distances);
  }

  /// There is a plan that is cheaper than what the user knows; who called this tells that.
  [[nodiscard]] bool is_bound_refuted() const {
    return incumbent_.upper() && *incumbent_.upper() < known_;
  }

  /// Looks for a first plan, unless there is one, for as long as everything else can wait for it.
  void begin_plans(const std::shared_ptr<const GoalDistances>& distances) {
    using Part = PrimalSearch::Part;
    const Part part = role_ == Role::both    ? Part::all
                      : role_ == Role::bound ? Part::first_guide
                                             : Part::rest;
    plans_.emplace(PlanSearchContext{instance_, distances, options_.objective, options_.seed, part,
                                     incumbent_, limits_});
    if (!options_.initial_plan) {
      enter(Phase::first_plan);
      if (role_ == Role::both)
        while (plans_->start()) yield();
      else
        plans_->begin();
    }
    exchange(0);
    if (role_ == Role::plans)
      consider_stop();
    else
      yield();
  }

  /// What the agents cost when each is alone. Without `distances`, because a limit was met, of as
  /// many as can be looked at in little time.
  void learn_free_bound(const GoalDistances* distances) {
    const auto known = [&](AgentId i) -> Cost {
      return (*distances)(i, instance_.agents()[i].start);
    };
    const auto found = [&](AgentId i) -> Cost {
      const Agent& task = instance_.agents()[i];
      return distances_from(instance_.graph(), task.goal)[task.start];
    };
    const auto agents = instance_.agent_ids();
    Grace grace(options_.limits, limits_);
    free_bound_ = distances != nullptr ? free_bound(agents, options_.objective, known)
                                       : free_bound(agents, options_.objective, found, &grace);
    incumbent_.raise(*free_bound_);
  }

  /// All that anybody has proved. The search's own bound stays its own, because it follows from its
  /// cores.
  [[nodiscard]] Cost lower() const { return std::max(incumbent_.lower(), heard_lower_); }

  /// Makes plans for as long as somebody else works on the bound.
  void look_for_plans() {
    std::int64_t effort = 0;
    while (!limits_.exhausted_now() && !others_ended_) {
      effort += plans_->work([this] { return draft_ ? *std::exchange(draft_, nullptr) : Plan(); });
      exchange(effort);
      incumbent_.raise(heard_lower_);
      consider_stop();
    }
  }

  void exchange(std::int64_t effort) {
    if (companion_ == nullptr) return;
    const auto heard = companion_->on_effort(effort, [this] { return news(); });
    if (!heard) return;
    heard_lower_ = std::max(heard_lower_, heard->lower);
    if (heard->plan && heard->plan != heard_plan_) hear(heard->plan);
    draft_ = heard->draft;
    others_ended_ = heard->others_ended;
  }

  /// Both may have been made from one plan, and differ in what was done since. Where one is as good
  /// as the other, all take that of the one whose role plans are, so that they do not drift apart:
  /// the closer two plans are, the more of their parts can be merged.
  void hear(const std::shared_ptr<const Plan>& plan) {
    heard_plan_ = plan;
    const std::optional<Cost> before = incumbent_.upper();
    if (!before) {
      incumbent_.offer(*plan);
      return;
    }
    if (!merger_) merger_.emplace(instance_);
    const Plan& own = incumbent_.plan();
    incumbent_.offer(role_ == Role::plans ? merger_->merge(own, *plan, options_.objective)
                                          : merger_->merge(*plan, own, options_.objective));
    if (plans_) plans_->hear(*before - *incumbent_.upper());
  }

  [[nodiscard]] News news() {
    News news;
    news.lower = lower();
    if (incumbent_.upper()) {
      if (!told_plan_ || incumbent_.upper() != told_cost_)
        told_plan_ = std::make_shared<const Plan>(incumbent_.plan());
      news.plan = told_plan_;
      news.cost = told_cost_ = *incumbent_.upper();
    }
    if (role_ == Role::bound && run_ != nullptr)
      news.draft = std::make_shared<const Plan>(run_->draft());
    return news;
  }

  // sat::YieldPoint
  void yield() override {
    if (run_ != nullptr) {
      exchange_while_searching();
      if (plans_) make_plans(run_->engine().effort());
    }
    consider_stop();
    report_progress();
    report_plan();
  }

  void exchange_while_searching() {
    exchange(run_->engine().effort() + (plans_ ? plans_->effort() : 0));
  }

  /// Beside one whose role they are, plans are made where that gains more than the bound does;
  /// drafts are left to it.
  void make_plans(std::int64_t search_effort) {
    std::function<Plan()> draft;
    if (role_ == Role::both) draft = [this] { return run_->draft(); };
    std::function<void()> after_slice;
    if (companion_ != nullptr)
      after_slice = [this] {
        exchange_while_searching();
        consider_stop();
      };
    plans_->advance(search_effort, draft, after_slice);
  }

  /// Ends the search when the bounds meet, or are as close as was asked for.
  void consider_stop() {
    const std::optional<Cost> cost = incumbent_.upper();
    if (cost && (*cost <= lower() || is_within_gap(options_.gap_percent, *cost, lower())))
      limits_.stop(StopReason::gap);
  }

  void report_progress() {
    progress_.know(lower(), incumbent_.upper());
    progress_.tell_if_due();
  }

  void enter(Phase phase) {
    progress_.know(lower(), incumbent_.upper());
    progress_.enter(phase);
  }

  void report_plan() {
    if (!options_.on_plan || !incumbent_.upper() || incumbent_.upper() == reported_cost_ ||
        limits_.elapsed_wall() < next_plan_s_)
      return;
    options_.on_plan(incumbent_.plan());
    reported_cost_ = incumbent_.upper();
    next_plan_s_ = limits_.elapsed_wall() + options_.plan_interval_s;
  }

  [[nodiscard]] sat::SearchEnd search_costs_of(Run& run, std::vector<Raise>* raises) {
    const sat::CostSearchContext context{run.engine(), run.problem(), incumbent_,
                                         limits_,      *this,         raises};
    const CostSearch by_default =
        options_.system == System::dpll ? CostSearch::core_guided : CostSearch::iterative;
    if (options_.objective == Objective::sum_of_costs &&
        options_.cost_search.value_or(by_default) == CostSearch::core_guided)
      return sat::search_by_cores(context, tuning_.cores, outcome_.statistics);
    return sat::search_upwards(context);
  }

  void search_costs(const std::shared_ptr<const GoalDistances>& distances) {
    enter(Phase::search);
    const std::unique_ptr<Run> run = make_run(instance_, options_, tuning_);
    if (!run->prepare(distances, limits_)) return;
    run_ = run.get();
    incumbent_.set_run(run_);
    incumbent_.raise(run->problem().lower_bound());
    yield();
    sat::SearchEnd end = sat::SearchEnd::stopped;
    std::vector<Raise> raises;
    try {
      end = search_costs_of(*run, options_.explain ? &raises : nullptr);
    } catch (const LimitReached&) {  // the engine is left in order, and what was raised is proved
    }
    if (outcome_.attribution) run->explain(std::move(raises), *outcome_.attribution);
    run->engine().add_statistics(outcome_.statistics);
    outcome_.statistics.checks = run->num_checks();
    outcome_.statistics.rejected_models = run->num_rejected();
    if (const auto complaint = run->complaint())
      outcome_.internal_error = Error{ErrorCode::internal, *complaint, {}};
    else if (end == sat::SearchEnd::exhausted)
      outcome_.internal_error =
          Error{ErrorCode::internal, "the clauses of a feasible instance are unsatisfiable", {}};
    else if (end == sat::SearchEnd::found && !incumbent_.are_closed() && !is_bound_refuted())
      outcome_.internal_error =
          Error{ErrorCode::internal, "the plan found does not cost the proven bound", {}};
  }

  const Instance& instance_;
  const SolveOptions& options_;
  const Tuning tuning_;
  LimitMonitor& limits_;
  SolveOutcome& outcome_;
  Companion* const companion_;
  const Role role_;
  ProgressReporter progress_;
  Incumbent incumbent_;
  const Cost known_;  // by the user
  std::optional<Cost> free_bound_;
  std::optional<PlanSearch> plans_;
  std::optional<PlanMerger> merger_;
  std::shared_ptr<const Plan> heard_plan_;
  const Run* run_ = nullptr;  // when it is prepared
  double next_plan_s_ = 0;
  std::optional<Cost> reported_cost_;
  // What was heard from others, and told to them.
  Cost heard_lower_ = 0;
  std::shared_ptr<const Plan> draft_, told_plan_;
  Cost told_cost_ = 0;
  bool others_ended_ = false;
};

}  // namespace

void search(const Instance& instance, const SolveOptions& options, const Tuning& tuning,
            LimitMonitor& limits, Companion* companion, SolveOutcome& outcome) {
  Search(instance, options, tuning, limits, outcome, companion).run();
}

}  // namespace quadrille::discrete
