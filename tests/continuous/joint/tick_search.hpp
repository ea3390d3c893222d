// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>

#include "quadrille/continuous/instance.hpp"
#include "quadrille/continuous/plan.hpp"

namespace quadrille::continuous::test {

/// The oracle for tiny instances with few ticks: all joint states, tick by tick. A state says of
/// each agent where it stands, or on which edge it is and for how many ticks, and, for the sum of
/// costs, whether it has decided to stay at its goal. Shares only instances with the library;
/// collisions come from `Meetings`.
struct TickSearch {
  bool is_complete = false;  ///< False: there were more than `max_states`.
  std::optional<Cost> best;  ///< Nullopt: there is no plan.
  std::size_t num_states = 0;
};
[[nodiscard]] TickSearch search_ticks(const Instance& instance, Objective objective,
                                      std::size_t max_states);

}  // namespace quadrille::continuous::test
