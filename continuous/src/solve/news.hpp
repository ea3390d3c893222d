// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <vector>

#include "cover/core_table.hpp"
#include "quadrille/continuous/plan.hpp"
#include "quadrille/core/ids.hpp"

namespace quadrille::continuous {

/// What searches of the same instance tell each other, see Rounds.
struct News {
  Cost lower = 0;                    ///< Proven.
  std::shared_ptr<const Plan> plan;  ///< The cheapest; null if there is none.
  Cost cost = 0;                     ///< What it costs.
  /// Of every plan that is cheaper than `cost`: all that a teller has found, in that order.
  struct Cores {
    std::size_t teller;
    std::vector<std::shared_ptr<const LevelCore>> list;
  };
  std::vector<Cores> cores;   ///< No teller twice.
  bool others_ended = false;  ///< Nobody else is at work.

  /// Of different tellers.
  void hear(const News& other) {
    lower = std::max(lower, other.lower);
    if (other.plan && (!plan || other.cost < cost)) {
      plan = other.plan;
      cost = other.cost;
    }
    cores.insert(cores.end(), other.cores.begin(), other.cores.end());
  }
};

}  // namespace quadrille::continuous
