// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "cover/core_table.hpp"
#include "cover/half_sums.hpp"
#include "cover/packing.hpp"

namespace quadrille::continuous {

/// A leaf of the branch and bound tree of a LevelCover: the costs that keep to its ranges.
struct CoverLeaf {
  /// The agent costs at least `low` and less than `high`, which is more than `low` and the agent's
  /// free cost.
  struct Range {
    AgentId agent;
    Cost low = 0, high = std::numeric_limits<Cost>::max();
  };
  /// How much of the agent the fractional cover has at the level or above.
  struct Share {
    Level level;
    double part = 0;
  };
  /// In all costs of the leaf that hit all cores, the agents pay at least this above their free
  /// costs.
  Cost bound = 0;
  std::vector<Range> ranges;  ///< By agent, none twice; of others nothing is known.
  // Of the last linear program:
  /// To split the leaf at: a level of a core, strictly between the ends of its agent's range. Of
  /// the levels that the fractional cover has in part, one with the highest price above the low end
  /// times the share that it has or lacks, whichever is less. None exactly if the low ends hit all
  /// cores.
  std::optional<Level> branch;
  /// By falling level; none where it is 0. Those of a leaf that was split serve its parts to begin
  /// with, although they may be outside of their ranges.
  std::vector<Share> shares;
};

/// A sum that follows from the cores of a group of agents.
struct CoverSum {
  LevelSum sum;
  bool was_used = true;  ///< A bound has rested on it lately.
};

/// The linear programs of the leaves of one group of agents.
class LeafProgram {
 public:
  explicit LeafProgram(const IdVector<AgentId, Cost>& free_costs);

  /// The cores that what follows is about: none is empty, and all levels are above the free costs.
  /// `table` lives as long.
  void set_cores(const CoreTable& table);
  /// Sums that follow from the cores, which are in the programs too. Solve adds some where there
  /// are many programs. Those that were of no use since the last such call, and those with a level
  /// that no core has, are taken out. To be called after set_cores; `sums` lives as long.
  void set_sums(std::vector<CoverSum>& sums);

  /// Whether the leaf, which has not changed since it was solved, has a level to split it at, and
  /// its fractional cover covers all cores, those that came later too: then its linear program
  /// would say what it said before. False for a leaf that was never solved.
  [[nodiscard]] bool is_known(const CoverLeaf& leaf);

  /// Raises the leaf's bound to that of its linear program, rounded up to an integer, and says
  /// where to split the leaf. The bound is computed in integers: it holds however inaccurate the
  /// solution of the linear program is, and from an exact one it loses less than a thousandth of a
  /// tick per core before it is rounded. `costs` become integers near the solution, in the leaf,
  /// which need not hit all cores. False: no costs of the leaf hit all cores; nothing has changed
  /// then.
  [[nodiscard]] bool solve(CoverLeaf& leaf, IdVector<AgentId, Cost>& costs);
  /// Whether the last solution was integral: then `costs` hit all cores, and none of the leaf that
  /// do are cheaper, as far as floating point can tell.
  [[nodiscard]] bool is_integral() const noexcept { return is_integral_; }
  /// Elementary steps of all linear programs so far.
  [[nodiscard]] std::int64_t effort() const noexcept { return effort_; }

 private:
  static constexpr std::uint32_t kNoRow = 0xffffffffU;
  void load(const CoverLeaf& leaf);
  void unload(const CoverLeaf& leaf);
  [[nodiscard]] bool solve_loaded(CoverLeaf& leaf, IdVector<AgentId, Cost>& costs);
  [[nodiscard]] bool collect();
  [[nodiscard]] std::span<const std::uint32_t> active_rows(std::size_t c) const {
    return {active_.data() + active_begins_[c], active_.data() + active_begins_[c + 1]};
  }
  [[nodiscard]] std::size_t num_all() const {
    return table_->num_cores() + (sums_ == nullptr ? 0 : sums_->size());
  }
  [[nodiscard]] std::span<const std::uint32_t> rows_of(std::size_t c) const;
  [[nodiscard]] int least(std::size_t c) const;
  [[nodiscard]] bool activate(std::size_t c);
  void list_rows(const LevelSum& sum);
  void solve_program();
  [[nodiscard]] bool add_sums();
  void note_uses(const std::vector<double>& multipliers);
  void find_parts(const CoverLeaf& leaf);
  [[nodiscard]] double covered(std::span<const std::uint32_t> rows) const;
  void choose_tight(const CoverLeaf& leaf);
  [[nodiscard]] bool choose_violated(const std::vector<double>& dual);
  bool choose_below(double excess);
  void begin_program();
  void extend_program();
  void add_row(std::uint32_t row);
  void list_rows(std::size_t active, std::vector<std::uint32_t>& rows) const;
  void list_columns();
  [[nodiscard]] std::span<const std::uint32_t> column(std::size_t c) const {
    return {columns_.data() + column_begins_[c], columns_.data() + column_begins_[c + 1]};
  }
  [[nodiscard]] Cost room(const Level& level) const { return level.cost - low_[level.agent]; }
  [[nodiscard]] Cost certified_bound(const std::vector<double>& multipliers);
  void round(const std::vector<double>& dual, CoverLeaf& leaf, IdVector<AgentId, Cost>& costs);

  IdVector<AgentId, Cost> free_costs_;
  const CoreTable* table_ = nullptr;
  IdVector<AgentId, Cost> low_, high_;     // of the leaf at work
  std::vector<CoverSum>* sums_ = nullptr;  // none if null
  std::vector<std::uint32_t> sum_rows_;    // their levels in the table
  std::vector<std::size_t> sum_begins_{0};
  // Cores and then sums that the low ends do not hit: their rows in the table, as far as these are
  // in the leaf, how many of these are reached at least, and which they are.
  std::vector<std::uint32_t> active_;
  std::vector<std::size_t> active_begins_;
  std::vector<int> active_least_;
  std::vector<std::size_t> active_numbers_;
  std::vector<std::size_t> chosen_;    // active cores that are in the program
  std::vector<char> is_chosen_;        // by active core
  std::vector<std::uint32_t> number_;  // by row of the table: its number in the program
  Packing program_;
  std::vector<std::uint32_t> rows_;     // of the table, by number in the program
  std::vector<std::uint32_t> columns_;  // of the program: in which of its rows each is
  std::vector<std::size_t> column_begins_;
  bool is_integral_ = false;
  int num_solved_ = 0;  // since the sums were set
  std::int64_t effort_ = 0;
  // Scratch:
  std::vector<Cost> units_, used_;
  std::vector<std::uint32_t> listed_;
  std::vector<double> part_;  // by row of the table: of the agent at that level or above
};

}  // namespace quadrille::continuous
