// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "quadrille/discrete/plan.hpp"

namespace quadrille::discrete {

/// A label that no other comes from has this parent.
inline constexpr std::uint32_t kNoLabel = UINT32_MAX;

/// The path that ends with a label of a search over spans of time: a label has a `vertex`, the
/// `time` at which the agent arrives there, to wait until it goes on, and its `parent`, an index
/// into `labels`. O(length of the path).
template <class Label>
[[nodiscard]] Path path_to(const std::vector<Label>& labels, std::uint32_t last) {
  Path path(static_cast<std::size_t>(labels[last].time) + 1);
  std::size_t end = path.size();  // What is behind is filled.
  for (std::uint32_t at = last; at != kNoLabel; at = labels[at].parent) {
    const auto begin = static_cast<std::size_t>(labels[at].time);
    std::fill(path.begin() + static_cast<std::ptrdiff_t>(begin),
              path.begin() + static_cast<std::ptrdiff_t>(end), labels[at].vertex);
    end = begin;
  }
  return path;
}

}  // namespace quadrille::discrete
