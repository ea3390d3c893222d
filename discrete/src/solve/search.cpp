// SPDX-License-Identifier: MIT
#include "solve/search.hpp"

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "feasibility/goal_choice.hpp"
#include "feasibility/goal_reach.hpp"
#include "neighbourhoods/plan_merger.hpp"
#include "paths/lone_agents.hpp"
#include "quadrille/core/free_bound.hpp"
#include "quadrille/discrete/goal_distances.hpp"
#include "quadrille/sat/cost_search.hpp"
#include "quadrille/solve/frame.hpp"
#include "solve/incumbent.hpp"
#include "solve/plan_search.hpp"
#include "solve/priced_bounds.hpp"
#include "solve/ruled_search.hpp"
#include "solve/run.hpp"

namespace quadrille::discrete {
namespace {

/// One search, with what all systems have in common: bounds from both sides.
class Search final : private sat::YieldPoint {
 public:
  Search(const Instance& instance, const SolveOptions& options, const Tuning& tuning,
         const Desk& desk, const GetDistances& get_distances, ProofDraft& proof)
      : instance_(instance),
        options_(options),
        tuning_(tuning),
        get_distances_(get_distances),
        proof_(proof),
        limits_(desk.limits),
        known_(desk.known),
        pulse_(desk.pulse),
        exchange_(desk.exchange),
        role_(desk.exchange.role()),
        incumbent_(options.objective, desk.known) {}

  void run() {
    incumbent_.raise(known_.claimed);
    enter(Phase::set_up);
    const auto distances = get_distances_(limits_);
    if (!distances) return;
    const LoneCosts lone = lone_costs(instance_, *distances, limits_);
    const auto free_cost = [&](AgentId i) -> Cost { return lone.costs[i]; };
    const auto agents = instance_.agent_ids();
    known_.prove(free_bound(agents, options_.objective, free_cost));
    incumbent_.raise(known_.floor);
    if (may_price()) priced_ = price_goals(instance_, limits_);
    if (options_.explain)
      known_.attribution = solve::free_charges(agents, options_.objective, free_cost);
    if (options_.first_plan && instance_.is_plain()) begin_plans(distances);
    if (options_.first_plan && !instance_.is_plain()) begin_ruled_plans(distances);
    if (role_ == Role::plans)
      look_for_plans();
    else if (!limits_.exhausted_now())
      search_costs(distances);
  }

 private:
  /// Looks for a first plan, unless there is one, for as long as everything else can wait for it.
  void begin_plans(const std::shared_ptr<const GoalDistances>& distances) {
    using Part = PrimalSearch::Part;
    const Part part = role_ == Role::all     ? Part::all
                      : role_ == Role::bound ? Part::first_guide
                                             : Part::rest;
    std::shared_ptr<const GoalDistances> first_distances = distances;
    if (instance_.has_goal_sets()) {
      chosen_ = choose_goals(instance_, &limits_).chosen;
      first_distances = chosen_ ? GoalDistances::make(*chosen_, limits_) : nullptr;
    }
    plans_.emplace(PlanSearchContext{instance_, distances, distances_of_improvement(distances),
                                     chosen_ ? *chosen_ : instance_, std::move(first_distances),
                                     options_.objective, options_.seed, part, incumbent_, limits_,
                                     tuning_.settings});
    if (!known_.plan) {
      enter(Phase::first_plan);
      if (role_ == Role::all)
        while (plans_->start()) yield();
      else
        plans_->begin();
    }
    exchange({});
    if (role_ == Role::plans)
      consider_stop();
    else
      yield();
  }

  /// With prices agents that are taken out of a plan do not take each other's goals. Where all
  /// share all goals, plans are as good without, and some better.
  [[nodiscard]] std::shared_ptr<const GoalDistances> distances_of_improvement(
      const std::shared_ptr<const GoalDistances>& distances) const {
    const auto& agents = instance_.agents().items();
    const bool share_all = std::all_of(agents.begin(), agents.end(), [&](const Agent& agent) {
      return agent.goals == agents.front().goals;
    });
    return priced_ && !share_all ? priced_->distances : distances;
  }

  /// The same of an instance with rules.
  void begin_ruled_plans(const std::shared_ptr<const GoalDistances>& distances) {
    if (role_ != Role::bound)
      ruled_.emplace(instance_, distances, options_.objective, options_.seed, incumbent_, limits_);
    if (ruled_ && !known_.plan) enter(Phase::first_plan);
    while (role_ == Role::all && ruled_->is_first_plan_due() && !limits_.exhausted_now()) {
      static_cast<void>(ruled_->work());
      yield();
    }
    exchange({});
    consider_stop();
  }

  /// Makes plans for as long as somebody else works on the bound.
  void look_for_plans() {
    Effort effort;
    while (!limits_.exhausted_now() && !others_ended_) {
      effort += ruled_ ? ruled_->work() : plans_->work([this] {
        return draft_ ? *std::exchange(draft_, nullptr) : Plan();
      });
      exchange(effort);
      incumbent_.raise(heard_lower_);
      consider_stop();
    }
  }

  /// The search's own bound stays its own, because it follows from its cores.
  void exchange(Effort effort) {
    const auto heard = exchange_.arrive(effort, [this] { return message(); });
    if (!heard) return;
    heard_lower_ = std::max(heard_lower_, heard->lower);
    known_.raise(heard->lower);
    if (heard->plan && heard->plan != heard_plan_) hear(heard->plan, heard->extra.origin);
    draft_ = heard->extra.paths;
    others_ended_ = heard->others_ended;
  }

  /// Both may have been made from one plan, and differ in what was done since. Where one is as good
  /// as the other, all take that of the one whose role plans are, so that they do not drift apart:
  /// the closer two plans are, the more of their parts can be merged.
  void hear(const std::shared_ptr<const Plan>& plan, std::string_view origin) {
    heard_plan_ = plan;
    const std::optional<Cost> before = incumbent_.upper();
    if (!before) {
      incumbent_.offer(plan, origin);
      return;
    }
    if (!instance_.is_plain()) {  // Parts of plans are told apart by the classic collisions.
      incumbent_.offer(plan, origin);
      return;
    }
    if (!merger_) merger_.emplace(instance_);
    const Plan& own = incumbent_.plan();
    incumbent_.offer(role_ == Role::plans ? merger_->merge(own, *plan, options_.objective)
                                          : merger_->merge(*plan, own, options_.objective),
                     origin);
    if (plans_) plans_->hear(*before - *incumbent_.upper());
  }

  [[nodiscard]] Message message() {
    share();
    Message message;
    message.lower = known_.lower();
    if (known_.plan) {
      if (!told_plan_ || known_.cost != told_cost_) told_plan_ = known_.plan;
      message.plan = told_plan_;
      message.cost = told_cost_ = *known_.cost;
      message.extra.origin = known_.statistics.first_plan;
    }
    if (role_ == Role::bound && run_ != nullptr)
      message.extra.paths = std::make_shared<const Plan>(run_->draft());
    return message;
  }

  // sat::YieldPoint
  void yield() override {
    if (run_ != nullptr) {
      exchange_while_searching();
      if (plans_) make_plans(run_->engine().effort());
      if (ruled_) ruled_->advance(run_->engine().effort(), [this] { consider_stop(); });
    }
    share();
    pulse_.beat();
  }

  void exchange_while_searching() {
    exchange(run_->engine().effort() + (plans_ ? plans_->effort() : Effort()));
  }

  /// Beside one whose role they are, plans are made where that gains more than the bound does;
  /// drafts are left to it.
  void make_plans(Effort search_effort) {
    std::function<Plan()> draft;
    if (role_ == Role::all) draft = [this] { return run_->draft(); };
    std::function<void()> after_slice;
    if (exchange_.has_others())
      after_slice = [this] {
        exchange_while_searching();
        consider_stop();
      };
    plans_->advance(search_effort, draft, after_slice);
  }

  void consider_stop() {
    share();
    pulse_.consider_stop();
  }

  void enter(Phase phase) {
    share();
    pulse_.enter(phase);
  }

  [[nodiscard]] sat::SearchEnd search_costs_of(Run& run, std::vector<Raise>* raises) {
    sat::Bounds& bounds = bounds_ ? static_cast<sat::Bounds&>(*bounds_) : incumbent_;
    const sat::CostSearchContext context{run.engine(), run.problem(),    bounds, limits_,
                                         *this,        tuning_.settings, raises, options_.seed};
    const CostSearch by_default =
        options_.system == System::dpll ? CostSearch::core_guided : CostSearch::iterative;
    if (options_.objective == Objective::sum_of_costs &&
        options_.cost_search.value_or(by_default) == CostSearch::core_guided)
      return sat::search_by_cores(context, tuning_.cores, known_.statistics);
    return sat::search_upwards(context);
  }

  /// Raises of the bound are told in costs.
  [[nodiscard]] bool may_price() const {
    return instance_.has_goal_sets() && options_.objective == Objective::sum_of_costs &&
           !options_.explain && instance_.is_plain();
  }

  /// Decision diagrams know no prices, but what they prove holds there, too.
  void keep_bound_of_prices() {
    Cost bound = -priced_->paid;
    for (const AgentId i : instance_.agent_ids())
      bound += (*priced_->distances)(i, instance_.agents()[i].start);
    incumbent_.raise(bound);
    priced_.reset();
  }

  /// What is known of the bound is known to all.
  void share() {
    if (bounds_) bounds_->share();
    incumbent_.share();
  }

  void keep_proof(const Run& run) {
    auto proof = run.proof();
    if (proof)
      proof_.proof = *std::move(proof);
    else
      proof_.fault = proof.error().message;
  }

  void search_costs(const std::shared_ptr<const GoalDistances>& distances) {
    enter(Phase::search);
    const std::unique_ptr<Run> run = make_run(instance_, options_, tuning_);
    if (priced_ && options_.system != System::dpll) keep_bound_of_prices();
    const bool is_ready = priced_ ? run->prepare(priced_->distances, &*priced_, limits_)
                                  : run->prepare(distances, nullptr, limits_);
    if (!is_ready) return;
    run_ = run.get();
    incumbent_.set_run(run_);
    incumbent_.raise(run->problem().lower_bound() - (priced_ ? priced_->paid : 0));
    if (priced_) bounds_.emplace(incumbent_, *priced_);
    yield();
    sat::SearchEnd end = sat::SearchEnd::stopped;
    std::vector<Raise> raises;
    try {
      end = search_costs_of(*run, options_.explain ? &raises : nullptr);
    } catch (const LimitReached&) {  // the engine is left in order, and what was raised is proved
    }
    share();
    if (options_.proof) keep_proof(*run);
    if (known_.attribution) run->explain(std::move(raises), *known_.attribution);
    run->engine().add_statistics(known_.statistics);
    known_.statistics.checks = run->num_checks();
    known_.statistics.rejected_models = run->num_rejected();
    if (const auto complaint = run->complaint())
      known_.fail(*complaint);
    else if (end == sat::SearchEnd::exhausted && !instance_.is_plain())
      known_.infeasible = solve::Infeasibility{"no plan keeps all rules"};
    else if (end == sat::SearchEnd::exhausted && instance_.has_goal_sets())
      known_.infeasible = solve::Infeasibility{"no choice of goals has a plan"};
    else if (end == sat::SearchEnd::exhausted)
      known_.fail("the clauses of a feasible instance are unsatisfiable");
    else if (end == sat::SearchEnd::found && !incumbent_.are_closed() && !known_.is_claim_refuted())
      known_.fail("the plan found does not cost the proven bound");
    else if (end == sat::SearchEnd::stopped && limits_.reason() == StopReason::none)
      known_.why_open = "a path needs 2^20 timesteps or more: the MDD systems do not support it";
  }

  const Instance& instance_;
  const SolveOptions& options_;
  const Tuning tuning_;
  const GetDistances& get_distances_;
  ProofDraft& proof_;
  LimitMonitor& limits_;
  Knowledge& known_;
  solve::Pulse<Plan>& pulse_;
  solve::Exchange<Message>& exchange_;
  const Role role_;
  Incumbent incumbent_;
  std::optional<PricedGoals> priced_;
  std::optional<PricedBounds> bounds_;  // with prices
  std::optional<Instance> chosen_;      // with one goal for each agent, if some have several
  std::optional<PlanSearch> plans_;
  std::optional<PlanMerger> merger_;
  std::optional<RuledSearch> ruled_;  // instead of these, under rules
  const Run* run_ = nullptr;          // when it is prepared
  // What was heard from others, and told to them.
  Cost heard_lower_ = 0;
  std::shared_ptr<const Plan> heard_plan_, draft_, told_plan_;
  Cost told_cost_ = 0;
  bool others_ended_ = false;
};

}  // namespace

void search(const Instance& instance, const SolveOptions& options, const Tuning& tuning,
            const Desk& desk, const GetDistances& get_distances, ProofDraft& proof) {
  Search(instance, options, tuning, desk, get_distances, proof).run();
}

}  // namespace quadrille::discrete
