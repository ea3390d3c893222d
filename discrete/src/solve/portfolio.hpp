// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "quadrille/core/limits.hpp"
#include "quadrille/discrete/solver.hpp"
#include "solve/tuning.hpp"

namespace quadrille::discrete {

/// What others have to say about a running search.
class Companion {
 public:
  virtual ~Companion() = default;
  /// Called now and then with the elementary steps of the search so far. May wait.
  virtual void on_effort(std::int64_t effort) = 0;
  /// Set when the search is not needed any more.
  [[nodiscard]] virtual const std::atomic<bool>& cancelled() const = 0;
  /// Of all searches that run side by side.
  [[nodiscard]] virtual std::shared_ptr<ResourceAccount> account() const = 0;
};

/// One search in the calling thread. `companion` may be null.
[[nodiscard]] SolveOutcome solve_alone(const Instance& instance, const SolveOptions& options,
                                       const Tuner& tuner, Companion* companion);

/// Whether nothing more is to be done: not so after an internal error, which proves nothing.
[[nodiscard]] bool is_proof(const SolveOutcome& outcome);

/// The answer of several searches of one instance, not empty; `winner` has a proof. Without a proof
/// an internal error of any of them is the answer, because it has to be seen; otherwise that is the
/// cheapest plan with the largest bound, which may be as close together as `options` ask for.
[[nodiscard]] SolveOutcome combine(std::vector<SolveOutcome> outcomes,
                                   std::optional<std::size_t> winner, const SolveOptions& options);

/// Several searches in threads of their own, the first with `options` and the others with other
/// systems; the first proof is the answer. Requires options.threads > 1.
///
/// Unless options.race, all pass through rounds of equal effort together, and of the proofs in the
/// earliest round that has one, that of the first search is taken: the same answer at any speed.
[[nodiscard]] SolveOutcome solve_portfolio(const Instance& instance, const SolveOptions& options,
                                           const Tuner& tuner);

}  // namespace quadrille::discrete
