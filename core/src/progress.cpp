// SPDX-License-Identifier: MIT
#include "quadrille/core/progress.hpp"

namespace quadrille {

std::string_view to_string(Phase phase) noexcept {
  switch (phase) {
    case Phase::set_up:
      return "set-up";
    case Phase::joint_search:
      return "joint-search";
    case Phase::routes:
      return "routes";
    case Phase::first_plan:
      return "first-plan";
    case Phase::feasibility:
      return "feasibility";
    case Phase::search:
      return "search";
  }
  return "?";
}

}  // namespace quadrille
