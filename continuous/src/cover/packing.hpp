// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace quadrille::continuous {

/// A linear program that grows: maximise the sum of u, each times its worth, with u >= 0 and for
/// each row the sum of some of the u at most the row's capacity. A u may count more than once in a
/// row.
///
/// The simplex method on a dense tableau: rows times columns per pivot, less where it is sparse.
/// What is added after a solution goes into the tableau as that solution has it, and the next one
/// begins there. Deterministic.
///
/// A solution is optimal in floating point: what it is used for must not depend on its accuracy.
/// Up to rounding, the u and the prices of the rows are >= 0 and worth the same, and so each proves
/// the other optimal: the worth of the u is the sum over the rows of price times capacity.
class Packing {
 public:
  /// None of the capacities will be much larger than `scale`.
  explicit Packing(double scale = 1);

  /// `capacity` >= 0. The row has u of the columns that are listed, as often as they are. Requires
  /// that the present solution, 0 at first, keeps to the row. Returns its number.
  [[nodiscard]] std::uint32_t add_row(double capacity, std::span<const std::uint32_t> columns);
  /// The column's u is in the rows that are listed, as often as they are; in one at least,
  /// otherwise the sum has no limit. Returns its number.
  [[nodiscard]] std::uint32_t add_column(std::span<const std::uint32_t> rows, double worth);
  /// Ends after many more pivots than were ever needed, with u that are feasible and perhaps not
  /// optimal, and prices that are perhaps too low.
  void solve();

  [[nodiscard]] std::size_t num_rows() const noexcept { return basic_.size(); }
  [[nodiscard]] std::size_t num_columns() const noexcept { return other_.size(); }
  /// u, by column.
  [[nodiscard]] std::vector<double> primal() const;
  /// Price of each row; in each column they are its worth or more together.
  [[nodiscard]] std::vector<double> dual() const;
  /// Cells of the tableau that were looked at or changed so far.
  [[nodiscard]] std::int64_t effort() const noexcept { return effort_; }

 private:
  /// A variable: the u of a column, or the slack of a row.
  struct Variable {
    bool is_slack = false;
    std::uint32_t number = 0;
  };
  /// Where a variable is: as the basic one of a row of the tableau, or as one of its columns.
  struct Place {
    bool is_basic = false;
    std::size_t at = 0;
  };
  [[nodiscard]] double& at(std::size_t row, std::size_t column) {
    return cells_[row * stride_ + column];
  }
  [[nodiscard]] Place& place(const Variable& variable) {
    return variable.is_slack ? slacks_[variable.number] : us_[variable.number];
  }
  [[nodiscard]] std::size_t entering_column() const;
  [[nodiscard]] std::size_t leaving_row(std::size_t entering);
  void pivot(std::size_t leaving, std::size_t entering);

  double scale_ = 1;
  std::size_t stride_ = 0;
  std::vector<double> cells_;              // a row for each slack, `stride_` cells long
  std::vector<double> right_, objective_;  // by row; by column
  std::vector<Variable> basic_, other_;    // by row; by column
  std::vector<Place> slacks_, us_;
  std::vector<double> weights_;       // by u
  std::vector<std::size_t> nonzero_;  // of the pivot row
  std::vector<double> entering_;      // by row
  std::int64_t effort_ = 0;
};

}  // namespace quadrille::continuous
