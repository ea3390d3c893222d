// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

#include "quadrille/core/export.hpp"
#include "quadrille/core/ids.hpp"

QUADRILLE_API_BEGIN

namespace quadrille {

/// The elements 0 .. size - 1, each in a group of its own until they are joined (union-find).
class Grouping {
 public:
  explicit Grouping(std::size_t size) : parent_(size) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }

  /// The smallest element of the group. Amortised O(log size), as `join`.
  [[nodiscard]] std::size_t root(std::size_t element) const {
    while (parent_[element] != element)
      element = parent_[element] = parent_[parent_[element]];  // halves the way for the next one
    return element;
  }
  /// Makes one group of those of two elements; false if it was one.
  bool join(std::size_t a, std::size_t b) {
    const std::size_t first = root(a), second = root(b);
    parent_[std::max(first, second)] = std::min(first, second);
    return first != second;
  }

 private:
  mutable std::vector<std::size_t> parent_;  // no larger than the element
};

/// Agents that never come near to those of other groups, increasing. In the order of their first
/// ones.
using AgentGroups = std::vector<std::vector<AgentId>>;

/// The groups of agents 0, 1, .. by a number that those of one group have in common. O(n log n).
[[nodiscard]] AgentGroups groups_by(const IdVector<AgentId, std::size_t>& number);

}  // namespace quadrille

QUADRILLE_API_END
