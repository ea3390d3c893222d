// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "cover/core_table.hpp"
#include "cover/kernel.hpp"

namespace quadrille::continuous {

/// The linear programs of leaves: maximise the sum of the multipliers u of some *columns*, each
/// times its worth, with u >= 0 and, for each agent and each level of it in the leaf, the
/// multipliers of what the agent reaches there no more than the level costs above the free cost.
/// The dual is the cheapest fractional cover: `part`.
///
/// The columns are cores and sums, and for each agent whose low end is above its free cost one
/// more, "costs the low end or more", which the agent reaches from its low end on. The low end is a
/// row then, and levels below it and at or above the high end are none: a part of a leaf has other
/// columns and fewer rows, and so solutions of the leaf are solutions of the part, where the search
/// goes on (primal simplex).
///
/// Of the simplex method's basis only the *kernel* is kept, the basic columns in the tight rows:
/// some thirty of hundreds of each. Deterministic. What a solution is used for must not depend on
/// its accuracy.
class LevelSimplex {
 public:
  /// The rows of an agent.
  struct Line {
    AgentId agent;
    std::uint32_t begin = 0, end = 0;   ///< Of its levels.
    std::uint32_t first = 0, last = 0;  ///< Those in the leaf.
    bool is_raised = false;             ///< The low end is a row, and before `first`.
    Cost low = 0;
  };
  /// A solution that another one may begin with.
  struct Basis {
    std::vector<std::uint32_t> columns;
    std::vector<std::uint32_t> rows;
  };

  static constexpr std::uint32_t kGone = 0xffffffffU;

  explicit LevelSimplex(const IdVector<AgentId, Cost>& free_costs) : free_costs_(free_costs) {}

  /// By agent and cost, all above the free costs. There are no columns then.
  void set_levels(const std::vector<Level>& levels);
  /// At least `least` of the levels `rows` are reached. Returns its number.
  std::uint32_t add_column(std::span<const std::uint32_t> rows, int least);
  [[nodiscard]] std::size_t num_columns() const noexcept { return least_.size(); }

  /// Another leaf, all multipliers 0. Each column has a level in it.
  void begin(const IdVector<AgentId, Cost>& low, const IdVector<AgentId, Cost>& high);
  /// The same leaf, where the multipliers of a row may be no more than this, by row: what is left
  /// when some of them are counted apart. None is negative. All multipliers are 0.
  void set_rooms(std::span<const Cost> rooms);
  /// A solution near the one with these multipliers, which belong to the columns of the basis; its
  /// kernel, if that is known, has these columns and rows. What is `kGone` is there no more. Where
  /// the multipliers exceed a row, all are 0 again.
  void restore(const Basis& basis, const std::vector<double>& multipliers, const Kernel* kernel);
  /// Ends after many more steps than were ever needed, with multipliers that are feasible and
  /// perhaps not optimal.
  void solve();

  [[nodiscard]] std::span<const Line> lines() const noexcept { return lines_; }
  /// Columns are numbered from here on, those of low ends by line before.
  [[nodiscard]] std::uint32_t num_lows() const noexcept {
    return static_cast<std::uint32_t>(lines_.size());
  }
  /// The row of a line's low end.
  [[nodiscard]] std::uint32_t low_row(std::size_t line) const {
    return static_cast<std::uint32_t>(levels_.size() + line);
  }
  /// Levels, and low ends after them.
  [[nodiscard]] std::size_t num_rows() const noexcept { return levels_.size() + lines_.size(); }
  /// Above the agent's free cost: what the multipliers of a row may take in the linear program.
  [[nodiscard]] Cost cost_of(std::uint32_t row) const;
  [[nodiscard]] std::uint32_t line_of(std::uint32_t row) const { return line_of_[row]; }
  /// Their number, if the agent has no level.
  [[nodiscard]] std::size_t line_of(AgentId agent) const {
    return static_cast<std::size_t>(
        std::lower_bound(lines_.begin(), lines_.end(), agent,
                         [](const Line& line, AgentId i) { return line.agent < i; }) -
        lines_.begin());
  }
  [[nodiscard]] std::span<const std::uint32_t> rows_of(std::size_t column) const {
    return {column_rows_.data() + column_begins_[column],
            column_rows_.data() + column_begins_[column + 1]};
  }
  [[nodiscard]] int least(std::size_t column) const { return least_[column]; }
  [[nodiscard]] const Kernel& kernel() const noexcept { return kernel_; }
  /// The basic columns and the tight rows.
  [[nodiscard]] const Basis& basis() const noexcept { return basis_; }
  /// By basic column its multiplier.
  [[nodiscard]] std::vector<double> multipliers();
  /// What these are together, each times its worth.
  [[nodiscard]] double value(const std::vector<double>& multipliers) const;
  /// By level how much of the agent the fractional cover has there or above.
  [[nodiscard]] const std::vector<double>& parts() const noexcept { return parts_; }
  /// What they are together for a column more than its worth.
  [[nodiscard]] double excess(std::uint32_t column) const;
  [[nodiscard]] bool is_tight(std::uint32_t row) const { return position_[row] != kNone; }
  /// Elementary steps so far.
  [[nodiscard]] std::int64_t effort() const noexcept { return effort_ + kernel_.effort(); }

 private:
  static constexpr std::uint32_t kNone = kGone;
  /// What may become more: a column's multiplier, or the room in a tight row (or less: a row that
  /// is none any more has no limit).
  struct Entering {
    bool is_column = false;
    std::size_t at = 0;  // the column's number, or the position of the row
    double sign = 1;
    double most = std::numeric_limits<double>::max();  // by which it may change
  };
  struct Leaving {
    bool is_row = false;
    std::size_t at = kNone;  // a row, or the position of a column
    double step = std::numeric_limits<double>::max();
  };
  [[nodiscard]] bool is_gone(std::uint32_t row) const;
  [[nodiscard]] double worth(std::uint32_t column) const {
    return column < num_lows() ? 1 : least_[column - num_lows()];
  }
  [[nodiscard]] double cell(std::uint32_t row, std::uint32_t column) const;
  void list_tight(std::uint32_t column);
  void scatter(std::uint32_t column, double value);
  void gather();
  void clear_basis();
  void find_values();
  [[nodiscard]] double right(std::uint32_t row) const;
  void find_room();
  [[nodiscard]] bool is_feasible(const std::vector<double>& values) const;
  void find_kernel(const Basis& basis, const std::vector<double>& multipliers);
  [[nodiscard]] bool take_kernel(const Basis& basis, const std::vector<double>& multipliers,
                                 const Kernel& kernel);
  [[nodiscard]] bool remove_gone();
  void remove(std::size_t column, std::size_t row);
  void fill_rows();
  void drop_gone_rows();
  void find_parts();
  [[nodiscard]] bool choose_entering(Entering& entering);
  [[nodiscard]] bool find_candidates();
  [[nodiscard]] bool enter(const Entering& entering);
  [[nodiscard]] Leaving find_leaving() const;
  void pivot(const Entering& entering, const Leaving& leaving, double missing);
  void add_candidate(std::uint32_t column);

  IdVector<AgentId, Cost> free_costs_;
  std::vector<Level> levels_;
  std::vector<Line> lines_;
  std::vector<std::uint32_t> line_of_;
  std::vector<std::uint32_t> column_rows_;
  std::vector<std::size_t> column_begins_{0};
  std::vector<int> least_;
  std::vector<double> weights_;
  double scale_ = 1;
  // By row, levels first, then low ends:
  std::vector<double> capacity_;           // what the multipliers may take
  std::vector<double> room_;               // that they leave
  std::vector<double> change_;             // what a step takes of it
  std::vector<std::uint32_t> position_;    // in the basis, where it is tight
  std::vector<double> parts_, low_parts_;  // by level; by line
  Kernel kernel_;
  Basis basis_;
  std::vector<double> values_;  // by basic column
  std::vector<double> image_;   // by basic column: what a step takes of it
  std::vector<std::uint32_t> candidates_;
  std::vector<char> is_candidate_;  // by column
  std::vector<Kernel::Entry> entries_;
  std::vector<double> row_image_, right_;
  std::vector<Cost> rooms_;
  std::vector<double> sums_, low_sums_;  // by level; by line
  std::int64_t effort_ = 0;
};

}  // namespace quadrille::continuous
