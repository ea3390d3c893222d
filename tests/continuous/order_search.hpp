// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "quadrille/continuous/instance.hpp"
#include "quadrille/continuous/plan.hpp"

namespace quadrille::continuous::test {

/// The oracle: for every combination of routes of at most `max_moves` moves each, and every order
/// in which moves and stays that are in each other's way can happen, the earliest times are the
/// longest paths of a system of difference constraints.
struct OrderSearch {
  std::optional<Cost> best;  ///< Least cost; nullopt: no plan with such routes.
  Plan best_plan;
  std::vector<Plan> some_plans;  ///< Valid ones of any cost, at most ten.
};
[[nodiscard]] OrderSearch search_orders(const Instance& instance, Objective objective,
                                        std::size_t max_moves);

}  // namespace quadrille::continuous::test
