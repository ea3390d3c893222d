// SPDX-License-Identifier: MIT
#include "quadrille/continuous/solver.hpp"

#include <algorithm>
#include <memory>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "feasibility/feasibility.hpp"
#include "paths/scene.hpp"
#include "primal/first_plan.hpp"
#include "quadrille/continuous/verify.hpp"
#include "quadrille/core/plan_claim.hpp"
#include "routes/route_search.hpp"
#include "solve/cost_problem.hpp"
#include "solve/cover_search.hpp"
#include "solve/small_instances.hpp"
#include "theory/known_plan_auditor.hpp"
#include "theory/lemma_auditor.hpp"
#include "theory/model.hpp"
#include "theory/theory.hpp"

namespace quadrille::continuous {
namespace {

std::optional<Error> check_options(const Instance& instance, const SolveOptions& options) {
  if (options.seed > 2'000'000'000)
    return Error{ErrorCode::out_of_range, "the seed is larger than 2000000000", {}};
  if (options.gap_percent && !(*options.gap_percent >= 0))
    return Error{ErrorCode::out_of_range, "the gap is not a number of at least 0", {}};
  if (!(options.progress_interval_s >= 0))
    return Error{
        ErrorCode::out_of_range, "the progress interval is not a number of at least 0", {}};
  if (!(options.plan_interval_s >= 0))
    return Error{ErrorCode::out_of_range, "the plan interval is not a number of at least 0", {}};
  if (options.debug.known_plan && !verify(instance, *options.debug.known_plan).valid())
    return Error{ErrorCode::invalid_plan, "the known plan is not a plan of this instance", {}};
  return std::nullopt;
}

std::string blocked_text(const std::vector<AgentId>& blocked, std::size_t num_agents) {
  if (blocked.size() == num_agents) return "the agents cannot all reach their goals";
  std::string text = "agents";
  for (const AgentId i : blocked)
    text += (i == blocked.front() ? " " : " and ") + std::to_string(i.index());
  return text + " cannot " + (blocked.size() == 2 ? "both" : "all") +
         " reach their goals, even without the others";
}

void keep_cheaper(std::optional<Plan>& best, std::optional<Plan> plan, Objective objective) {
  if (plan && (!best || cost(*plan, objective) < cost(*best, objective))) best = std::move(plan);
}

/// Those that the options ask for.
class Auditors final : public sat::ClauseObserver {
 public:
  Auditors(const Model& model, const SolveOptions& options) {
    if (options.debug.known_plan) of_plan_.emplace(model, *options.debug.known_plan);
    if (!options.debug.audit) return;
    of_lemmas_.emplace(model);
    of_cores_.emplace();
  }
  [[nodiscard]] bool is_needed() const { return of_plan_ || of_lemmas_; }
  void on_lemma(const sat::Lemma& lemma) override {
    if (of_plan_) of_plan_->on_lemma(lemma);
    if (of_lemmas_) of_lemmas_->on_lemma(lemma);
    if (of_cores_) of_cores_->on_lemma(lemma);
  }
  void on_learned(std::span<const sat::Lit> clause) override {
    if (of_plan_) of_plan_->on_learned(clause);
  }
  void on_core(std::span<const sat::Lit> clause) override {
    if (of_cores_) of_cores_->on_core(clause);
  }
  /// Null if cores are not audited.
  [[nodiscard]] sat::CoreAuditor* of_cores() { return of_cores_ ? &*of_cores_ : nullptr; }
  /// The first of each kind.
  [[nodiscard]] std::optional<std::string> complaint() const {
    if (of_lemmas_ && of_lemmas_->complaint()) return of_lemmas_->complaint();
    if (of_cores_ && of_cores_->complaint()) return of_cores_->complaint();
    return of_plan_ ? of_plan_->complaint() : std::nullopt;
  }

 private:
  std::optional<KnownPlanAuditor> of_plan_;
  std::optional<LemmaAuditor> of_lemmas_;
  std::optional<sat::CoreAuditor> of_cores_;
};

/// Tells of the progress and of better plans in the pauses of the search, as often as the options
/// say.
class ProgressReport final : public sat::YieldPoint {
 public:
  ProgressReport(const SolveOptions& options, const LimitMonitor& limits,
                 const SolveOutcome& outcome)
      : options_(options),
        limits_(limits),
        outcome_(outcome),
        next_s_(limits.elapsed_wall() + options.progress_interval_s) {}
  void set_incumbent(Cost cost) { incumbent_ = cost; }
  [[nodiscard]] std::optional<Cost> incumbent() const { return incumbent_; }

  void yield() override {
    const double now = limits_.elapsed_wall();
    if (options_.on_progress && now >= next_s_) {
      options_.on_progress({outcome_.lower_bound, incumbent_, now, limits_.conflicts()});
      next_s_ = now + options_.progress_interval_s;
    }
    if (options_.on_plan && incumbent_ && incumbent_ != reported_cost_ && now >= next_plan_s_) {
      options_.on_plan(*outcome_.plan);
      reported_cost_ = incumbent_;
      next_plan_s_ = now + options_.plan_interval_s;
    }
  }

 private:
  const SolveOptions& options_;
  const LimitMonitor& limits_;
  const SolveOutcome& outcome_;
  std::optional<Cost> incumbent_, reported_cost_;
  double next_s_, next_plan_s_ = 0;
};

/// What the agents cost when each is alone. Requires that all can reach their goals then.
Cost free_bound(const Scene& scene, Objective objective) {
  Cost bound = 0;
  for (const AgentId i : scene.instance().agent_ids())
    bound = objective == Objective::sum_of_costs ? bound + scene.free_cost(i)
                                                 : std::max(bound, scene.free_cost(i));
  return bound;
}

void find_plan(const Instance& instance, const SolveOptions& options, LimitMonitor& limits,
               SolveOutcome& outcome) {
  Scene scene(instance, limits);
  if (!scene.is_complete()) return;
  Model model(scene);
  const auto is_blocked = [&](const std::vector<AgentId>& blocked) {
    if (blocked.empty()) return false;
    outcome.status = Status::infeasible;
    outcome.explanation = blocked_text(blocked, instance.num_agents());
    return true;
  };
  Cost floor = outcome.lower_bound = free_bound(scene, options.objective);
  std::optional<Plan> some_plan;
  /// Whether that is all.
  const auto learn = [&](Cost bound, std::optional<Plan> plan) {
    floor = outcome.lower_bound = std::max(floor, bound);
    keep_cheaper(some_plan, std::move(plan), options.objective);
    outcome.plan = some_plan;  // the answer if a limit is met
    if (!some_plan || cost(*some_plan, options.objective) != floor) return false;
    outcome.status = Status::optimal;
    return true;
  };
  const bool is_joint_first =
      options.joint_work > 0 && options.system == System::dpll && is_small(instance);
  if (is_joint_first) {
    SmallReport report = search_small_instance(scene, options.objective, options.joint_work);
    if (is_blocked(report.blocked) || learn(report.lower_bound, std::move(report.plan))) return;
  }
  if (options.route_work > 0 && options.system == System::dpll &&
      instance.num_agents() <= kMaxRouteAgents) {
    auto routes = search_routes(scene, options.objective, options.route_work);
    if (learn(routes.lower_bound, std::move(routes.plan))) return;
  }
  if (!some_plan || is_joint_first)
    keep_cheaper(some_plan, find_first_plan(scene), options.objective);
  if (!some_plan && !is_joint_first) {
    Feasibility feasibility = check_feasibility(scene);
    if (is_blocked(feasibility.blocked)) return;
    some_plan = std::move(feasibility.plan);
  }
  outcome.plan = some_plan;  // the answer if a limit is met
  ContinuousTheory theory(model);
  Auditors auditors(model, options);
  const bool in_search = options.system == System::dpll;
  sat::EngineOptions engine_options;
  engine_options.seed = options.seed;
  engine_options.observer = auditors.is_needed() ? &auditors : nullptr;
  sat::Engine engine(in_search ? &theory : nullptr, engine_options);
  ProgressReport progress(options, limits, outcome);
  CostProblem problem(model, engine, theory, in_search, &progress, auditors.of_cores());

  const auto on_report = [&](const CostReport& report) {
    outcome.lower_bound = std::max(floor, report.lower_bound);
    if (!report.plan) return;
    const Cost cost_of_plan = cost(*report.plan, options.objective);
    if (progress.incumbent() != cost_of_plan) outcome.plan = report.plan;  // if a limit is met
    progress.set_incumbent(cost_of_plan);
    const Cost bound = outcome.lower_bound;
    if (bound < cost_of_plan && is_within_gap(options.gap_percent, cost_of_plan, bound))
      limits.stop(StopReason::gap);
    progress.yield();
  };
  const auto report =
      options.objective == Objective::sum_of_costs
          ? search_by_covers(
                problem, std::move(some_plan),
                options.debug.known_plan ? cost(*options.debug.known_plan, options.objective) : 0,
                limits, outcome.statistics, on_report)
          : search_makespan(problem, std::move(some_plan), limits, outcome.statistics, on_report);
  outcome.lower_bound = std::max(floor, report.lower_bound);
  outcome.plan.reset();
  engine.add_statistics(outcome.statistics);
  outcome.statistics.checks = theory.num_checks();
  if (const auto complaint = auditors.complaint()) {
    outcome.internal_error = Error{ErrorCode::internal, *complaint, {}};
  } else if (report.end == sat::SearchEnd::exhausted) {
    outcome.status = Status::infeasible;
    outcome.explanation = "every combination of paths collides";
  } else if (report.plan) {
    outcome.plan = report.plan;
    const bool is_proved = report.end == sat::SearchEnd::found ||
                           cost(*report.plan, options.objective) == outcome.lower_bound;
    outcome.status = is_proved ? Status::optimal : Status::feasible;
  }
}

/// What is claimed must not contradict the known plan.
void check_known_plan(const SolveOptions& options, SolveOutcome& outcome) {
  const Cost known = cost(*options.debug.known_plan, options.objective);
  if (outcome.status == Status::infeasible)
    outcome.internal_error = Error{ErrorCode::internal, "infeasible, but a plan is known", {}};
  else if (known < outcome.lower_bound)
    outcome.internal_error =
        Error{ErrorCode::internal,
              "the known plan costs " + std::to_string(known) + " and the proven bound is " +
                  std::to_string(outcome.lower_bound),
              {}};
}

/// The plan has to pass `verify` and to cost what was proved.
void check_plan(const Instance& instance, const SolveOptions& options, SolveOutcome& outcome) {
  hold_to_replay(verify(instance, *outcome.plan), options.objective, outcome);
}

/// The answer of a search that was cut short.
void keep_best(const SolveOptions& options, SolveOutcome& outcome) {
  outcome.status = outcome.plan ? Status::feasible : Status::unknown;
  if (outcome.plan && cost(*outcome.plan, options.objective) == outcome.lower_bound)
    outcome.status = Status::optimal;
}

/// Fills in what was found and proved, and checks its plan. Throws what callbacks throw.
void answer(const Instance& instance, const SolveOptions& options, LimitMonitor& limits,
            SolveOutcome& outcome) {
  try {
    try {
      find_plan(instance, options, limits, outcome);
    } catch (const LimitReached&) {
      keep_best(options, outcome);
    } catch (const std::bad_alloc&) {
      // The search's memory is free again: the bound and the best plan are the answer.
      outcome.stop = StopReason::memory;
      keep_best(options, outcome);
    }
    if (outcome.plan && !outcome.internal_error) check_plan(instance, options, outcome);
  } catch (const std::bad_alloc&) {
    outcome.stop = StopReason::memory;
    outcome.status = Status::unknown;
    outcome.plan.reset();
    outcome.cost.reset();
  }
  if (outcome.status == Status::optimal || outcome.status == Status::infeasible)
    outcome.stop = StopReason::none;
}

std::string stop_text(StopReason reason) {
  if (reason == StopReason::gap) return "the gap is as small as was asked for";
  if (reason == StopReason::memory) return "no more memory";  // short: needs no memory itself
  return "stopped by a limit: " + std::string(to_string(reason));
}

}  // namespace

std::string_view to_string(System system) noexcept {
  return system == System::dpll ? "dpll" : "smt-cbs";
}

std::optional<System> parse_system(std::string_view text) noexcept {
  for (const System system : {System::dpll, System::smt_cbs})
    if (text == to_string(system)) return system;
  return std::nullopt;
}

Result<SolveOutcome> solve(const Instance& instance, const SolveOptions& options) {
  if (auto error = check_options(instance, options)) return *std::move(error);
  SolveOutcome outcome;
  LimitMonitor limits(options.limits);
  answer(instance, options, limits, outcome);
  if (options.debug.known_plan && !outcome.internal_error) check_known_plan(options, outcome);
  if (outcome.internal_error) {
    outcome.status = Status::unknown;
    outcome.plan.reset();
    outcome.cost.reset();
    outcome.explanation = outcome.internal_error->message;
  } else if (outcome.status == Status::unknown || outcome.status == Status::feasible) {
    if (outcome.stop == StopReason::none) outcome.stop = limits.reason();
    outcome.explanation = stop_text(outcome.stop);
  }
  outcome.statistics.cpu_s = limits.elapsed_cpu();
  outcome.statistics.wall_s = limits.elapsed_wall();
  outcome.statistics.peak_rss_mib = peak_rss_mib();
  return outcome;
}

}  // namespace quadrille::continuous
