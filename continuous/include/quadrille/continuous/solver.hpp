// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "quadrille/continuous/instance.hpp"
#include "quadrille/continuous/plan.hpp"
#include "quadrille/core/certificate.hpp"
#include "quadrille/core/export.hpp"
#include "quadrille/core/request.hpp"
#include "quadrille/core/result.hpp"

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

using DebugOptions = DebugRequest<Plan>;

/// With more than one thread the first search raises the lower bound, the second makes plans
/// cheaper and then helps it, as further ones do. They begin where route_work and joint_work have
/// not sufficed. Without these two, which know no cores, `explain` has more to say.
struct SolveOptions : Request<Plan> {
  System system = System::dpll;
  /// Of dpll: effort, in comparisons of times, for looking at all routes of at most kMaxRouteAgents
  /// agents before the search; about 10^8 take a second. 0: none.
  std::int64_t route_work = 50'000'000;
  /// Effort for the joint search of small instances, which comes before everything else: about 10^8
  /// take a second. 0: none.
  std::int64_t joint_work = 200'000'000;
  /// Keep all that the lower bound follows from, for SolveOutcome::certificate. No two agents are
  /// searched together then by clauses; of joint search and of routes only the plans count, as do
  /// those of a session, and searches side by side tell each other no cores. Discs and spheres
  /// only, without goal sets and moving obstacles. Takes 1 to 3 MB of memory per second and thread.
  bool proof = false;
};

/// Infeasible: the agents that block each other, and the vertices that each of them has to pass on
/// whatever way, in the order in which the first one comes to them. With `proof` there is a
/// certificate, or a word why there is none.
struct SolveOutcome : Outcome<Plan>, CertifiedOutcome {};

/// Finds a plan of least cost among all plans whose departures are at whole ticks. `infeasible` is
/// a proof: found at once for two agents that cannot pass each other, and for all agents if they
/// are few on a small roadmap. On other instances without a plan the search may also go on until a
/// limit ends it: `unknown` then. If a limit ends the search and
/// some plan is known, that is `feasible`. Deterministic for the same instance, options and seed as
/// long as no limit is met. Does not print. Thread-safe. Errors: out_of_range (an option, `proof`
/// with what it is not for, or `known_lower_bound` if a plan is found that costs less, or given),
/// invalid_plan
/// (`initial_plan` or `debug.known_plan` is not a plan of the instance; with the first violation).
///
/// When memory runs out before a limit is met, the outcome is `feasible` or `unknown` with
/// StopReason::memory, as if a limit had been met; memory that the SAT solver held then may be
/// lost to the process. Throws what `on_progress` throws, and std::bad_alloc if there is no memory
/// even for the outcome.
[[nodiscard]] Result<SolveOutcome> solve(const Instance& instance, const SolveOptions& options);

}  // namespace quadrille::continuous

QUADRILLE_API_END
