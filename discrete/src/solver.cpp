// SPDX-License-Identifier: MIT
#include "quadrille/discrete/solver.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "collision_theory.hpp"
#include "eager_collisions.hpp"
#include "lazy/lazy_auditor.hpp"
#include "lazy/lazy_model.hpp"
#include "lazy/lazy_problem.hpp"
#include "lazy/lazy_theory.hpp"
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

/// Everything that one run needs, wired up as the system asks.
class Run {
 public:
  virtual ~Run() = default;
  /// Computes the agents' distances and what else the rest needs; to be called once, first. False
  /// if `limits` ended that early.
  [[nodiscard]] virtual bool prepare(LimitMonitor& limits) = 0;
  [[nodiscard]] virtual sat::Engine& engine() = 0;
  [[nodiscard]] virtual sat::BoundedProblem& bounded_problem() = 0;
  [[nodiscard]] virtual sat::AgentCostProblem& agent_cost_problem() = 0;
  [[nodiscard]] virtual const Plan& plan() const = 0;
  [[nodiscard]] virtual std::int64_t num_checks() const = 0;
  [[nodiscard]] virtual std::int64_t num_rejected() const = 0;
  [[nodiscard]] virtual std::optional<std::string> complaint() const = 0;
};

sat::EngineOptions engine_options(const SolveOptions& options, sat::ClauseObserver* observer) {
  sat::EngineOptions engine_options;
  engine_options.seed = options.seed;
  engine_options.observer = observer;
  return engine_options;
}

class MddRun final : public Run {
 public:
  MddRun(const Instance& instance, const SolveOptions& options)
      : growth_(options.mdd_growth), model_(instance, options.objective) {
    if (options.system == System::dpll_mdd)
      theory_ = std::make_unique<CollisionTheory>(model_, options.check);
    if (options.system == System::mdd_sat) eager_ = std::make_unique<EagerCollisions>(model_);
    if (options.audit || options.known_plan)
      auditor_ = std::make_unique<LemmaAuditor>(model_, options.audit, options.known_plan);
    engine_ = std::make_unique<sat::Engine>(theory_.get(), engine_options(options, auditor_.get()));
  }

  bool prepare(LimitMonitor& limits) override {
    if (!model_.attach(*engine_, limits)) return false;
    problem_ = std::make_unique<MddProblem>(model_, *engine_, theory_.get(), eager_.get(), growth_);
    return true;
  }

  sat::Engine& engine() override { return *engine_; }
  sat::BoundedProblem& bounded_problem() override { return *problem_; }
  sat::AgentCostProblem& agent_cost_problem() override { return *problem_; }
  const Plan& plan() const override { return problem_->plan(); }
  std::int64_t num_checks() const override {
    return problem_->num_checks() + (theory_ ? theory_->num_checks() : 0);
  }
  std::int64_t num_rejected() const override { return problem_->num_rejected(); }
  std::optional<std::string> complaint() const override {
    return auditor_ ? auditor_->complaint() : std::nullopt;
  }

 private:
  MddGrowth growth_;
  MddModel model_;
  std::unique_ptr<CollisionTheory> theory_;
  std::unique_ptr<EagerCollisions> eager_;
  std::unique_ptr<LemmaAuditor> auditor_;
  std::unique_ptr<sat::Engine> engine_;
  std::unique_ptr<MddProblem> problem_;
};

class LazyRun final : public Run {
 public:
  LazyRun(const Instance& instance, const SolveOptions& options)
      : instance_(instance), options_(options) {}

  bool prepare(LimitMonitor& limits) override {
    model_ = std::make_unique<LazyModel>(instance_, limits);
    if (!model_->is_complete()) return false;
    theory_ = std::make_unique<LazyTheory>(*model_);
    if (options_.audit || options_.known_plan)
      auditor_ = std::make_unique<LazyAuditor>(*model_, options_.audit, options_.known_plan);
    engine_ =
        std::make_unique<sat::Engine>(theory_.get(), engine_options(options_, auditor_.get()));
    problem_ = std::make_unique<LazyProblem>(*model_, *engine_, *theory_, options_.objective);
    return true;
  }

  sat::Engine& engine() override { return *engine_; }
  sat::BoundedProblem& bounded_problem() override { return *problem_; }
  sat::AgentCostProblem& agent_cost_problem() override { return *problem_; }
  const Plan& plan() const override { return problem_->plan(); }
  std::int64_t num_checks() const override { return theory_->num_checks(); }
  std::int64_t num_rejected() const override { return 0; }
  std::optional<std::string> complaint() const override {
    return auditor_ ? auditor_->complaint() : std::nullopt;
  }

 private:
  const Instance& instance_;
  const SolveOptions& options_;
  std::unique_ptr<LazyModel> model_;
  std::unique_ptr<LazyTheory> theory_;
  std::unique_ptr<LazyAuditor> auditor_;
  std::unique_ptr<sat::Engine> engine_;
  std::unique_ptr<LazyProblem> problem_;
};

std::unique_ptr<Run> make_run(const Instance& instance, const SolveOptions& options) {
  if (options.system == System::dpll) return std::make_unique<LazyRun>(instance, options);
  return std::make_unique<MddRun>(instance, options);
}

sat::SearchReport search(Run& run, const SolveOptions& options, LimitMonitor& limits,
                         SolveOutcome& outcome) {
  const auto on_bound = [&](Cost bound) { outcome.lower_bound = bound; };
  const CostSearch by_default =
      options.system == System::dpll ? CostSearch::core_guided : CostSearch::iterative;
  if (options.objective == Objective::sum_of_costs &&
      options.cost_search.value_or(by_default) == CostSearch::core_guided)
    return sat::search_by_cores(run.engine(), run.agent_cost_problem(), {}, limits,
                                outcome.statistics, on_bound);
  return sat::search_upwards(run.engine(), run.bounded_problem(), limits, on_bound);
}

void find_plan(Run& run, const SolveOptions& options, LimitMonitor& limits, SolveOutcome& outcome) {
  if (!run.prepare(limits)) return;
  outcome.lower_bound = run.bounded_problem().lower_bound();
  limits.set_ticker(0.25, [&] {
    if (options.on_progress)
      options.on_progress({outcome.lower_bound, limits.elapsed_wall(), limits.conflicts()});
  });
  const auto report = search(run, options, limits, outcome);
  outcome.lower_bound = report.lower_bound;
  run.engine().add_statistics(outcome.statistics);
  outcome.statistics.checks = run.num_checks();
  outcome.statistics.rejected_models = run.num_rejected();
  if (const auto complaint = run.complaint()) {
    outcome.internal_error = Error{ErrorCode::internal, *complaint, {}};
  } else if (report.end == sat::SearchReport::End::exhausted) {
    outcome.internal_error =
        Error{ErrorCode::internal, "the clauses of a feasible instance are unsatisfiable", {}};
  } else if (report.end == sat::SearchReport::End::found) {
    outcome.plan = run.plan();
    outcome.status = Status::optimal;
  }
}

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
  find_plan(*make_run(instance, options), options, limits, outcome);
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
