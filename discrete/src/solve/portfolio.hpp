// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

#include "quadrille/core/limits.hpp"
#include "quadrille/discrete/goal_distances.hpp"
#include "quadrille/discrete/solver.hpp"
#include "solve/news.hpp"
#include "solve/tuning.hpp"

namespace quadrille::discrete {

/// What a search is for, beside others.
enum class Role {
  both,   ///< Plans and the lower bound.
  bound,  ///< The lower bound; plans come from elsewhere, and are made of its drafts.
  plans,  ///< Plans only.
};

/// The others that a running search works with.
class Companion {
 public:
  virtual ~Companion() = default;
  [[nodiscard]] virtual Role role() const = 0;
  /// Called now and then with the elementary steps of the search so far. May wait. At the end of a
  /// round: `tell()` is told to the others, and what they told comes back.
  [[nodiscard]] virtual std::optional<News> on_effort(std::int64_t effort,
                                                      const std::function<News()>& tell) = 0;
  /// Set when the search is not needed any more.
  [[nodiscard]] virtual const std::atomic<bool>& cancelled() const = 0;
  /// Of all searches that run side by side.
  [[nodiscard]] virtual std::shared_ptr<ResourceAccount> account() const = 0;
  /// Computed by all together, once. Null when a limit was met.
  [[nodiscard]] virtual std::shared_ptr<const GoalDistances> distances(LimitMonitor& limits) = 0;
};

/// One search in the calling thread. `companion` may be null.
[[nodiscard]] SolveOutcome solve_alone(const Instance& instance, const SolveOptions& options,
                                       const Tuner& tuner, Companion* companion);

/// Several searches in threads of their own. The first one raises the lower bound with `options`,
/// the second one looks for plans and makes them cheaper, further ones search with other systems
/// (without options.first_plan the second one, too). They exchange bounds, plans and drafts. The
/// first proof is the answer. Requires options.threads > 1.
///
/// Unless options.race, all pass through rounds of equal effort together, and of the proofs in the
/// earliest round that has one, that of the first search is taken: the same answer at any speed.
[[nodiscard]] SolveOutcome solve_portfolio(const Instance& instance, const SolveOptions& options,
                                           const Tuner& tuner);

}  // namespace quadrille::discrete
