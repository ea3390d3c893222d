// SPDX-License-Identifier: MIT
#include "solve/priced_search.hpp"

#include <utility>

#include "solve/phases.hpp"
#include "solve/warm_start.hpp"

namespace quadrille::continuous {
namespace {

/// What crosses between the two instances: costs, bounds and plans.
class PricedSearch {
 public:
  PricedSearch(const Instance& instance, const PricedGoals& priced, const SolveOptions& options,
               const std::shared_ptr<ResourceAccount>& account, const Desk& desk)
      : instance_(instance),
        priced_(priced),
        options_(options),
        account_(account),
        limits_(desk.limits),
        known_(desk.known),
        pulse_(desk.pulse) {}

  void run() {
    const SolveOptions options = inner_options();
    if (known_.plan) {
      Plan plan = *known_.plan;
      priced_.enter(plan);
      const Cost its_cost = *known_.cost + priced_.paid();
      own_.take(std::make_shared<const Plan>(std::move(plan)), its_cost);
    }
    LimitMonitor limits(options.limits, account_);
    inner_limits_ = &limits;
    {
      solve::Pulse<Plan> pulse(options, limits, own_, true, [this] { return is_enough(); });
      Exchange alone;
      std::optional<ProofDraft> none;
      solve::run_guarded(own_, limits, [&] {
        const WarmStart cold;
        Phases phases(priced_.instance(), options, cold, account_, {limits, own_, pulse, alone},
                      none);
        phases.set_fees(priced_.fees());
        phases.run();
      });
    }
    learn();
    inner_limits_ = nullptr;
    take_end();
  }

 private:
  /// What is told to users, and when to stop, is looked after here.
  [[nodiscard]] SolveOptions inner_options() {
    SolveOptions options = options_;
    options.initial_plan.reset();
    options.known_lower_bound.reset();
    options.gap_percent.reset();
    options.on_plan = {};
    if (options.debug.known_plan) priced_.enter(*options.debug.known_plan);
    options.on_progress = [this](const Progress& progress) {
      learn();
      if (std::exchange(phase_, progress.phase) != progress.phase) pulse_.enter(progress.phase);
      pulse_.beat();
    };
    return options;
  }

  bool is_enough() {
    learn();
    pulse_.consider_stop();
    return limits_.reason() != StopReason::none;
  }

  void learn() {
    const std::int64_t conflicts = inner_limits_->conflicts();
    limits_.add_conflicts(conflicts - std::exchange(num_told_conflicts_, conflicts));
    if (own_.has_floor) known_.prove(own_.lower() - priced_.paid());
    if (!own_.plan || own_.plan == told_plan_) return;
    told_plan_ = own_.plan;
    Plan plan = *own_.plan;
    priced_.leave(plan);
    const Cost its_cost = cost(plan, options_.objective);
    known_.offer(std::make_shared<const Plan>(std::move(plan)), its_cost);
    known_.credit(own_.statistics.first_plan);
  }

  void take_end() {
    known_.statistics.add_counts(own_.statistics);
    if (own_.error) known_.error = own_.error;
    if (own_.infeasible)
      known_.infeasible = own_.infeasible->blocked.empty()
                              ? own_.infeasible
                              : infeasibility(instance_, own_.infeasible->blocked);
    if (known_.why_open.empty()) known_.why_open = own_.why_open;
    if (own_.stop != StopReason::none && own_.stop != StopReason::gap) limits_.stop(own_.stop);
  }

  const Instance& instance_;
  const PricedGoals& priced_;
  const SolveOptions& options_;
  const std::shared_ptr<ResourceAccount>& account_;
  LimitMonitor& limits_;
  Knowledge& known_;
  solve::Pulse<Plan>& pulse_;
  Knowledge own_;
  LimitMonitor* inner_limits_ = nullptr;
  std::int64_t num_told_conflicts_ = 0;
  std::shared_ptr<const Plan> told_plan_;
  Phase phase_ = Phase::set_up;
};

}  // namespace

std::optional<PricedGoals> price_goals(const Instance& instance, const SolveOptions& options,
                                       LimitMonitor& limits) {
  if (options.objective != Objective::sum_of_costs || options.system != System::dpll ||
      options.explain || options.proof)
    return std::nullopt;
  return PricedGoals::make(instance, limits);
}

void search_with_prices(const Instance& instance, const PricedGoals& priced,
                        const SolveOptions& options,
                        const std::shared_ptr<ResourceAccount>& account, const Desk& desk) {
  PricedSearch(instance, priced, options, account, desk).run();
}

}  // namespace quadrille::continuous
