// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "quadrille/continuous/instance.hpp"
#include "quadrille/continuous/plan.hpp"
#include "quadrille/core/attribution.hpp"
#include "quadrille/core/export.hpp"
#include "quadrille/core/limits.hpp"
#include "quadrille/core/outcome.hpp"
#include "quadrille/core/progress.hpp"
#include "quadrille/core/result.hpp"
#include "quadrille/core/statistics.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::continuous {

using quadrille::Phase;
using quadrille::Progress;

/// When paths and their collisions are looked at.
enum class System {
  dpll,     ///< The default: inside the SAT search.
  smt_cbs,  ///< Between its complete assignments.
};
[[nodiscard]] std::string_view to_string(System system) noexcept;  ///< "dpll" | "smt-cbs"
[[nodiscard]] std::optional<System> parse_system(std::string_view text) noexcept;

/// See SolveOptions::route_work.
inline constexpr std::size_t kMaxRouteAgents = 6;

/// Checks of the solver's own work. An error of the program then ends in an internal error instead
/// of a wrong answer. Slow.
struct DebugOptions {
  /// Derive every lemma again from what it rests on, by other means.
  bool audit = false;
  /// A valid plan. Every clause is checked to allow it; no clause may exclude a valid plan,
  /// whatever it costs.
  std::optional<Plan> known_plan;
};

struct SolveOptions {
  Objective objective = Objective::sum_of_costs;
  System system = System::dpll;
  Limits limits;
  /// A plan to begin with, so that no first one is looked for: the answer costs no more, whenever
  /// a limit ends the search. It has to be valid.
  std::optional<Plan> initial_plan;
  /// No plan costs less, in ticks: known from elsewhere, such as an earlier solve. At least 0. The
  /// search begins from it, and what rests on it alone says so: SolveOutcome::rests_on_known_bound.
  std::optional<Cost> known_lower_bound;
  /// Stop when the plan costs at most this many per cent more than the proven lower bound, see
  /// quadrille/core/outcome.hpp. Not negative.
  std::optional<double> gap_percent;
  std::uint32_t seed = 0;  ///< 0 .. 2'000'000'000
  /// Searches side by side, 1 .. kMaxThreads, each in a thread of its own: the first one raises the
  /// lower bound, the second one makes plans cheaper and then helps it, as further ones do. They
  /// begin where route_work and joint_work have not sufficed.
  std::size_t threads = 1;
  /// With threads: do not wait for each other, and take the proof that comes first in time. The
  /// plan, not its cost, may differ from run to run then.
  bool race = false;
  /// Of dpll: effort, in comparisons of times, for looking at all routes of at most kMaxRouteAgents
  /// agents before the search; about 10^8 take a second. 0: none.
  std::int64_t route_work = 50'000'000;
  /// Effort for the joint search of small instances, which comes before everything else: about 10^8
  /// take a second. 0: none.
  std::int64_t joint_work = 200'000'000;
  /// Called on the solving thread when a phase begins, and else about once in `progress_interval_s`
  /// seconds. May be empty. What it throws ends the search and comes out of `solve`.
  std::function<void(const Progress&)> on_progress;
  double progress_interval_s = 0.25;  ///< At least 0.
  /// Called on the solving thread with the best plan so far, if it is cheaper than at the last
  /// call, at most once in `plan_interval_s` seconds; the answer may be better still. May be empty.
  /// What it throws ends the search and comes out of `solve`.
  std::function<void(const Plan&)> on_plan;
  double plan_interval_s = 1;  ///< At least 0.
  /// Say what the lower bound is made of: SolveOutcome::attribution. With one thread. The search is
  /// the same; without route_work and joint_work, which know no cores, more is explained.
  bool explain = false;
  DebugOptions debug;
};

struct SolveOutcome {
  Status status = Status::unknown;
  std::optional<Plan> plan;  ///< Present for optimal and feasible; verified.
  std::optional<Cost> cost;  ///< Of `plan`, in ticks.
  Cost lower_bound = 0;      ///< Proven, in ticks, for every status but infeasible.
  /// `lower_bound` is SolveOptions::known_lower_bound, and less than that was proved; an optimal
  /// plan is optimal only if no plan costs less than that.
  bool rests_on_known_bound = false;
  StopReason stop = StopReason::none;
  std::string explanation;  ///< For infeasible: why. For unknown: what stopped the search.
  /// For infeasible: whom the explanation names, and the vertices that each of them has to pass on
  /// whatever way, in the order in which the first one comes to them. Either may be empty.
  std::vector<AgentId> blocked;
  std::vector<VertexId> bottleneck;
  Statistics statistics;
  /// With `explain`, for every status but infeasible; absent if a limit was met before the free
  /// costs were known.
  std::optional<Attribution> attribution;
  /// A check of the program's own work failed; status is unknown then.
  std::optional<Error> internal_error;
};

/// Finds a plan of least cost among all plans whose departures are at whole ticks. `infeasible` is
/// a proof: found at once for two agents that cannot pass each other, and for all agents if they
/// are few on a small roadmap. On other instances without a plan the search may also go on until a
/// limit ends it: `unknown` then. If a limit ends the search and
/// some plan is known, that is `feasible`. Deterministic for the same instance, options and seed as
/// long as no limit is met. Does not print. Thread-safe. Errors: out_of_range (an option,
/// or `known_lower_bound` if a plan is found that costs less, or given), invalid_plan
/// (`initial_plan` or `debug.known_plan` is not a plan of the instance; with the first violation).
///
/// When memory runs out before a limit is met, the outcome is `feasible` or `unknown` with
/// StopReason::memory, as if a limit had been met; memory that the SAT solver held then may be
/// lost to the process. Throws what `on_progress` throws, and std::bad_alloc if there is no memory
/// even for the outcome.
[[nodiscard]] Result<SolveOutcome> solve(const Instance& instance, const SolveOptions& options);

}  // namespace quadrille::continuous

QUADRILLE_API_END
