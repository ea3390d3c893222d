// SPDX-License-Identifier: MIT
#include "solve/portfolio.hpp"

#include <algorithm>
#include <cstddef>
#include <exception>
#include <memory>
#include <mutex>
#include <new>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

namespace quadrille::discrete {
namespace {

/// What all workers share.
struct Shared {
  Shared(const Instance& the_instance, const SolveOptions& options, std::int64_t round)
      : instance(the_instance), rounds(options.threads, round, options.race) {}

  const Instance& instance;
  Rounds rounds;
  const std::shared_ptr<ResourceAccount> account = std::make_shared<ResourceAccount>();
  std::mutex mutex;
  std::shared_ptr<const GoalDistances> distances;
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
    const std::lock_guard lock(shared_.mutex);
    if (shared_.distances == nullptr)
      shared_.distances = GoalDistances::make(shared_.instance, limits);
    return shared_.distances;
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

bool is_proof(const SolveOutcome& outcome) {
  return !outcome.internal_error &&
         (outcome.status == Status::optimal || outcome.status == Status::infeasible ||
          (outcome.status == Status::feasible && outcome.stop == StopReason::gap));
}

SolveOutcome combine(std::vector<SolveOutcome> outcomes, std::optional<std::size_t> winner,
                     const SolveOptions& options) {
  for (SolveOutcome& outcome : outcomes)
    if (outcome.internal_error) return std::move(outcome);
  if (winner) return std::move(outcomes[*winner]);
  std::size_t best = 0;
  Cost bound = 0;
  for (std::size_t w = 0; w < outcomes.size(); ++w) {
    bound = std::max(bound, outcomes[w].lower_bound);
    if (outcomes[w].cost && (!outcomes[best].cost || *outcomes[w].cost < *outcomes[best].cost))
      best = w;
  }
  const Statistics statistics = outcomes.front().statistics;
  SolveOutcome answer = std::move(outcomes[best]);
  answer.statistics = statistics;
  answer.lower_bound = bound;
  if (!answer.cost) return answer;
  if (*answer.cost < bound) {
    answer.internal_error = Error{ErrorCode::internal,
                                  "a plan costs " + std::to_string(*answer.cost) +
                                      " and the proven bound is " + std::to_string(bound),
                                  {}};
    answer.status = Status::unknown;
    answer.explanation = answer.internal_error->message;
    answer.plan.reset();
    answer.cost.reset();
  } else if (*answer.cost == bound) {
    answer.status = Status::optimal;
    answer.stop = StopReason::none;
    answer.explanation.clear();
  } else if (is_within_gap(options.gap_percent, *answer.cost, bound)) {
    answer.stop = StopReason::gap;
  }
  return answer;
}

SolveOutcome solve_portfolio(const Instance& instance, const SolveOptions& options,
                             const Tuner& tuner) {
  Shared shared(instance, options, tuner(options).round);
  Rounds& rounds = shared.rounds;
  std::vector<SolveOutcome> outcomes(options.threads);
  std::vector<std::exception_ptr> failures(options.threads);
  bool has_planner = options.first_plan;
  const auto work = [&](std::size_t worker) {
    const Role role = role_of(worker, has_planner);
    SolveOutcome& outcome = outcomes[worker];
    try {
      WorkerCompanion companion(shared, worker, role);
      outcome = solve_alone(instance, options_of(options, tuner, worker), tuner, &companion);
    } catch (const std::bad_alloc&) {
      outcome.stop = StopReason::memory;  // the others may still come to an end
    } catch (...) {
      failures[worker] = std::current_exception();
      rounds.cancel();
    }
    // Whose plan and bound are wrong has to be seen, and must not be believed.
    News last;
    if (!failures[worker] && !outcome.internal_error) last.lower = outcome.lower_bound;
    const bool has_proof = !failures[worker] && role != Role::plans && is_proof(outcome);
    rounds.end(worker, has_proof, std::move(last));
  };
  {
    std::vector<std::jthread> threads;
    for (std::size_t worker = 1; worker < options.threads; ++worker) {
      try {
        threads.emplace_back(work, worker);
      } catch (const std::exception&) {  // no more threads, or no more memory for one
        rounds.end(worker, false, {});
        if (worker == 1) has_planner = false;  // The first one looks for plans itself.
      }
    }
    work(0);
  }
  for (const std::exception_ptr& failure : failures)
    if (failure) std::rethrow_exception(failure);
  SolveOutcome answer = combine(std::move(outcomes), rounds.winner(), options);
  answer.statistics.cpu_s = shared.account->cpu_s();
  answer.statistics.wall_s = shared.account->wall_s();
  return answer;
}

}  // namespace quadrille::discrete
