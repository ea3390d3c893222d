// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "cover/core_table.hpp"
#include "quadrille/continuous/plan.hpp"
#include "quadrille/solve/portfolio.hpp"

namespace quadrille::continuous {

/// What searches tell each other besides bounds and plans: of every plan that is cheaper than that
/// of the message, all cores that a teller has found, in that order.
struct ToldCores {
  struct Of {
    std::size_t teller;
    std::vector<std::shared_ptr<const LevelCore>> list;
  };
  std::vector<Of> all;  ///< No teller twice.

  /// Of different tellers.
  void hear(const ToldCores& other) { all.insert(all.end(), other.all.begin(), other.all.end()); }
};

using solve::Role;
using Knowledge = solve::Knowledge<Plan>;
using Message = solve::Message<Plan, ToldCores>;
using Exchange = solve::Exchange<Message>;
using Desk = solve::Desk<Plan, Message>;

}  // namespace quadrille::continuous
