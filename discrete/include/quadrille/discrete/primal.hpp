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

// Upper bounds: PrimalSearch finds some plan soon, and proves nothing about costs. It can be run in
// slices of a given *effort*, a count of elementary steps (a fraction of a microsecond each): what
// it does depends on instance, seed and the efforts asked for, never on clocks; limits only cut it
// short.

QUADRILLE_API_BEGIN

namespace quadrille::discrete {

/// Looks for a plan of any cost, soon rather than cheap: LaCAM with PIBT as generator of
/// configurations (Okumura, "LaCAM: search-based algorithm for quick multi-agent pathfinding", AAAI
/// 2023; Okumura et al., "Priority inheritance with backtracking", AIJ 2022), guided by paths that
/// avoid each other (Han and Yu, ICRA 2022) or, where that gives a dear plan, by such paths for the
/// next timesteps only (Arita and Okumura, arXiv 2510.19072), with restarts. Where that does not
/// end soon, agents are settled one after the other, which finds a plan in polynomial time if there
/// is one (docs/complete.md). Where at least three in four vertices are taken all begins with that,
/// or on small boards with a beam search; and a plan that costs more than twice what the agents
/// cost alone is made cheaper in windows of time before the search is over. Memory grows by about
/// 12 bytes per agent and configuration visited.
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
  /// The same, not copied.
  [[nodiscard]] std::shared_ptr<const Plan> shared_plan() const;
  [[nodiscard]] Cost cost() const;  ///< Its sum of costs. Requires State::found.
  /// What found the first plan: "beam search", "lacam" or "settling"; empty before.
  [[nodiscard]] std::string_view origin() const noexcept;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// Some plan; nullopt when a limit was met or when there is none. Where agents have several goals,
/// one that ends with a choice of them for which check_feasibility knows a plan; nullopt also when
/// it knows none, and of an instance with rules, which all searches for first plans do not know.
[[nodiscard]] std::optional<Plan> find_plan(const Instance& instance, LimitMonitor& limits,
                                            std::uint32_t seed);

}  // namespace quadrille::discrete

QUADRILLE_API_END
