// SPDX-License-Identifier: MIT
#include "quadrille/core/outcome.hpp"

#include <limits>

#include "quadrille/core/contract.hpp"

namespace quadrille {

std::string_view to_string(Objective objective) noexcept {
  switch (objective) {
    case Objective::sum_of_costs:
      return "sum-of-costs";
    case Objective::makespan:
      return "makespan";
  }
  return "?";
}

std::string_view to_string(Status status) noexcept {
  switch (status) {
    case Status::optimal:
      return "optimal";
    case Status::feasible:
      return "feasible";
    case Status::infeasible:
      return "infeasible";
    case Status::unknown:
      return "unknown";
  }
  return "?";
}

std::string_view to_string(StopReason reason) noexcept {
  switch (reason) {
    case StopReason::none:
      return "none";
    case StopReason::wall_time:
      return "wall-time";
    case StopReason::cpu_time:
      return "cpu-time";
    case StopReason::memory:
      return "memory";
    case StopReason::conflicts:
      return "conflicts";
    case StopReason::interrupt:
      return "interrupt";
    case StopReason::gap:
      return "gap";
  }
  return "?";
}

double gap_percent(Cost cost, Cost lower_bound) {
  QUADRILLE_REQUIRE(0 <= lower_bound && lower_bound <= cost, "a bound and a plan above it");
  if (cost == lower_bound) return 0;
  if (lower_bound == 0) return std::numeric_limits<double>::infinity();
  return 100 * static_cast<double>(cost - lower_bound) / static_cast<double>(lower_bound);
}

bool is_within_gap(std::optional<double> wanted, Cost cost, Cost lower_bound) {
  return wanted && gap_percent(cost, lower_bound) <= *wanted;
}

}  // namespace quadrille
