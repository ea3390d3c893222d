// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>

#include "quadrille/core/export.hpp"
#include "quadrille/core/limits.hpp"
#include "quadrille/core/outcome.hpp"
#include "quadrille/discrete/goal_distances.hpp"
#include "quadrille/discrete/instance.hpp"
#include "quadrille/discrete/plan.hpp"

// Upper bounds. PrimalSearch finds some plan soon, PlanImprover makes a plan cheaper; neither
// proves anything about costs. Both can be run in slices of a given *effort*, a count of elementary
// steps (a fraction of a microsecond each): what they do depends on instance, options, seed and the
// efforts asked for, never on clocks; limits only cut them short.

QUADRILLE_API_BEGIN

namespace quadrille::discrete {

/// Looks for a plan of any cost, soon rather than cheap: LaCAM with PIBT as generator of
/// configurations (Okumura, "LaCAM: search-based algorithm for quick multi-agent pathfinding", AAAI
/// 2023; Okumura et al., "Priority inheritance with backtracking", AIJ 2022), guided by paths that
/// avoid each other (Han and Yu, ICRA 2022) or, where that gives a dear plan, by such paths for the
/// next timesteps only (Arita and Okumura, arXiv 2510.19072), with restarts. Where that does not
/// end soon, agents
/// are settled one after the other, which finds a plan in polynomial time if there is one
/// (docs/complete.md). Where at least three in four vertices are taken all begins with that, or on
/// small boards with a beam search; and a plan that costs more than twice what the agents cost
/// alone is made cheaper in windows of time before the search is over. Memory grows by about 12
/// bytes per agent and configuration visited.
class PrimalSearch {
 public:
  enum class State {
    searching,  ///< `advance` can go on.
    found,      ///< There is a plan. `advance` may find a cheaper one unless the search is over.
    exhausted,  ///< Every reachable configuration was visited: there is no plan.
  };

  /// Two threads may share the work: one takes the first of the guided searches that all begins
  /// with, the other one all the rest.
  enum class Part { all, first_guide, rest };

  /// `distances` are those of `instance`. Requires that each agent has one goal only.
  PrimalSearch(const Instance& instance, std::shared_ptr<const GoalDistances> distances,
               std::uint32_t seed, Part part = Part::all);
  ~PrimalSearch();
  PrimalSearch(PrimalSearch&&) noexcept;
  PrimalSearch& operator=(PrimalSearch&&) noexcept;

  /// Searches on until `effort` more is spent, a limit is met or the search is over.
  State advance(std::int64_t effort, LimitMonitor& limits);
  [[nodiscard]] State state() const noexcept;
  [[nodiscard]] bool is_over() const noexcept;       ///< `advance` does nothing any more.
  [[nodiscard]] bool is_at_guides() const noexcept;  ///< The guided searches are not done.
  /// Agents are being settled, which ends with a plan, or a plan is made cheaper that costs more
  /// than twice what the agents cost alone: no bound is worth as much.
  [[nodiscard]] bool is_worth_waiting_for() const noexcept;
  [[nodiscard]] std::int64_t effort() const noexcept;  ///< Spent so far.
  /// In the end, without a plan: the configurations that can be reached, all of which were visited;
  /// 0 before, and where some goal cannot be reached.
  [[nodiscard]] std::size_t num_configurations() const noexcept;
  /// The cheapest so far, trimmed. Requires State::found. O(size of the plan).
  [[nodiscard]] Plan plan() const;
  [[nodiscard]] Cost cost() const;  ///< Its sum of costs. Requires State::found.
  /// What found the first plan: "beam search", "lacam" or "settling"; empty before.
  [[nodiscard]] std::string_view origin() const noexcept;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// Some plan; nullopt when a limit was met or when there is none. Where agents have several goals,
/// one that ends with a choice of them for which check_feasibility knows a plan; nullopt also when
/// it knows none.
[[nodiscard]] std::optional<Plan> find_plan(const Instance& instance, LimitMonitor& limits,
                                            std::uint32_t seed);

/// Makes a plan cheaper by large-neighbourhood search (Li et al., "Anytime multi-agent path finding
/// via large neighborhood search", IJCAI 2021): takes a few agents out of the plan, gives them new
/// paths one after the other, and keeps the result unless it is costlier. Which agents are taken
/// out together, and how many, is learned from what paid. One thread.
///
/// The objective decides first. For the makespan the sum of costs breaks ties.
class PlanImprover {
 public:
  /// Requires that `plan` is a valid plan of `instance`, and `distances` its distances.
  PlanImprover(const Instance& instance, std::shared_ptr<const GoalDistances> distances,
               Objective objective, const Plan& plan, std::uint32_t seed);
  ~PlanImprover();
  PlanImprover(PlanImprover&&) noexcept;
  PlanImprover& operator=(PlanImprover&&) noexcept;

  /// One neighbourhood. True if the plan is cheaper now (or as dear, with a smaller sum of costs).
  /// When a limit is met on the way the plan stays as it was.
  bool step(LimitMonitor& limits);
  /// Steps until `effort` more is spent, a limit is met, or the plan costs `target` or less. True
  /// if the plan is cheaper than before.
  bool improve(std::int64_t effort, LimitMonitor& limits, Cost target = 0);

  /// Goes on from another plan, a cheaper one that was found elsewhere for instance. Requires a
  /// valid plan of the same instance. What was learned is kept.
  void restart_from(const Plan& plan);

  [[nodiscard]] const Plan& plan() const noexcept;     ///< Trimmed, always valid.
  [[nodiscard]] Cost cost() const noexcept;            ///< Of the objective.
  [[nodiscard]] std::int64_t effort() const noexcept;  ///< Spent so far.
  /// Every agent takes a shortest path: no plan is better, and steps do nothing.
  [[nodiscard]] bool is_ideal() const noexcept;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace quadrille::discrete

QUADRILLE_API_END
