// SPDX-License-Identifier: MIT
#include "quadrille/fleet/solver.hpp"

#include <cmath>
#include <utility>

#include "conversions.hpp"
#include "numbers.hpp"
#include "quadrille/continuous/duration_error.hpp"
#include "quadrille/core/usage.hpp"
#include "solving.hpp"

namespace quadrille::fleet {
namespace {

std::optional<double> number(const std::optional<Seconds>& time) {
  if (!time) return std::nullopt;
  return time->value();
}

/// `instance` outlives the result.
continuous::SolveOptions in_units(const Fleet& fleet, const continuous::Resolution& resolution,
                                  const SolveOptions& options) {
  continuous::SolveOptions result;
  static_cast<Choices&>(result) = options;
  result.limits.wall_s = number(options.limits.wall);
  result.limits.cpu_s = number(options.limits.cpu);
  result.limits.memory_mib = options.limits.memory_mib;
  result.limits.conflicts = options.limits.conflicts;
  result.limits.interrupt = options.limits.interrupt;
  if (options.initial_plan) result.initial_plan = options.initial_plan->in_units();
  if (options.known_lower_bound)  // What is out of range becomes a negative number, and is refused.
    result.known_lower_bound =
        continuous::quantise_bound(options.known_lower_bound->value(), resolution).value_or(-1);
  result.progress_interval_s = options.progress_interval.value();
  result.plan_interval_s = options.plan_interval.value();
  if (options.on_progress)
    result.on_progress = [resolution, &options](const continuous::Progress& progress) {
      Progress seen;
      seen.phase = progress.phase;
      seen.lower_bound = in_seconds(progress.lower_bound, resolution);
      if (progress.cost) seen.cost = in_seconds(*progress.cost, resolution);
      seen.elapsed = Seconds(progress.elapsed_s);
      seen.conflicts = progress.conflicts;
      options.on_progress(seen);
    };
  if (options.on_plan)
    result.on_plan = [&fleet, &options](const continuous::Plan& plan) {
      // It has not been verified yet; one that fails is an internal error, which the end tells.
      if (const auto timed = TimedPlan::make(fleet, plan)) options.on_plan(*timed);
    };
  return result;
}

/// What the rounding of durations does to the outcome.
void look_at_durations(const Fleet& fleet, const continuous::Instance& instance,
                       SolveOutcome& outcome) {
  const auto worst = continuous::largest_duration_error(instance);
  if (!worst) return;
  outcome.duration_error = worst->relative;
  if (worst->relative < continuous::kNotableDurationError) return;
  const auto digits = [](double value) {
    const double scale = std::pow(10, 3 - std::ceil(std::log10(value)));
    return std::round(value * scale) / scale;
  };
  const Roadmap& roads = fleet.roadmap();
  const continuous::Edge& lane = instance.roadmap().edge(worst->edge);
  outcome.warnings.push_back(
      "durations are rounded by up to " + shortest(digits(100 * worst->relative)) +
      " %: the lane from " + roads.name(lane.from) + " to " + roads.name(lane.to) +
      " is planned to take '" + fleet.name(worst->agent) + "' " +
      to_string(in_seconds(worst->planned, instance.resolution())) + " instead of " +
      to_string(Seconds(digits(worst->exact * instance.resolution().time))) +
      "; a smaller resolution of time than " + to_string(roads.resolution().time) + " mends that");
}

/// In the words of the fleet; the layer below would have agents and ticks.
std::optional<Error> refuse_initial_plan(const Fleet& fleet, const SolveOptions& options) {
  if (!options.initial_plan) return std::nullopt;
  if (auto error = refuse_other_units(fleet, *options.initial_plan, "the initial plan"))
    return error;
  const auto report = verify(fleet, options.initial_plan->in_units());
  if (!report) return report.error();
  if (report->valid()) return std::nullopt;
  return Error{ErrorCode::invalid_plan,
               "the initial plan is none: " + report->violations.front().message,
               {}};
}

}  // namespace

std::optional<Error> refuse_other_units(const Fleet& fleet, const TimedPlan& plan,
                                        const std::string& what) {
  const continuous::Resolution given = plan.instance().resolution();
  const continuous::Resolution own = fleet.roadmap().unit_sizes();
  if (given.length == own.length && given.time == own.time) return std::nullopt;
  return Error{ErrorCode::invalid_plan, what + " has another resolution", {}};
}

Result<SolveOutcome> solve(const Fleet& fleet, const SolveOptions& options) {
  return solve_with(fleet, options, [](const auto& instance, const auto& asked) {
    return continuous::solve(instance, asked);
  });
}

Result<SolveOutcome> solve_with(const Fleet& fleet, const SolveOptions& options,
                                const Search& search) {
  SolveOutcome outcome;
  const auto instance = fleet.instance();
  if (!instance && instance.error().code == ErrorCode::no_plan) {
    outcome.status = Status::infeasible;
    outcome.explanation = instance.error().message;
    return outcome;
  }
  if (!instance) return instance.error();
  if (auto error = refuse_initial_plan(fleet, options)) return *std::move(error);
  const continuous::Resolution resolution = instance->resolution();
  look_at_durations(fleet, *instance, outcome);
  const continuous::SolveOptions asked = in_units(fleet, resolution, options);
  auto solved = search(*instance, asked);
  if (!solved) return solved.error();

  outcome.status = solved->status;
  outcome.lower_bound = in_seconds(solved->lower_bound, resolution);
  outcome.rests_on_known_bound = solved->rests_on_known_bound;
  outcome.stop = solved->stop;
  outcome.explanation = std::move(solved->explanation);
  outcome.blocked = solved->blocked;
  outcome.bottleneck = solved->bottleneck;
  outcome.statistics = solved->statistics;
  outcome.internal_error = std::move(solved->internal_error);
  if (!solved->plan) return outcome;
  auto timed = TimedPlan::make(fleet, *solved->plan);
  if (!timed) {
    outcome.status = Status::unknown;
    outcome.internal_error = std::move(timed).error();
    outcome.explanation = outcome.internal_error->message;
    return outcome;
  }
  outcome.plan = std::move(timed).value();
  if (solved->cost) outcome.cost = in_seconds(*solved->cost, resolution);
  return outcome;
}

std::string SolveOutcome::summary() const {
  std::string text(to_string(status));
  switch (status) {
    case Status::optimal:
      return text + ": " + to_string(cost.value_or(lower_bound));
    case Status::feasible: {
      const Seconds most = cost.value_or(lower_bound);
      text += ": " + to_string(most) + ", at least " + to_string(lower_bound);
      if (lower_bound > Seconds(0)) {
        const double gap = 100 * ((most - lower_bound) / lower_bound);
        text += " (gap " + shortest(std::round(gap * 100) / 100) + " %)";
      }
      return text;
    }
    case Status::infeasible:
    case Status::unknown:
      return text + ": " + explanation;
  }
  return text;
}

}  // namespace quadrille::fleet
