// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "quadrille/discrete/plan.hpp"
#include "quadrille/solve/portfolio.hpp"

namespace quadrille::discrete {

/// What searches tell each other besides bounds and plans: paths that may collide, null if there
/// are none; and what found the first plan.
struct Draft {
  std::shared_ptr<const Plan> paths;
  std::string origin;

  void hear(const Draft& other) {
    if (!paths) paths = other.paths;
    if (origin.empty()) origin = other.origin;
  }
};

using solve::Role;
using Knowledge = solve::Knowledge<Plan>;
using Message = solve::Message<Plan, Draft>;
using Desk = solve::Desk<Plan, Message>;

}  // namespace quadrille::discrete
