// SPDX-License-Identifier: MIT
#include "solve/portfolio.hpp"

#include <algorithm>
#include <condition_variable>
#include <exception>
#include <memory>
#include <mutex>
#include <new>
#include <optional>
#include <thread>
#include <tuple>
#include <utility>
#include <vector>

namespace quadrille::discrete {
namespace {

/// Elementary steps of a round: a fraction of a second.
constexpr std::int64_t kRound = 500'000;

/// Who is in which round, and who has won.
class Rounds {
 public:
  Rounds(std::size_t num_workers, bool race) : workers_(num_workers), race_(race) {}

  void on_effort(std::size_t worker, std::int64_t effort) {
    if (race_ || effort < next_round_at(worker)) return;
    std::unique_lock lock(mutex_);
    Worker& me = workers_[worker];
    me.round = effort / kRound;
    decide();
    changed_.notify_all();
    changed_.wait(lock, [&] {
      return over_ || std::all_of(workers_.begin(), workers_.end(), [&](const Worker& other) {
               return other.has_ended || other.round >= me.round;
             });
    });
    me.next_round_at = (me.round + 1) * kRound;
  }

  void end(std::size_t worker, bool has_proof) {
    const std::lock_guard lock(mutex_);
    workers_[worker].has_ended = true;
    workers_[worker].has_proof = has_proof;
    decide();
    changed_.notify_all();
  }

  /// Ends all searches, without an answer.
  void cancel() {
    const std::lock_guard lock(mutex_);
    over_ = true;
    changed_.notify_all();
  }

  [[nodiscard]] std::optional<std::size_t> winner() const { return winner_; }
  [[nodiscard]] const std::atomic<bool>& over() const { return over_; }

 private:
  struct Worker {
    std::int64_t round = 0;
    std::int64_t next_round_at = kRound;  // the worker's own
    bool has_ended = false, has_proof = false;
  };

  [[nodiscard]] std::int64_t next_round_at(std::size_t worker) const {
    return workers_[worker].next_round_at;
  }

  /// The proof of the earliest round, among these that of the first worker, wins as soon as nobody
  /// can come before it any more.
  void decide() {
    if (winner_) return;
    const auto place = [&](std::size_t w) { return std::make_pair(workers_[w].round, w); };
    std::optional<std::size_t> best;
    for (std::size_t w = 0; w < workers_.size(); ++w)
      if (workers_[w].has_proof && (!best || place(w) < place(*best))) best = w;
    if (!best) return;
    for (std::size_t w = 0; w < workers_.size() && !race_; ++w)
      if (!workers_[w].has_ended && place(w) < place(*best)) return;
    winner_ = best;
    over_ = true;
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Worker> workers_;
  const bool race_;
  std::optional<std::size_t> winner_;
  std::atomic<bool> over_ = false;
};

class WorkerCompanion final : public Companion {
 public:
  WorkerCompanion(Rounds& rounds, std::size_t worker, std::shared_ptr<ResourceAccount> account)
      : rounds_(rounds), worker_(worker), account_(std::move(account)) {}
  void on_effort(std::int64_t effort) override { rounds_.on_effort(worker_, effort); }
  const std::atomic<bool>& cancelled() const override { return rounds_.over(); }
  std::shared_ptr<ResourceAccount> account() const override { return account_; }

 private:
  Rounds& rounds_;
  std::size_t worker_;
  std::shared_ptr<ResourceAccount> account_;
};

/// What another worker does: the lazy model with the other way to backtrack, then the MDD model.
SolveOptions options_of(const SolveOptions& options, const Tuner& tuner, std::size_t worker) {
  if (worker == 0) return options;
  using Kind = CheckSchedule::Kind;
  SolveOptions other = options;
  other.on_progress = {};
  other.on_plan = {};
  other.first_plan = false;
  other.cost_search = CostSearch::core_guided;
  other.mdd.growth = MddGrowth::on_demand;
  const std::size_t variant = (worker - 1) % 4;
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
  if (winner) return std::move(outcomes[*winner]);
  for (SolveOutcome& outcome : outcomes)
    if (outcome.internal_error) return std::move(outcome);
  std::size_t best = 0;
  Cost bound = 0;
  for (std::size_t w = 0; w < outcomes.size(); ++w) {
    bound = std::max(bound, outcomes[w].lower_bound);
    if (outcomes[w].cost && (!outcomes[best].cost || *outcomes[w].cost < *outcomes[best].cost))
      best = w;
  }
  SolveOutcome answer = std::move(outcomes[best]);
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
  Rounds rounds(options.threads, options.race);
  std::vector<SolveOutcome> outcomes(options.threads);
  std::vector<std::exception_ptr> failures(options.threads);
  const auto account = std::make_shared<ResourceAccount>();
  const auto work = [&](std::size_t worker) {
    try {
      WorkerCompanion companion(rounds, worker, account);
      outcomes[worker] =
          solve_alone(instance, options_of(options, tuner, worker), tuner, &companion);
    } catch (const std::bad_alloc&) {
      outcomes[worker].stop = StopReason::memory;  // the others may still come to an end
    } catch (...) {
      failures[worker] = std::current_exception();
      rounds.cancel();
    }
    rounds.end(worker, !failures[worker] && is_proof(outcomes[worker]));
  };
  {
    std::vector<std::jthread> threads;
    for (std::size_t worker = 1; worker < options.threads; ++worker) {
      try {
        threads.emplace_back(work, worker);
      } catch (const std::exception&) {  // no more threads, or no more memory for one
        rounds.end(worker, false);
      }
    }
    work(0);
  }
  for (const std::exception_ptr& failure : failures)
    if (failure) std::rethrow_exception(failure);
  SolveOutcome answer = combine(std::move(outcomes), rounds.winner(), options);
  answer.statistics.cpu_s = account->cpu_s();
  answer.statistics.wall_s = account->wall_s();
  return answer;
}

}  // namespace quadrille::discrete
