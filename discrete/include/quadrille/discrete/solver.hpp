// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "quadrille/core/certificate.hpp"
#include "quadrille/core/export.hpp"
#include "quadrille/core/request.hpp"
#include "quadrille/core/result.hpp"
#include "quadrille/discrete/instance.hpp"
#include "quadrille/discrete/plan.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::discrete {

using quadrille::Phase;
using quadrille::Progress;

/// Graphs with more vertices are not solved, by the systems with MDDs and by any.
inline constexpr std::size_t kMaxMddVertices = std::size_t{1} << 21;
inline constexpr std::size_t kMaxVertices = std::size_t{1} << 23;

/// The solving systems; docs/cli.md has a table of them.
enum class System {
  dpll,      ///< The default. Lazy path model: paths live in the theory.
  dpll_mdd,  ///< MDD path model, collision clauses made inside the search as `check` says.
  smt_cbs,   ///< MDD path model, collision clauses made after each complete assignment.
  mdd_sat,   ///< MDD path model, all collision clauses made before solving.
};
[[nodiscard]] std::string_view to_string(System system) noexcept;  ///< "dpll" | "dpll-mdd" | ...
[[nodiscard]] std::optional<System> parse_system(std::string_view text) noexcept;

/// When the DPLL systems check the consistency of an unfinished assignment. Complete assignments
/// are always checked.
struct CheckSchedule {
  enum class Kind {
    fractions,  ///< Once each time a given share of the literals has become assigned.
    watch,      ///< At each assignment, O(1) per literal.
    propagate,  ///< As watch, and a used vertex is denied to all other agents, with late reasons.
  };
  struct Fraction {
    std::int32_t numerator = 1, denominator = 2;
    friend bool operator==(const Fraction&, const Fraction&) = default;
  };
  Kind kind = Kind::watch;
  std::vector<Fraction> fractions;  ///< Increasing, each in (0, 1).
  friend bool operator==(const CheckSchedule&, const CheckSchedule&) = default;
};
/// Reads "watch", "propagate" or a list such as "1/2,3/4". Errors (out_of_range, syntax).
[[nodiscard]] Result<CheckSchedule> parse_check_schedule(std::string_view text);
[[nodiscard]] std::string to_string(const CheckSchedule& schedule);

/// How the least sum of costs is searched for.
enum class CostSearch {
  iterative,    ///< Bounds xi, xi+1, ... on the sum, as published.
  core_guided,  ///< Bounds on agents, relaxed where unsatisfiable cores name them.
};
[[nodiscard]] std::string_view to_string(CostSearch search) noexcept;  ///< "iterative" | ...
[[nodiscard]] std::optional<CostSearch> parse_cost_search(std::string_view text) noexcept;

/// How far the MDDs reach at first for a given cost bound.
enum class MddGrowth {
  on_demand,  ///< As far as cores of the search asked for.
  full,       ///< To all that the bound leaves to one agent, as published.
};
[[nodiscard]] std::string_view to_string(MddGrowth growth) noexcept;  ///< "on-demand" | "full"
[[nodiscard]] std::optional<MddGrowth> parse_mdd_growth(std::string_view text) noexcept;

/// Which of the plans of least cost is looked for.
enum class Tie {
  any,
  fewest_moves,  ///< One with as few moves in all as any: timesteps in which an agent does not
                 ///< wait.
};
[[nodiscard]] std::string_view to_string(Tie tie) noexcept;  ///< "any" | "fewest-moves"
[[nodiscard]] std::optional<Tie> parse_tie(std::string_view text) noexcept;

/// Of the systems with MDDs.
struct MddOptions {
  CheckSchedule check;  ///< Of dpll_mdd; the other systems check when they have to.
  MddGrowth growth = MddGrowth::on_demand;  ///< Of the iterative search.
};

/// Of dpll.
struct LazyOptions {
  /// Try first to forbid usages instead of allowing them. Much faster on some hard instances,
  /// slower on others.
  bool forbid_first = false;
  /// Backtrack chronologically, so that lemmas about the past leave later decisions alone. Absent:
  /// where there are many agents, for whom decisions that are made again cost more than what is
  /// gained by fresh ones.
  std::optional<bool> chronological;
};

using DebugOptions = DebugRequest<Plan>;

/// With more than one thread the first search raises the lower bound, the second makes plans (with
/// first_plan), further ones search with other systems.
struct SolveOptions : Request<Plan> {
  System system = System::dpll;
  /// For the sum of costs; the makespan is always searched upwards. Absent: core-guided for dpll,
  /// iterative for the published systems.
  std::optional<CostSearch> cost_search;
  MddOptions mdd;
  LazyOptions lazy;
  /// With fewest_moves a second search follows, in the MDD model whatever the system, when a plan
  /// is proved optimal. Not with goal sets, waypoints, turns or a gap.
  Tie tie = Tie::any;
  /// Look for a plan of any cost first and improve it while the bound rises (quadrille/discrete/
  /// primal.hpp): then a search that a limit ends has a plan. Under rules: of prioritised planning.
  bool first_plan = true;
  /// Keep all that the lower bound follows from, for SolveOutcome::certificate. Not with goal sets
  /// or rules. The search is the same. Takes 1 to 3 MB of memory per second and thread.
  bool proof = false;
};

/// How many moves a plan has.
struct Moves {
  std::int64_t number = 0;
  std::int64_t lower_bound = 0;  ///< No plan of least cost has fewer.
  /// The plan is one of least cost, and as many moves as the bound are proved to be needed.
  bool is_proved = false;
  friend bool operator==(const Moves&, const Moves&) = default;
};

/// Infeasible: see Feasibility. `explain` is for dpll, and not for instances with rules. With
/// `proof` there is a certificate, or a word why there is none.
struct SolveOutcome : Outcome<Plan>, CertifiedOutcome {
  /// With Tie::fewest_moves, where there is a plan.
  std::optional<Moves> moves;
};

/// Finds a plan of least cost, or proves that there is none. Deterministic for the same instance,
/// options and seed as long as no limit is met. Does not print. Thread-safe. Errors: out_of_range
/// (an option, `explain` or `proof` with what it is not for, more vertices than the system takes,
/// or `known_lower_bound` if a plan is found that costs less, or given), invalid_plan
/// (`initial_plan` or `debug.known_plan` is not a plan of the instance; with the first violation).
///
/// When memory runs out before a limit is met, the outcome is `feasible` or `unknown` with
/// StopReason::memory, as if a limit had been met; memory that the SAT solver held then may be
/// lost to the process. Throws what `on_progress` throws, and std::bad_alloc if there is no memory
/// even for the outcome.
[[nodiscard]] Result<SolveOutcome> solve(const Instance& instance, const SolveOptions& options);

}  // namespace quadrille::discrete

QUADRILLE_API_END
