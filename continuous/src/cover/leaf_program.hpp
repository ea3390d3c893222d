// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "cover/core_table.hpp"
#include "cover/packing.hpp"

namespace quadrille::continuous {

/// A leaf of the branch and bound tree of a LevelCover.
struct CoverLeaf {
  /// The agent costs at least `low` and less than `high`.
  struct Range {
    AgentId agent;
    Cost low = 0, high = std::numeric_limits<Cost>::max();
  };
  /// How much of the agent the fractional cover has at the level or above.
  struct Share {
    Level level;
    double part = 0;
  };
  Cost bound = 0;             ///< On what the agents of the group pay above their free costs.
  std::vector<Range> ranges;  ///< By agent; of others nothing is known.
  // Of the last linear program:
  std::optional<Level> branch;  ///< To split the leaf at; none if its low ends hit all cores.
  std::vector<Share> shares;    ///< By falling level; none where it is 0.
};

/// The linear programs of the leaves of one group of agents.
class LeafProgram {
 public:
  explicit LeafProgram(const IdVector<AgentId, Cost>& free_costs);

  /// The cores that what follows is about. `table` lives as long.
  void set_cores(const CoreTable& table);

  /// Whether the leaf's fractional cover still covers all cores: then its linear program would say
  /// what it said before.
  [[nodiscard]] bool is_known(const CoverLeaf& leaf);

  /// Raises the leaf's bound to that of its linear program, and says where to split it.
  /// `costs` become integers near its solution, which need not hit all cores. False: the leaf
  /// contains no solution.
  [[nodiscard]] bool solve(CoverLeaf& leaf, IdVector<AgentId, Cost>& costs);
  /// Whether the last solution was integral.
  [[nodiscard]] bool is_integral() const noexcept { return is_integral_; }

 private:
  static constexpr std::uint32_t kNoRow = 0xffffffffU;
  void load(const CoverLeaf& leaf);
  void unload(const CoverLeaf& leaf);
  [[nodiscard]] bool solve_loaded(CoverLeaf& leaf, IdVector<AgentId, Cost>& costs);
  [[nodiscard]] bool collect();
  void make_program();
  [[nodiscard]] Cost certified_bound(const std::vector<double>& multipliers);
  void round(const std::vector<double>& dual, CoverLeaf& leaf, IdVector<AgentId, Cost>& costs);

  IdVector<AgentId, Cost> free_costs_;
  const CoreTable* table_ = nullptr;
  IdVector<AgentId, Cost> low_, high_;  // of the leaf at work
  // Cores that the low ends do not hit: their rows in the table, as far as these are in the leaf.
  std::vector<std::uint32_t> active_;
  std::vector<std::size_t> active_begins_;
  std::vector<std::uint32_t> number_;  // by row of the table: its number in the program
  std::vector<Level> rows_;            // of the program
  Packing program_;
  bool is_integral_ = false;
  // Scratch:
  std::vector<Cost> units_, used_;
  std::vector<double> part_;
};

}  // namespace quadrille::continuous
