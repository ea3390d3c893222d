// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <deque>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "cover/core_table.hpp"
#include "cover/half_sums.hpp"
#include "cover/leaf_certificate.hpp"
#include "cover/level_simplex.hpp"

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
  /// The solution of a linear program.
  struct Solution {
    enum class Kind : std::uint8_t { low_end, core, sum };
    struct Column {
      Kind kind = Kind::core;
      std::uint32_t number =
          0;  ///< Of the agent; of the core, as the program was told; of the sum.
      double multiplier = 0;
    };
    std::vector<Column> columns;
    std::vector<Level> rows;  ///< Those that the multipliers fill.
    Kernel kernel;            ///< Of these; empty if it was given up.
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
  /// By falling level; none where it is 0.
  std::vector<Share> shares;
  /// The next linear program begins with it, that of the leaf with other cores or of a part of it.
  std::shared_ptr<const Solution> solution;
};

/// Its parts below `branch`, and from there on. Requires a branch.
[[nodiscard]] std::pair<CoverLeaf, CoverLeaf> split(CoverLeaf leaf);

/// A sum that follows from the cores of a group of agents.
struct CoverSum {
  LevelSum sum;
  bool was_used = true;      ///< A bound has rested on it lately.
  std::uint32_t number = 0;  ///< By which leaves remember it: none of another one's.
};

/// The linear programs of the leaves of one group of agents.
class LeafProgram {
 public:
  explicit LeafProgram(const IdVector<AgentId, Cost>& free_costs);
  LeafProgram(const LeafProgram&) = delete;
  LeafProgram& operator=(const LeafProgram&) = delete;

  /// The cores that what follows is about: none is empty, and all levels are above the free costs.
  /// `table` lives as long. The numbers, which increase, are those by which leaves remember cores
  /// from call to call; by default they are new, and leaves remember none.
  void set_cores(const CoreTable& table, std::span<const std::uint32_t> numbers = {});
  /// Sums that follow from the cores, which are in the programs too. Solve adds some where there
  /// are many programs. Those that were of no use for some such calls, and those with a level
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
  /// Raises the bound of the leaf, which was solved last, once more, where the linear program has
  /// promised `wanted` and integers keep less because costs are so large (10^12 ticks) that doubles
  /// are some ticks off. What it takes is a part of a linear program, or nothing.
  void refine(CoverLeaf& leaf, Cost wanted);
  /// What the agents of the cores pay at least above their free costs in the leaf that was solved
  /// last, from multipliers of its solution's columns; of any quality, but then it is low.
  [[nodiscard]] Cost certified_bound(const std::vector<double>& multipliers);
  /// Of the leaf that was solved last: whole multipliers of cores, in fractions of a tick, that its
  /// bound follows from where there are no sums; none is 0.
  [[nodiscard]] std::vector<std::pair<std::size_t, Cost>> core_units() const;
  /// Whether the last solution was integral: then `costs` hit all cores, and none of the leaf that
  /// do are cheaper, as far as floating point can tell.
  [[nodiscard]] bool is_integral() const noexcept { return is_integral_; }
  /// Elementary steps of all linear programs so far.
  [[nodiscard]] std::int64_t effort() const noexcept { return effort_ + simplex_.effort(); }

 private:
  void load(const CoverLeaf& leaf);
  void unload(const CoverLeaf& leaf);
  [[nodiscard]] bool solve_loaded(CoverLeaf& leaf, IdVector<AgentId, Cost>& costs);
  void list_rows(const LevelSum& sum);
  [[nodiscard]] bool has_levels() const;
  void restore(const CoverLeaf& leaf);
  [[nodiscard]] std::uint32_t column_of(const CoverLeaf::Solution::Column& column) const;
  [[nodiscard]] std::uint32_t row_of(const Level& level) const;
  [[nodiscard]] std::shared_ptr<const CoverLeaf::Solution> remember(
      const std::vector<double>& multipliers);
  void keep_kernel(const std::shared_ptr<CoverLeaf::Solution>& solution);
  [[nodiscard]] bool add_sums();
  void note_uses(const std::vector<double>& multipliers);
  void find_parts(const CoverLeaf& leaf);
  [[nodiscard]] double covered(std::size_t column) const;
  void round(CoverLeaf& leaf, IdVector<AgentId, Cost>& costs);
  [[nodiscard]] std::optional<Level> open_level() const;

  IdVector<AgentId, Cost> free_costs_;
  const CoreTable* table_ = nullptr;
  IdVector<AgentId, Cost> low_, high_;     // of the leaf at work
  std::vector<CoverSum>* sums_ = nullptr;  // none if null
  LevelSimplex simplex_;                   // the cores and then the sums are its columns
  LeafCertificate certificate_;            // of the leaf that was solved last
  Cost base_ = 0;                          // there: what agents that no core has pay
  double promised_ = 0;                    // there: the value of the linear program
  std::vector<std::uint32_t> numbers_;     // of the cores
  std::vector<std::uint32_t> columns_;     // by number of a core
  std::uint32_t next_core_ = 0, next_sum_ = 0;
  struct Kept {
    std::weak_ptr<CoverLeaf::Solution> solution;
    std::size_t num_cells = 0;
  };
  std::deque<Kept> with_kernel_;  // as they came
  std::size_t num_cells_ = 0;     // of their kernels
  bool is_integral_ = false;
  int num_solved_ = 0;  // since the sums were set
  int num_set_ = 0;     // how often they were
  std::int64_t effort_ = 0;
  // Scratch:
  std::vector<std::uint32_t> listed_;
  std::vector<double> part_;  // by row of the table: of the agent at that level or above
};

}  // namespace quadrille::continuous
