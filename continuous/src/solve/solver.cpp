// SPDX-License-Identifier: MIT
#include "quadrille/continuous/solver.hpp"

#include <algorithm>
#include <memory>
#include <new>
#include <string>
#include <utility>

#include "quadrille/continuous/verify.hpp"
#include "quadrille/core/plan_claim.hpp"
#include "solve/cost_run.hpp"
#include "solve/inheritance.hpp"
#include "solve/phases.hpp"

namespace quadrille::continuous {
namespace {

std::optional<Error> check_options(const Instance& instance, const SolveOptions& options) {
  if (options.seed > 2'000'000'000)
    return Error{ErrorCode::out_of_range, "the seed is larger than 2000000000", {}};
  if (options.gap_percent && !(*options.gap_percent >= 0))
    return Error{ErrorCode::out_of_range, "the gap is not a number of at least 0", {}};
  if (options.threads < 1 || options.threads > kMaxThreads)
    return Error{ErrorCode::out_of_range, "the number of threads is not from 1 to 64", {}};
  if (options.explain && options.threads > 1)
    return Error{ErrorCode::out_of_range, "an explanation needs one thread", {}};
  if (!(options.progress_interval_s >= 0))
    return Error{
        ErrorCode::out_of_range, "the progress interval is not a number of at least 0", {}};
  if (!(options.plan_interval_s >= 0))
    return Error{ErrorCode::out_of_range, "the plan interval is not a number of at least 0", {}};
  if (options.known_lower_bound && *options.known_lower_bound < 0)
    return Error{ErrorCode::out_of_range, "the known lower bound is negative, or out of range", {}};
  std::optional<Error> error;
  if (options.initial_plan) {
    error = refuse_invalid(verify(instance, *options.initial_plan), "initial plan");
    if (!error)
      error =
          refuse_bound(options.known_lower_bound, cost(*options.initial_plan, options.objective));
  }
  if (!error && options.debug.known_plan)
    error = refuse_invalid(verify(instance, *options.debug.known_plan), "known plan");
  return error;
}

void complete(Attribution& attribution, const SolveOutcome& outcome) {
  attribution.lower_bound = outcome.lower_bound;
  if (outcome.plan)
    for (const AgentId i : IdRange<AgentId>(attribution.agents.size()))
      attribution.agents[i].cost = cost(outcome.plan->paths[i]);
  fit_to_bound(attribution);
}

/// What is claimed must not contradict a plan that the user gave.
void check_known_plan(const Plan& plan, const SolveOptions& options, SolveOutcome& outcome) {
  const Cost known = cost(plan, options.objective);
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
  hold_to_replay(verify(instance, *outcome.plan), options.objective, options.known_lower_bound,
                 outcome);
}

/// Fills in what was found and proved, and checks its plan. Throws what callbacks throw.
void answer(const Instance& instance, const SolveOptions& options, const Inheritance& inheritance,
            LimitMonitor& limits, const std::shared_ptr<ResourceAccount>& account,
            SolveOutcome& outcome) {
  try {
    try {
      Phases(instance, options, inheritance, limits, account, outcome).run();
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
  return solve(instance, options, Inheritance{});
}

Result<SolveOutcome> solve(const Instance& instance, const SolveOptions& options,
                           const Inheritance& inheritance) {
  if (auto error = check_options(instance, options)) return *std::move(error);
  SolveOutcome outcome;
  const auto account = std::make_shared<ResourceAccount>();
  LimitMonitor limits(options.limits, account);
  answer(instance, options, inheritance, limits, account, outcome);
  for (const auto* plan : {&options.initial_plan, &options.debug.known_plan})
    if (*plan && !outcome.internal_error) check_known_plan(**plan, options, outcome);
  // A bound that was given wrongly is an error of the input.
  if (outcome.internal_error && outcome.internal_error->code == ErrorCode::out_of_range)
    return *std::move(outcome.internal_error);
  if (outcome.internal_error) {
    outcome.rests_on_known_bound = false;
    outcome.status = Status::unknown;
    outcome.plan.reset();
    outcome.cost.reset();
    outcome.explanation = outcome.internal_error->message;
    outcome.attribution.reset();
  } else if (outcome.status == Status::unknown || outcome.status == Status::feasible) {
    if (outcome.stop == StopReason::none) outcome.stop = limits.reason();
    outcome.explanation = stop_text(outcome.stop);
  }
  if (outcome.status == Status::infeasible) {
    outcome.attribution.reset();
    outcome.rests_on_known_bound = false;
  }
  if (outcome.attribution) complete(*outcome.attribution, outcome);
  outcome.statistics.cpu_s = limits.elapsed_cpu();
  outcome.statistics.wall_s = limits.elapsed_wall();
  outcome.statistics.peak_rss_mib = peak_rss_mib();
  return outcome;
}

}  // namespace quadrille::continuous
