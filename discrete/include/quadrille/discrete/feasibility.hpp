// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "quadrille/discrete/instance.hpp"

namespace quadrille::discrete {

/// Whether any plan exists, of whatever cost.
struct Feasibility {
  bool feasible = true;
  std::string reason;  ///< When infeasible: one sentence that names agents and places.
};

/// Decides exactly, in polynomial time, whether an instance has a plan.
[[nodiscard]] Feasibility check_feasibility(const Instance& instance);

}  // namespace quadrille::discrete
