// SPDX-License-Identifier: MIT
#include "solve/portfolio.hpp"

#include <cstddef>
#include <utility>
#include <vector>

#include "quadrille/core/plan_claim.hpp"
#include "quadrille/core/portfolio.hpp"
#include "solve/companion.hpp"
#include "solve/cost_run.hpp"

namespace quadrille::continuous {
namespace {

constexpr std::uint32_t kMaxSeed = 2'000'000'000;

class WorkerCompanion final : public Companion {
 public:
  WorkerCompanion(Rounds<News>& rounds, std::size_t worker, Role role)
      : rounds_(rounds), worker_(worker), role_(role) {}
  std::size_t worker() const override { return worker_; }
  Role role() const override { return role_; }
  std::optional<News> on_effort(std::int64_t effort, const std::function<News()>& tell) override {
    return rounds_.arrive(worker_, effort, tell);
  }

 private:
  Rounds<News>& rounds_;
  const std::size_t worker_;
  const Role role_;
};

SolveOptions options_of(const SolveOptions& options, std::size_t worker) {
  SolveOptions other = options;
  if (worker == 0) return other;
  other.on_progress = {};
  other.on_plan = {};
  other.seed = static_cast<std::uint32_t>((options.seed + worker) % (kMaxSeed + 1));
  return other;
}

}  // namespace

SolveOutcome search_side_by_side(Scene& scene, const SolveOptions& options, const CostReport& known,
                                 LimitMonitor& limits,
                                 const std::shared_ptr<ResourceAccount>& account, const Pace& pace,
                                 const Inheritance& inheritance) {
  Rounds<News> rounds(options.threads, pace.round, options.race, pace.lag);
  bool has_second = true;
  const auto role_of = [&](std::size_t worker) {
    if (worker > 1) return Role::cores;
    if (worker == 1) return Role::plans;
    return has_second ? Role::bound : Role::all;
  };
  const auto solve = [&](std::size_t worker) {
    WorkerCompanion companion(rounds, worker, role_of(worker));
    const SolveOptions own_options = options_of(options, worker);
    if (worker == 0)
      return search_alone(scene, own_options, known, limits, &companion, inheritance);
    LimitMonitor own_limits(options.limits, account);
    own_limits.set_cancel(&rounds.over());
    try {
      Scene own_scene(scene.instance(), own_limits);
      if (own_scene.is_complete())
        return search_alone(own_scene, own_options, known, own_limits, &companion);
    } catch (const LimitReached&) {  // while the scene was made
    }
    SolveOutcome outcome;
    outcome.stop = own_limits.reason();
    return outcome;
  };
  limits.set_cancel(&rounds.over());
  std::vector<SolveOutcome> outcomes;
  try {
    outcomes = solve_side_by_side<SolveOutcome>(rounds, solve, [&](std::size_t worker) {
      if (worker == 1) has_second = false;  // The first one does it all.
    });
  } catch (...) {
    limits.set_cancel(nullptr);
    throw;
  }
  limits.set_cancel(nullptr);
  // A plan that is cheaper than what the user knows is no contradiction of ours.
  for (SolveOutcome& outcome : outcomes)
    if (outcome.cost && refuse_bound(options.known_lower_bound, *outcome.cost))
      return std::move(outcome);
  return combine(std::move(outcomes), rounds.winner(), options.gap_percent);
}

}  // namespace quadrille::continuous
