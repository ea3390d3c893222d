// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <tuple>
#include <vector>

#include "quadrille/execution/precedences.hpp"

namespace quadrille::execution {

/// Puts the list into its order.
inline void sort_precedences(std::vector<Precedence>& list) {
  std::sort(list.begin(), list.end(), [](const Precedence& p, const Precedence& q) {
    return std::tie(p.follower, p.leader) < std::tie(q.follower, q.leader);
  });
}

}  // namespace quadrille::execution
