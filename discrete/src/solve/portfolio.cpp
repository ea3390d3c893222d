// SPDX-License-Identifier: MIT
#include "solve/portfolio.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "mdd/mdd_model.hpp"
#include "quadrille/discrete/goal_distances.hpp"
#include "solve/search.hpp"

namespace quadrille::discrete {
namespace {

/// Rounds by which messages are old, so that workers wait less. Measured with 0, 1 and 2, two
/// threads, wall time: warehouse-20-40-10-2-1 with 1,000 agents to a gap of 2 % 8.6, 7.9 and 8.0 s,
/// random-64-64-20 with 500 to 4.5 % 7.8, 6.6 and 6.9 s, empty-48-48 with 600 to 1.2 % 14.5, 12.3
/// s.
constexpr std::int64_t kLag = 1;

/// What another worker does: plans, the lazy model with the other way to backtrack, the MDD model.
/// The MDD model knows no waypoints, no turns, and no prices of goals: with any of these or goal
/// sets the lazy model takes its place, set otherwise.
SolveOptions options_of(const Instance& instance, const SolveOptions& options, const Tuner& tuner,
                        std::size_t worker) {
  if (worker == 0 || (worker == 1 && options.first_plan)) return options;
  using Kind = CheckSchedule::Kind;
  SolveOptions other = options;
  other.first_plan = false;
  other.cost_search = CostSearch::core_guided;
  other.mdd.growth = MddGrowth::on_demand;
  const std::size_t variant = (worker - (options.first_plan ? 2 : 1)) % 4;
  if (variant == 0 || instance.has_goal_sets() || !MddModel::knows(instance)) {
    other.lazy.chronological = options.system == System::dpll && !tuner(options).chronological;
    other.system = System::dpll;
    other.lazy.forbid_first = variant == 1 ? !options.lazy.forbid_first : options.lazy.forbid_first;
    if (variant > 1)
      other.seed =
          static_cast<std::uint32_t>((options.seed + variant) % (SolveOptions::kMaxSeed + 1));
  } else {
    other.system = System::dpll_mdd;
    other.mdd.check = {variant == 2 ? Kind::watch : Kind::propagate, {}};
    if (variant == 3) other.cost_search = CostSearch::iterative;
  }
  return other;
}

}  // namespace

void search_side_by_side(const Instance& instance, const SolveOptions& options, const Tuner& tuner,
                         const std::shared_ptr<ResourceAccount>& account, const Desk& desk,
                         ProofDraft& proof) {
  GoalDistancesInTheMaking in_the_making(instance);
  const GetDistances get_distances = [&](LimitMonitor& limits) {
    return options.threads == 1 ? GoalDistances::make(instance, limits)
                                : in_the_making.join(limits);
  };
  const auto role_of = [&](std::size_t worker, bool is_second_missing) {
    // Without a second one the first one looks for plans itself.
    if (!options.first_plan || is_second_missing || worker > 1) return Role::all;
    return worker == 0 ? Role::bound : Role::plans;
  };
  std::vector<ProofDraft> proofs(std::max<std::size_t>(1, options.threads));
  const auto search_as = [&](std::size_t worker, const Desk& own) {
    const SolveOptions own_options = options_of(instance, options, tuner, worker);
    search(instance, own_options, tuner(own_options), own, get_distances, proofs[worker]);
  };
  const solve::Pace pace{Effort::microseconds(tuner(options).settings.grid_round), kLag};
  solve::Portfolio<Plan, Message>(options, account, pace, role_of, search_as).run(desk);
  for (ProofDraft& draft : proofs) {
    if (proof.fault.empty()) proof.fault = std::move(draft.fault);
    if (draft.proof && (!proof.proof || draft.proof->claim > proof.proof->claim))
      proof.proof = std::move(draft.proof);
  }
}

}  // namespace quadrille::discrete
