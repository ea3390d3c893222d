// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "quadrille/continuous/instance.hpp"
#include "quadrille/continuous/plan.hpp"

namespace quadrille::continuous::test {

/// The oracle: all combinations of routes of at most `max_moves` moves each. For each two of them,
/// all ways in which their agents get past each other are listed, which says of every move, and of
/// every stay that it could run into, who is first; then one way per pair is chosen, and a closed
/// matrix of least differences between moments says whether that is possible, and when at best.
/// Shares only instances and plans with the library.
struct OrderSearch {
  std::optional<Cost> best;  ///< Least cost; nullopt: no plan with such routes.
  Plan best_plan;
  std::vector<Plan> some_plans;  ///< Valid ones of any cost, at most ten.
};
[[nodiscard]] OrderSearch search_orders(const Instance& instance, Objective objective,
                                        std::size_t max_moves);

/// Some valid plans, the best ones for both objectives among them.
[[nodiscard]] std::vector<Plan> known_plans(const Instance& instance, std::size_t max_moves);

}  // namespace quadrille::continuous::test
