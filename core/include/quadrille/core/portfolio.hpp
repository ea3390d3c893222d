// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <exception>
#include <functional>
#include <new>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "quadrille/core/export.hpp"
#include "quadrille/core/ids.hpp"
#include "quadrille/core/outcome.hpp"
#include "quadrille/core/result.hpp"
#include "quadrille/core/rounds.hpp"

QUADRILLE_API_BEGIN

namespace quadrille {

/// Whether nothing more is to be done: not so after an internal error, which proves nothing.
template <class SolveOutcome>
[[nodiscard]] bool is_proof(const SolveOutcome& outcome) {
  return !outcome.internal_error &&
         (outcome.status == Status::optimal || outcome.status == Status::infeasible ||
          (outcome.status == Status::feasible && outcome.stop == StopReason::gap));
}

/// The answer of several searches of one instance, not empty; `winner` has a proof. An internal
/// error of any of them is the answer, because it has to be seen, and because a proof may rest on
/// what the others told. Otherwise that is the proof, or the cheapest plan with the largest bound,
/// which may be as close together as `wanted_gap` asks for (see is_within_gap), and the statistics
/// of the first.
template <class SolveOutcome>
[[nodiscard]] SolveOutcome combine(std::vector<SolveOutcome> outcomes,
                                   std::optional<std::size_t> winner,
                                   std::optional<double> wanted_gap) {
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
  const auto statistics = outcomes.front().statistics;
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
  } else if (is_within_gap(wanted_gap, *answer.cost, bound)) {
    answer.stop = StopReason::gap;
  }
  return answer;
}

/// Searches of one instance side by side, each in a thread of its own, the first one in the calling
/// thread. `solve(worker)` is one search, whose companion arrives at the rounds;
/// `on_missing(worker)` is called when there is no thread for it. Returns all outcomes, for
/// `combine`. Rethrows what the first of them threw that threw at all, except std::bad_alloc: the
/// others may still come to an end then.
template <class SolveOutcome, class News>
[[nodiscard]] std::vector<SolveOutcome> solve_side_by_side(
    Rounds<News>& rounds, const std::function<SolveOutcome(std::size_t)>& solve,
    const std::function<void(std::size_t)>& on_missing) {
  std::vector<SolveOutcome> outcomes(rounds.num_workers());
  std::vector<std::exception_ptr> failures(rounds.num_workers());
  const auto work = [&](std::size_t worker) {
    SolveOutcome& outcome = outcomes[worker];
    try {
      outcome = solve(worker);
    } catch (const std::bad_alloc&) {
      outcome.stop = StopReason::memory;
    } catch (...) {
      failures[worker] = std::current_exception();
      rounds.cancel();
    }
    // Whose plan and bound are wrong has to be seen, and must not be believed.
    News last;
    if (!failures[worker] && !outcome.internal_error) last.lower = outcome.lower_bound;
    const bool has_proof = !failures[worker] && is_proof(outcome);
    rounds.end(worker, has_proof, std::move(last));
  };
  {
    std::vector<std::jthread> threads;
    for (std::size_t worker = 1; worker < rounds.num_workers(); ++worker) {
      try {
        threads.emplace_back(work, worker);
      } catch (const std::exception&) {  // no more threads, or no more memory for one
        rounds.end(worker, false, {});
        on_missing(worker);
      }
    }
    work(0);
  }
  for (const std::exception_ptr& failure : failures)
    if (failure) std::rethrow_exception(failure);
  return outcomes;
}

}  // namespace quadrille

QUADRILLE_API_END
