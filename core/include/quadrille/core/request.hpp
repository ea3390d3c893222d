// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "quadrille/core/attribution.hpp"
#include "quadrille/core/export.hpp"
#include "quadrille/core/ids.hpp"
#include "quadrille/core/limits.hpp"
#include "quadrille/core/outcome.hpp"
#include "quadrille/core/progress.hpp"
#include "quadrille/core/result.hpp"
#include "quadrille/core/settings.hpp"
#include "quadrille/core/statistics.hpp"

QUADRILLE_API_BEGIN

namespace quadrille {

/// What may be asked of a solve whatever plans are made of, and in whatever units.
struct Choices {
  Objective objective = Objective::sum_of_costs;
  /// Stop when the plan costs at most this many per cent more than the proven lower bound, see
  /// gap_percent. Not negative.
  std::optional<double> gap_percent = {};
  std::uint32_t seed = 0;  ///< 0 .. kMaxSeed
  /// More than one: that many searches side by side. They exchange bounds and plans; the first
  /// proof is the answer. 1 .. kMaxThreads.
  std::size_t threads = 1;
  /// With several threads, exchange at once and take the proof that comes first in time. Otherwise
  /// all goes by steps, so that the answer is always the same.
  bool race = false;
  Settings settings;  ///< For measurements; in their ranges.

  static constexpr std::uint32_t kMaxSeed = 2'000'000'000;
};

/// Checks of the solver's own work. An error of the program then ends in an internal error instead
/// of a wrong answer. Slow.
template <class Plan>
struct DebugRequest {
  /// Derive every lemma again from what it rests on, by other means.
  bool audit = false;
  /// A valid plan. Every clause is checked to allow it; no clause may exclude a valid plan,
  /// whatever it costs.
  std::optional<Plan> known_plan;
};

/// What a solve is asked, in both domains. Costs are timesteps or ticks.
template <class Plan>
struct Request : Choices {
  Limits limits;
  /// A plan to begin with, so that no first one is looked for: the answer costs no more, whenever
  /// a limit ends the search. It has to be valid.
  std::optional<Plan> initial_plan;
  /// No plan costs less: known from elsewhere, such as an earlier solve. At least 0. The search
  /// begins from it, and what rests on it alone says so: Outcome::rests_on_known_bound.
  std::optional<Cost> known_lower_bound;
  /// Called on the solving thread when a phase begins, and else about once in `progress_interval_s`
  /// seconds; between two calls of the SAT solver, never inside of one, which takes a second or so.
  /// May be empty. What it throws ends the search and comes out of `solve`.
  std::function<void(const Progress&)> on_progress;
  double progress_interval_s = 0.25;  ///< At least 0.
  /// Called likewise with the best plan so far, if it is cheaper than at the last call, at most
  /// once in `plan_interval_s` seconds; the answer may be better still.
  std::function<void(const Plan&)> on_plan;
  double plan_interval_s = 1;  ///< At least 0.
  /// Say what the lower bound is made of: Outcome::attribution. With one thread. The search is the
  /// same.
  bool explain = false;
  DebugRequest<Plan> debug;
};

/// What a solve answers: docs/cli.md has the table of what follows from what is known in the end.
/// `Price` is what costs are told in.
template <class Plan, class Price = Cost>
struct Outcome {
  Status status = Status::unknown;
  std::optional<Plan> plan;   ///< Present for optimal and feasible; verified.
  std::optional<Price> cost;  ///< Of `plan`, by the objective.
  Price lower_bound{};        ///< Proven, for every status but infeasible.
  /// `lower_bound` is Request::known_lower_bound, and less than that was proved; an optimal plan is
  /// optimal only if no plan costs less than that.
  bool rests_on_known_bound = false;
  StopReason stop = StopReason::none;
  /// For infeasible: why. For unknown: what ended the search, or which check failed. Else empty.
  std::string explanation;
  /// For infeasible: whom the explanation names, and the vertices of the place where they are in
  /// each other's way. Either may be empty.
  std::vector<AgentId> blocked;
  std::vector<VertexId> bottleneck;
  Statistics statistics;
  /// With `explain`, for every status but infeasible; absent if a limit was met before the free
  /// costs were known.
  std::optional<Attribution> attribution;
  /// A check of the program's own work failed; status is unknown then.
  std::optional<Error> internal_error;
};

}  // namespace quadrille

QUADRILLE_API_END
