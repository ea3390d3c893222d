// SPDX-License-Identifier: MIT
#include "solve/portfolio.hpp"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "quadrille/core/portfolio.hpp"

namespace quadrille::discrete {
namespace {

/// Rounds by which news are old, so that workers wait less. Measured with 0, 1 and 2, two threads,
/// wall time: warehouse-20-40-10-2-1 with 1,000 agents to a gap of 2 % 8.6, 7.9 and 8.0 s,
/// random-64-64-20 with 500 to 4.5 % 7.8, 6.6 and 6.9 s, empty-48-48 with 600 to 1.2 % 14.5, 12.3
/// s.
constexpr std::int64_t kLag = 1;

/// What all workers share.
struct Shared {
  Shared(const Instance& instance, const SolveOptions& options, std::int64_t round)
      : rounds(options.threads, round, options.race, kLag), distances(instance) {}

  Rounds<News> rounds;
  const std::shared_ptr<ResourceAccount> account = std::make_shared<ResourceAccount>();
  GoalDistancesInTheMaking distances;
};

class WorkerCompanion final : public Companion {
 public:
  WorkerCompanion(Shared& shared, std::size_t worker, Role role)
      : shared_(shared), worker_(worker), role_(role) {}

  Role role() const override { return role_; }
  std::optional<News> on_effort(std::int64_t effort, const std::function<News()>& tell) override {
    return shared_.rounds.arrive(worker_, effort, tell);
  }
  const std::atomic<bool>& cancelled() const override { return shared_.rounds.over(); }
  std::shared_ptr<ResourceAccount> account() const override { return shared_.account; }
  std::shared_ptr<const GoalDistances> distances(LimitMonitor& limits) override {
    return shared_.distances.join(limits);
  }

 private:
  Shared& shared_;
  std::size_t worker_;
  Role role_;
};

Role role_of(std::size_t worker, bool has_planner) {
  if (!has_planner || worker > 1) return Role::both;
  return worker == 0 ? Role::bound : Role::plans;
}

/// What another worker does: plans, the lazy model with the other way to backtrack, the MDD model.
SolveOptions options_of(const SolveOptions& options, const Tuner& tuner, std::size_t worker) {
  if (worker == 0) return options;
  using Kind = CheckSchedule::Kind;
  SolveOptions other = options;
  other.on_progress = {};
  other.on_plan = {};
  if (role_of(worker, options.first_plan) == Role::plans) return other;
  other.first_plan = false;
  other.cost_search = CostSearch::core_guided;
  other.mdd.growth = MddGrowth::on_demand;
  const std::size_t variant = (worker - (options.first_plan ? 2 : 1)) % 4;
  if (variant == 0) {
    other.lazy.chronological = options.system == System::dpll && !tuner(options).chronological;
    other.system = System::dpll;
  } else {
    other.system = System::dpll_mdd;
    other.mdd.check = {variant == 2 ? Kind::watch : Kind::propagate, {}};
    if (variant == 3) other.cost_search = CostSearch::iterative;
  }
  return other;
}

}  // namespace

SolveOutcome solve_portfolio(const Instance& instance, const SolveOptions& options,
                             const Tuner& tuner) {
  Shared shared(instance, options, tuner(options).round);
  bool has_planner = options.first_plan;
  std::vector<SolveOutcome> outcomes = solve_side_by_side<SolveOutcome>(
      shared.rounds,
      [&](std::size_t worker) {
        WorkerCompanion companion(shared, worker, role_of(worker, has_planner));
        return solve_alone(instance, options_of(options, tuner, worker), tuner, &companion);
      },
      [&](std::size_t worker) {
        if (worker == 1) has_planner = false;  // The first one looks for plans itself.
      });
  const auto rests = [](const SolveOutcome& outcome) { return outcome.rests_on_known_bound; };
  // Who looks for plans ends all when its plan is as cheap as the bounds that it heard ask for. The
  // search is that of others.
  if (has_planner) outcomes[1].statistics = outcomes[0].statistics;
  const bool rest_all = std::all_of(outcomes.begin(), outcomes.end(), rests);
  SolveOutcome answer = combine(std::move(outcomes), shared.rounds.winner(), options.gap_percent);
  answer.rests_on_known_bound = rest_all && answer.lower_bound == options.known_lower_bound;
  answer.statistics.cpu_s = shared.account->cpu_s();
  answer.statistics.wall_s = shared.account->wall_s();
  return answer;
}

}  // namespace quadrille::discrete
