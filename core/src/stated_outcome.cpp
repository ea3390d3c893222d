// SPDX-License-Identifier: MIT
#include "quadrille/core/stated_outcome.hpp"

namespace quadrille {

std::optional<Objective> parse_objective(std::string_view text) noexcept {
  for (const Objective objective : {Objective::sum_of_costs, Objective::makespan})
    if (text == to_string(objective)) return objective;
  return std::nullopt;
}

std::optional<Status> parse_status(std::string_view text) noexcept {
  for (const Status status :
       {Status::optimal, Status::feasible, Status::infeasible, Status::unknown})
    if (text == to_string(status)) return status;
  return std::nullopt;
}

}  // namespace quadrille
