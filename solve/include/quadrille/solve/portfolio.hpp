// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "quadrille/core/effort.hpp"
#include "quadrille/core/request.hpp"
#include "quadrille/solve/exchange.hpp"
#include "quadrille/solve/knowledge.hpp"
#include "quadrille/solve/pulse.hpp"
#include "quadrille/solve/rounds.hpp"

namespace quadrille::solve {

/// What one search of a solve works with. All outlive it.
template <class Plan, class Message>
struct Desk {
  LimitMonitor& limits;
  Knowledge<Plan>& known;  ///< What it begins with, and all that it finds.
  Pulse<Plan>& pulse;
  Exchange<Message>& exchange;
};

/// How often searches exchange what they know, see Rounds: the effort between two exchanges, and
/// by how many rounds messages are old, so that searches wait less for each other.
struct Pace {
  Effort round;
  std::int64_t lag;
};

template <class Message>
class RoundsExchange final : public Exchange<Message> {
 public:
  RoundsExchange(Rounds<Message>& rounds, std::size_t worker, Role role)
      : rounds_(rounds), worker_(worker), role_(role) {}
  [[nodiscard]] bool has_others() const override { return true; }
  [[nodiscard]] std::size_t worker() const override { return worker_; }
  [[nodiscard]] Role role() const override { return role_; }
  [[nodiscard]] std::optional<Message> arrive(Effort effort,
                                              const std::function<Message()>& tell) override {
    return rounds_.arrive(worker_, effort, tell);
  }

 private:
  Rounds<Message>& rounds_;
  const std::size_t worker_;
  const Role role_;
};

/// The searches of one solve: one in the calling thread, at `desk`, or `request.threads` side by
/// side, each of the others in a thread of its own. All begin with what `desk.known` says, where
/// what they know in the end is, too. `account`: that of `desk.limits`. The first proof is the
/// answer.
///
/// `role_of(worker, is_second_missing)`: there may be no thread for the second one, and then none
/// for those after it. `search(worker, desk)` is one search.
///
/// Unless request.race, all pass through rounds of equal effort together, and of the proofs in the
/// earliest round that has one, that of the first search is taken: the same answer at any speed.
/// Rethrows what the first of them threw that threw at all.
template <class Plan, class Message>
class Portfolio {
 public:
  using Desk = solve::Desk<Plan, Message>;
  using RoleOf = std::function<Role(std::size_t worker, bool is_second_missing)>;
  using Search = std::function<void(std::size_t worker, const Desk& desk)>;

  Portfolio(const Request<Plan>& request, const std::shared_ptr<ResourceAccount>& account,
            const Pace& pace, RoleOf role_of, Search search)
      : request_(request),
        account_(account),
        pace_(pace),
        role_of_(std::move(role_of)),
        search_(std::move(search)) {}

  void run(const Desk& desk) {
    if (request_.threads == 1) {
      run_guarded(desk.known, desk.limits, [&] { search_(0, desk); });
      return;
    }
    Rounds<Message> rounds(request_.threads, pace_.round, request_.race, pace_.lag);
    std::vector<Knowledge<Plan>> others(request_.threads - 1, desk.known);
    desk.limits.set_cancel(&rounds.over());
    const std::exception_ptr failure = run_side_by_side(desk, rounds, others);
    desk.limits.set_cancel(nullptr);
    if (failure) std::rethrow_exception(failure);
    others.insert(others.begin(), std::move(desk.known));
    desk.known = merged(std::move(others), rounds.winner());
  }

 private:
  /// Returns what the first of them threw that threw at all.
  std::exception_ptr run_side_by_side(const Desk& desk, Rounds<Message>& rounds,
                                      std::vector<Knowledge<Plan>>& others) {
    std::vector<std::exception_ptr> failures(request_.threads);
    bool is_second_missing = false;
    const auto work = [&](std::size_t worker) {
      Knowledge<Plan>& known = worker == 0 ? desk.known : others[worker - 1];
      try {
        RoundsExchange<Message> exchange(rounds, worker, role_of_(worker, is_second_missing));
        if (worker == 0)
          run_guarded(known, desk.limits, [&] {
            search_(0, {desk.limits, known, desk.pulse, exchange});
          });
        else
          search_beside(worker, exchange, rounds, known);
      } catch (...) {
        failures[worker] = std::current_exception();
        rounds.cancel();
      }
      // Whose plan and bound are wrong has to be seen, and must not be believed.
      Message last;
      if (!failures[worker] && !known.error) last.lower = known.lower();
      const bool is_enough = is_proof(known, request_.gap_percent) ||
                             (worker == 0 && desk.limits.reason() == StopReason::gap);
      const bool has_proof = !failures[worker] && is_enough;
      rounds.end(worker, has_proof, std::move(last));
    };
    {
      std::vector<std::jthread> threads;
      for (std::size_t worker = 1; worker < request_.threads; ++worker) {
        try {
          threads.emplace_back(work, worker);
        } catch (const std::exception&) {  // no more threads, or no more memory for one
          rounds.end(worker, false, {});
          if (worker == 1) is_second_missing = true;
        }
      }
      work(0);
    }
    for (const std::exception_ptr& failure : failures)
      if (failure) return failure;
    return nullptr;
  }

  void search_beside(std::size_t worker, Exchange<Message>& exchange, const Rounds<Message>& rounds,
                     Knowledge<Plan>& known) {
    LimitMonitor limits(request_.limits, account_);
    limits.set_cancel(&rounds.over());
    Pulse<Plan> pulse(request_, limits, known, false);
    run_guarded(known, limits, [&] { search_(worker, {limits, known, pulse, exchange}); });
  }

  const Request<Plan>& request_;
  const std::shared_ptr<ResourceAccount>& account_;
  const Pace pace_;
  const RoleOf role_of_;
  const Search search_;
};

}  // namespace quadrille::solve
