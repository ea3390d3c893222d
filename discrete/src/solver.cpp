// SPDX-License-Identifier: MIT
#include "quadrille/discrete/solver.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "collision_theory.hpp"
#include "eager_collisions.hpp"
#include "lemma_auditor.hpp"
#include "mdd_model.hpp"
#include "mdd_problem.hpp"
#include "quadrille/discrete/feasibility.hpp"
#include "quadrille/discrete/verify.hpp"
#include "quadrille/sat/core_guided_search.hpp"
#include "quadrille/sat/cost_search.hpp"
#include "usages.hpp"

namespace quadrille::discrete {
namespace {

/// Everything that one run with the MDD path model needs, wired up as the system asks.
class MddRun {
 public:
  MddRun(const Instance& instance, const SolveOptions& options)
      : options_(options), model_(instance, options.objective) {
    if (options.system == System::dpll || options.system == System::dpll_mdd)
      theory_ = std::make_unique<CollisionTheory>(model_, options.check);
    if (options.system == System::mdd_sat) eager_ = std::make_unique<EagerCollisions>(model_);
    if (options.audit || options.known_plan)
      auditor_ = std::make_unique<LemmaAuditor>(model_, options.audit, options.known_plan);
    sat::EngineOptions engine_options;
    engine_options.seed = options.seed;
    engine_options.observer = auditor_.get();
    engine_ = std::make_unique<sat::Engine>(theory_.get(), engine_options);
  }

  void run(LimitMonitor& limits, SolveOutcome& outcome) {
    if (!model_.attach(*engine_, limits)) return;
    problem_ = std::make_unique<MddProblem>(model_, *engine_, theory_.get(), eager_.get(),
                                            options_.mdd_growth);
    outcome.lower_bound = problem_->lower_bound();
    limits.set_ticker(0.25, [&] { report_progress(outcome, limits); });
    const auto report = search(limits, outcome);
    outcome.lower_bound = report.lower_bound;
    engine_->add_statistics(outcome.statistics);
    outcome.statistics.checks = problem_->num_checks() + (theory_ ? theory_->num_checks() : 0);
    outcome.statistics.rejected_models = problem_->num_rejected();
    if (auditor_ && auditor_->complaint()) {
      outcome.internal_error = Error{ErrorCode::internal, *auditor_->complaint(), {}};
    } else if (report.end == sat::SearchReport::End::exhausted) {
      outcome.internal_error =
          Error{ErrorCode::internal, "the clauses of a feasible instance are unsatisfiable", {}};
    } else if (report.end == sat::SearchReport::End::found) {
      outcome.plan = problem_->plan();
      outcome.status = Status::optimal;
    }
  }

 private:
  sat::SearchReport search(LimitMonitor& limits, SolveOutcome& outcome) {
    const auto on_bound = [&](Cost bound) { outcome.lower_bound = bound; };
    const CostSearch by_default =
        options_.system == System::dpll ? CostSearch::core_guided : CostSearch::iterative;
    if (options_.objective == Objective::sum_of_costs &&
        options_.cost_search.value_or(by_default) == CostSearch::core_guided)
      return sat::search_by_cores(*engine_, *problem_, {}, limits, outcome.statistics, on_bound);
    return sat::search_upwards(*engine_, *problem_, limits, on_bound);
  }

  void report_progress(const SolveOutcome& outcome, const LimitMonitor& limits) const {
    if (!options_.on_progress) return;
    options_.on_progress({outcome.lower_bound, limits.elapsed_wall(), limits.conflicts()});
  }

  const SolveOptions& options_;
  MddModel model_;
  std::unique_ptr<CollisionTheory> theory_;
  std::unique_ptr<EagerCollisions> eager_;
  std::unique_ptr<LemmaAuditor> auditor_;
  std::unique_ptr<sat::Engine> engine_;
  std::unique_ptr<MddProblem> problem_;
};

/// The plan has to pass `verify` and to cost what was proved.
void check_plan(const Instance& instance, const SolveOptions& options, SolveOutcome& outcome) {
  trim(*outcome.plan);
  const VerifyReport report = verify(instance, *outcome.plan);
  const Cost cost =
      options.objective == Objective::sum_of_costs ? report.sum_of_costs : report.makespan;
  std::optional<std::string> wrong;
  if (!report.valid())
    wrong = "the plan is not valid: " + report.violations.front().message;
  else if (cost < outcome.lower_bound ||
           (outcome.status == Status::optimal && cost != outcome.lower_bound))
    wrong = "the plan costs " + std::to_string(cost) + " and the proven bound is " +
            std::to_string(outcome.lower_bound);
  if (wrong) {
    outcome.internal_error = Error{ErrorCode::internal, *wrong, {}};
    return;
  }
  outcome.cost = cost;
}

std::optional<Error> check_options(const Instance& instance, const SolveOptions& options) {
  const auto refuse = [](ErrorCode code, std::string message) {
    return Error{code, std::move(message), {}};
  };
  if (instance.graph().num_vertices() > kMaxVertices)
    return refuse(ErrorCode::out_of_range,
                  "the solver supports up to " + std::to_string(kMaxVertices) + " vertices");
  const auto reaches = [](CheckSchedule::Fraction a, CheckSchedule::Fraction b) {
    return static_cast<std::int64_t>(a.numerator) * b.denominator >=
           static_cast<std::int64_t>(b.numerator) * a.denominator;
  };
  CheckSchedule::Fraction last{0, 1};
  for (const CheckSchedule::Fraction& f : options.check.fractions) {
    if (f.denominator <= 0 || reaches(last, f) || reaches(f, {1, 1}))
      return refuse(ErrorCode::out_of_range,
                    "the fractions of a check schedule increase between 0 and 1");
    last = f;
  }
  if (options.seed > 2'000'000'000)
    return refuse(ErrorCode::out_of_range, "the seed is larger than 2000000000");
  if (options.known_plan && !verify(instance, *options.known_plan).valid())
    return refuse(ErrorCode::invalid_plan, "the known plan is not a plan of this instance");
  return std::nullopt;
}

}  // namespace

SolveOutcome solve(const Instance& instance, const SolveOptions& options) {
  SolveOutcome outcome;
  LimitMonitor limits(options.limits);
  const auto finish = [&]() -> SolveOutcome&& {
    if (outcome.internal_error) {
      outcome.status = Status::unknown;
      outcome.plan.reset();
      outcome.cost.reset();
      outcome.explanation = outcome.internal_error->message;
    }
    outcome.statistics.cpu_s = limits.elapsed_cpu();
    outcome.statistics.wall_s = limits.elapsed_wall();
    outcome.statistics.peak_rss_mib = peak_rss_mib();
    return std::move(outcome);
  };
  if (auto error = check_options(instance, options)) {
    outcome.internal_error = std::move(error);
    return finish();
  }
  const Feasibility feasibility = check_feasibility(instance);
  if (!feasibility.feasible) {
    outcome.status = Status::infeasible;
    outcome.explanation = feasibility.reason;
    return finish();
  }
  MddRun(instance, options).run(limits, outcome);
  if (outcome.plan) check_plan(instance, options, outcome);
  if (outcome.status == Status::unknown) {
    outcome.stop = limits.reason();
    outcome.explanation = outcome.stop == StopReason::none
                              ? "a path needs more timesteps than the solver supports"
                              : "stopped by the limit: " + std::string(to_string(outcome.stop));
  }
  return finish();
}

}  // namespace quadrille::discrete
