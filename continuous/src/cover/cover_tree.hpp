// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "cover/core_table.hpp"

namespace quadrille::continuous {

/// A proof that the agents of some cores pay `bound` above their free costs in all costs that hit
/// these cores (docs/certificates.md): a tree of branches, whose leaves have a whole multiplier for
/// each core, not negative.
///
/// Why a leaf proves something: for multipliers u, let g_i(x) be the sum of those of the cores that
/// agent i hits when it costs x. In costs that hit all cores, all g_i together are at least the sum
/// of the u. So what the agents pay is at least that sum, plus for each agent the least value of
/// what it pays less g_i, among the costs in the leaf: the Lagrangian bound. No linear program has
/// to be believed.
struct CoverTree {
  /// Multipliers are in this part of a tick.
  static constexpr Cost kFraction = 1024;
  struct Node {
    std::optional<Level> branch;                            ///< None: a leaf.
    std::vector<std::pair<std::size_t, Cost>> multipliers;  ///< Of a leaf: by core, not 0.
  };
  /// Each branch is followed by the costs below its level, then by those from there on.
  std::vector<Node> nodes;
  Cost bound = 0;
};

/// By branch and bound from the root, with leaves that are no better than they have to be. Less
/// than `wanted` is proved where that takes more than `most_leaves`. Requires cores none of which
/// is empty, and levels above the free costs. A linear program for each node.
[[nodiscard]] CoverTree make_cover_tree(const IdVector<AgentId, Cost>& free_costs,
                                        std::span<const LevelCore> cores, Cost wanted,
                                        std::size_t most_leaves = 20'000);

}  // namespace quadrille::continuous
