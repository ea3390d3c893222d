// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace quadrille::continuous {

/// A linear program: maximise the sum of u, with u >= 0 and for each row the sum of some of the u
/// at most `capacity`, which is >= 0. Every variable occurs in a row: otherwise the sum has no
/// limit.
struct Packing {
  std::vector<double> capacity;            ///< By row.
  std::vector<std::size_t> column_begins;  ///< Into `column_rows`; one more than columns.
  std::vector<std::uint32_t> column_rows;  ///< No row twice in a column.
  [[nodiscard]] std::size_t num_columns() const { return column_begins.size() - 1; }
  /// The rows in which a variable occurs.
  [[nodiscard]] std::span<const std::uint32_t> rows_of(std::size_t column) const {
    return {column_rows.data() + column_begins[column],
            column_rows.data() + column_begins[column + 1]};
  }
};

/// An optimal solution in floating point: what it is used for must not depend on its accuracy.
/// Up to rounding, both parts are >= 0 and worth the same, and so each proves the other optimal:
/// the sum of the u is the sum over the rows of price times capacity. No set of rows that has a row
/// of each column costs less.
struct PackingSolution {
  std::vector<double> primal;  ///< u, by column.
  std::vector<double> dual;    ///< Price of each row; in each column they are 1 or more together.
  std::int64_t effort = 0;     ///< Cells of the tableau that were looked at or changed.
};

/// The simplex method on a dense tableau: rows times columns per pivot, less where it is sparse. It
/// ends after many more pivots than were ever needed, with a solution that is feasible and perhaps
/// not optimal, of prices that are perhaps too low. Deterministic.
[[nodiscard]] PackingSolution solve_packing(const Packing& packing);

}  // namespace quadrille::continuous
