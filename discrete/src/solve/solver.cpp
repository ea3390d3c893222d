// SPDX-License-Identifier: MIT
#include "quadrille/discrete/solver.hpp"

#include <new>
#include <optional>
#include <utility>

#include "mdd/usages.hpp"
#include "quadrille/core/plan_claim.hpp"
#include "quadrille/core/progress.hpp"
#include "quadrille/discrete/feasibility.hpp"
#include "quadrille/discrete/verify.hpp"
#include "solve/portfolio.hpp"
#include "solve/search.hpp"

namespace quadrille::discrete {
namespace {

/// The plan has to pass `verify` and to cost what was proved.
void check_plan(const Instance& instance, const SolveOptions& options, SolveOutcome& outcome) {
  trim(*outcome.plan);
  hold_to_replay(verify(instance, *outcome.plan), options.objective, options.known_lower_bound,
                 outcome);
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
  for (const CheckSchedule::Fraction& f : options.mdd.check.fractions) {
    if (f.denominator <= 0 || reaches(last, f) || reaches(f, {1, 1}))
      return refuse(ErrorCode::out_of_range,
                    "the fractions of a check schedule increase between 0 and 1");
    last = f;
  }
  if (options.gap_percent && !(*options.gap_percent >= 0))
    return refuse(ErrorCode::out_of_range, "the gap is not a number of at least 0");
  if (options.threads < 1 || options.threads > kMaxThreads)
    return refuse(ErrorCode::out_of_range, "the number of threads is not from 1 to 64");
  if (!(options.progress_interval_s >= 0))
    return refuse(ErrorCode::out_of_range, "the progress interval is not a number of at least 0");
  if (!(options.plan_interval_s >= 0))
    return refuse(ErrorCode::out_of_range, "the plan interval is not a number of at least 0");
  if (options.seed > 2'000'000'000)
    return refuse(ErrorCode::out_of_range, "the seed is larger than 2000000000");
  if (options.explain && (options.system != System::dpll || options.threads > 1))
    return refuse(ErrorCode::out_of_range, "an explanation needs the system dpll and one thread");
  if (options.known_lower_bound && *options.known_lower_bound < 0)
    return refuse(ErrorCode::out_of_range, "the known lower bound is negative, or out of range");
  std::optional<Error> error;
  if (options.initial_plan) {
    const VerifyReport report = verify(instance, *options.initial_plan);
    error = refuse_invalid(report, "initial plan");
    if (!error)
      error = refuse_bound(options.known_lower_bound, options.objective == Objective::sum_of_costs
                                                          ? report.sum_of_costs
                                                          : report.makespan);
  }
  if (!error && options.debug.known_plan)
    error = refuse_invalid(verify(instance, *options.debug.known_plan), "known plan");
  return error;
}

/// Fills in what was found, proved and checked. Throws what callbacks throw, and bad_alloc when
/// memory does not even suffice for the answer.
void answer(const Instance& instance, const SolveOptions& options, const Tuning& tuning,
            LimitMonitor& limits, Companion* companion, SolveOutcome& outcome) {
  ProgressReporter(options.on_progress, options.progress_interval_s, limits)
      .enter(Phase::feasibility);
  const Feasibility feasibility = check_feasibility(instance);
  if (!feasibility.feasible) {
    outcome.status = Status::infeasible;
    outcome.explanation = feasibility.reason;
    if (options.initial_plan)
      outcome.internal_error = Error{ErrorCode::internal, "infeasible, but a plan is known", {}};
    return;
  }
  search(instance, options, tuning, limits, companion, outcome);
  if (!outcome.plan) return;
  check_plan(instance, options, outcome);
  if (outcome.internal_error && outcome.stop == StopReason::memory) {
    // It was being changed when memory ran out.
    outcome.internal_error.reset();
    outcome.plan.reset();
    outcome.status = Status::unknown;
  }
}

void complete(Attribution& attribution, const SolveOutcome& outcome) {
  attribution.lower_bound = outcome.lower_bound;
  if (outcome.plan)
    for (const AgentId i : IdRange<AgentId>(attribution.agents.size()))
      attribution.agents[i].cost = arrival(outcome.plan->paths[i]);
  fit_to_bound(attribution);
}

std::string stop_text(StopReason reason) {
  if (reason == StopReason::none)
    return "a path needs 2^20 timesteps or more: the MDD systems do not support it";
  if (reason == StopReason::memory) return "no more memory";  // short: needs no memory itself
  return "stopped by the limit: " + std::string(to_string(reason));
}

}  // namespace

SolveOutcome solve_alone(const Instance& instance, const SolveOptions& options, const Tuner& tuner,
                         Companion* companion) {
  SolveOutcome outcome;
  LimitMonitor limits(options.limits, companion != nullptr ? companion->account() : nullptr);
  if (companion != nullptr) limits.set_cancel(&companion->cancelled());
  try {
    answer(instance, options, tuner(options), limits, companion, outcome);
  } catch (const LimitReached&) {  // before there was anything to tell
  } catch (const std::bad_alloc&) {
    outcome.status = Status::unknown;
    outcome.plan.reset();
    outcome.cost.reset();
    outcome.stop = StopReason::memory;
  }
  if (outcome.status == Status::feasible || outcome.status == Status::unknown) {
    if (outcome.stop == StopReason::none) outcome.stop = limits.reason();
    if (outcome.status == Status::unknown || outcome.stop == StopReason::none)
      outcome.explanation = stop_text(outcome.stop);
  } else {
    outcome.stop = StopReason::none;
  }
  if (outcome.internal_error) {
    outcome.status = Status::unknown;
    outcome.plan.reset();
    outcome.cost.reset();
    outcome.explanation = outcome.internal_error->message;
    outcome.attribution.reset();
    outcome.rests_on_known_bound = false;
  }
  if (outcome.attribution) complete(*outcome.attribution, outcome);
  outcome.statistics.cpu_s = limits.elapsed_cpu();
  outcome.statistics.wall_s = limits.elapsed_wall();
  outcome.statistics.peak_rss_mib = peak_rss_mib();
  return outcome;
}

Result<SolveOutcome> solve_tuned(const Instance& instance, const SolveOptions& options,
                                 const Tuner& tuner) {
  if (auto error = check_options(instance, options)) return *std::move(error);
  SolveOutcome outcome = options.threads > 1 ? solve_portfolio(instance, options, tuner)
                                             : solve_alone(instance, options, tuner, nullptr);
  // A bound that was given wrongly is an error of the input.
  if (outcome.internal_error && outcome.internal_error->code == ErrorCode::out_of_range)
    return *std::move(outcome.internal_error);
  return outcome;
}

Result<SolveOutcome> solve(const Instance& instance, const SolveOptions& options) {
  return solve_tuned(instance, options, tuner_for(instance));
}

}  // namespace quadrille::discrete
