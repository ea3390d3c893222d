// SPDX-License-Identifier: MIT
#include "solve/tie_break.hpp"

#include <algorithm>
#include <utility>

#include "quadrille/discrete/goal_distances.hpp"
#include "quadrille/sat/cost_search.hpp"
#include "quadrille/solve/pulse.hpp"
#include "solve/run.hpp"

namespace quadrille::discrete {
namespace {

/// The second search: bounds are numbers of moves.
class TieBreak final : private sat::YieldPoint, private sat::Bounds {
 public:
  TieBreak(const SolveOptions& options, LimitMonitor& limits, Knowledge& known)
      : limits_(limits),
        known_(known),
        objective_(options.objective),
        progress_(options.on_progress, options.progress_interval_s, limits, known),
        number_(num_moves(*known.plan)) {}

  void run(const Instance& instance, const SolveOptions& options, const Tuning& tuning) {
    progress_.enter(Phase::search);
    const auto distances = GoalDistances::make(instance, limits_);
    if (!distances) return;
    const std::unique_ptr<Run> run = make_run(instance, options, tuning);
    if (!run->prepare(distances, nullptr, limits_)) return;
    run_ = run.get();
    const auto problem = run->fewest_moves(*known_.cost);
    const sat::CostSearchContext context{run->engine(), *problem,        *this,  limits_,
                                         *this,         tuning.settings, nullptr};
    sat::SearchEnd end = sat::SearchEnd::stopped;
    try {
      end = sat::search_upwards(context);
    } catch (const LimitReached&) {  // the engine is left in order, and what was raised is proved
    }
    Statistics more;
    run->engine().add_statistics(more);
    more.checks = run->num_checks();
    more.rejected_models = run->num_rejected();
    known_.statistics.add_counts(more);
    if (const auto complaint = run->complaint())
      known_.fail(*complaint);
    else if (end == sat::SearchEnd::exhausted)
      known_.fail("no plan costs what a plan costs");
    else if (end == sat::SearchEnd::found && !are_closed())
      known_.fail("the plan found does not have the proven number of moves");
  }

  [[nodiscard]] Moves moves(Cost least) const {
    const Cost bound = std::max(least, lower());
    return {number_, bound, number_ == bound};
  }

 private:
  void yield() override { progress_.tell_if_due(); }

  [[nodiscard]] std::optional<Cost> upper() const override { return number_; }
  /// Only searches for sums by cores ask that.
  [[nodiscard]] Cost incumbent_cost_of(AgentId) const override { return 0; }
  void offer_accepted() override {
    const std::int64_t number = num_moves(run_->plan());
    if (number >= number_) return;
    number_ = number;
    // It is cheaper where the user claims a bound that is too high, and refutes that.
    const Cost cost = run_->plan().cost(objective_);
    known_.take(std::make_shared<const Plan>(run_->plan()), cost);
  }

  LimitMonitor& limits_;
  Knowledge& known_;
  const Objective objective_;
  solve::ProgressReporter progress_;
  std::int64_t number_;
  const Run* run_ = nullptr;
};

}  // namespace

Moves break_tie(const Instance& instance, const SolveOptions& options, const Tuner& tuner,
                const std::shared_ptr<ResourceAccount>& account, std::int64_t conflicts,
                Knowledge& known) {
  SolveOptions second = options;
  if (second.system == System::dpll) second.system = System::dpll_mdd;
  second.proof = second.explain = false;
  if (second.limits.conflicts)
    second.limits.conflicts = std::max<std::int64_t>(0, *second.limits.conflicts - conflicts);
  LimitMonitor limits(second.limits, account);
  TieBreak tie_break(second, limits, known);
  solve::run_guarded(known, limits, [&] { tie_break.run(instance, second, tuner(second)); });
  // What cut it short does not make the cost any less optimal.
  return tie_break.moves(count_moves(instance, *known.plan).lower_bound);
}

Moves count_moves(const Instance& instance, const Plan& plan) {
  Moves moves{num_moves(plan), 0, false};
  for (const Agent& agent : instance.agents()) {
    const Timestep way = distances_to_nearest(instance.graph(), agent.goals)[agent.start];
    moves.lower_bound += way == kUnreachable ? 0 : way;
  }
  return moves;
}

}  // namespace quadrille::discrete
