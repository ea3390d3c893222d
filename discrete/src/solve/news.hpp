// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <memory>

#include "quadrille/core/ids.hpp"
#include "quadrille/discrete/plan.hpp"

namespace quadrille::discrete {

/// What searches of the same instance tell each other, see Rounds.
struct News {
  Cost lower = 0;                     ///< Proven.
  std::shared_ptr<const Plan> plan;   ///< The cheapest; null if there is none.
  Cost cost = 0;                      ///< What it costs.
  std::shared_ptr<const Plan> draft;  ///< Paths that may collide; null if there are none.
  bool others_ended = false;          ///< Nobody else is at work.

  void hear(const News& other) {
    lower = std::max(lower, other.lower);
    if (other.plan && (!plan || other.cost < cost)) {
      plan = other.plan;
      cost = other.cost;
    }
    if (!draft) draft = other.draft;
  }
};

}  // namespace quadrille::discrete
