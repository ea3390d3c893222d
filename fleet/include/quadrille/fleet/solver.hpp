// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "quadrille/continuous/solver.hpp"
#include "quadrille/core/export.hpp"
#include "quadrille/core/progress.hpp"
#include "quadrille/core/request.hpp"
#include "quadrille/core/result.hpp"
#include "quadrille/fleet/fleet.hpp"
#include "quadrille/fleet/timed_plan.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::fleet {

/// What a search may use, see quadrille::Limits. An absent limit does not bind.
struct Limits {
  std::optional<Seconds> wall = {};
  std::optional<Seconds> cpu = {};  ///< Of all threads of the search together.
  std::optional<double> memory_mib = {};
  std::optional<std::int64_t> conflicts = {};
  const std::atomic<bool>* interrupt = nullptr;
};

/// A look at a running search.
struct Progress {
  Phase phase = Phase::set_up;
  Seconds lower_bound;
  std::optional<Seconds> cost;  ///< Of the best plan so far.
  Seconds elapsed;
  std::int64_t conflicts = 0;
};

/// As continuous::SolveOptions, where more is said.
struct SolveOptions : Choices {
  Limits limits = {};
  /// A plan to begin with, so that no first one is looked for: the answer costs no more, whenever a
  /// limit ends the search. It is verified first. One that was made for other roads or tasks will
  /// do if it is a plan of this fleet, too; one in whole units becomes one by TimedPlan::make.
  std::optional<TimedPlan> initial_plan = {};
  /// No plan costs less: known from elsewhere, such as an earlier solve. What rests on it alone
  /// says so. In ticks, it is rounded down.
  std::optional<Seconds> known_lower_bound = {};
  /// Called on the solving thread when a phase begins, and else about once in `progress_interval`,
  /// as Request says; what it throws ends the search and comes out of `solve`. May be empty.
  std::function<void(const Progress&)> on_progress = {};
  Seconds progress_interval = Seconds(0.25);
  /// Likewise with the best plan so far, if it is cheaper than at the last call, at most once in
  /// `plan_interval`; the answer may be better still.
  std::function<void(const TimedPlan&)> on_plan = {};
  Seconds plan_interval = Seconds(1);
};

struct SolveOutcome : Outcome<TimedPlan, Seconds> {
  /// What is not as it was asked for, in sentences: that durations are rounded by
  /// continuous::kNotableDurationError or more.
  std::vector<std::string> warnings;
  /// The largest relative error of the time that a robot takes for a lane that it may use, because
  /// it is rounded to whole steps: |rounded - exact| / exact.
  double duration_error = 0;

  /// One line, such as "feasible: 34.6 s, at least 33.8 s (gap 2.4 %)".
  [[nodiscard]] std::string summary() const;
};

/// Finds a plan of least cost among those whose departures are at multiples of the resolution of
/// time. That there is no plan is an outcome, `infeasible`, and never an error: also where it can
/// be seen at once, because starts or goals overlap or a goal cannot be reached. Errors: those of
/// `fleet.instance()` but no_plan; out_of_range (an option, or
/// `known_lower_bound` if a plan is found that costs less, or given); invalid_plan (`initial_plan`
/// is no plan of this fleet, with the first violation, or has another resolution). Otherwise as
/// continuous::solve.
[[nodiscard]] Result<SolveOutcome> solve(const Fleet& fleet, const SolveOptions& options = {});

}  // namespace quadrille::fleet

QUADRILLE_API_END
