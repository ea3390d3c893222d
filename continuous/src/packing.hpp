// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

namespace quadrille::continuous {

/// A linear program: maximise the sum of u, with u >= 0 and for each row the sum of some of the u
/// at most `capacity`, which is >= 0.
struct Packing {
  std::vector<double> capacity;                   ///< By row.
  std::vector<std::vector<std::size_t>> columns;  ///< By variable: the rows in which it occurs.
};

/// An optimal solution in floating point: what it is used for must not depend on its accuracy.
struct PackingSolution {
  std::vector<double> primal;  ///< u, by column.
  std::vector<double> dual;    ///< Price of each row; the cheapest fractional cover.
};

/// The simplex method on a dense tableau. Deterministic.
[[nodiscard]] PackingSolution solve_packing(const Packing& packing);

}  // namespace quadrille::continuous
