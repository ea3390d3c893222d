// SPDX-License-Identifier: MIT
#include "quadrille/core/outcome.hpp"

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

}  // namespace quadrille
