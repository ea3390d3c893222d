// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "quadrille/core/ids.hpp"
#include "quadrille/sat/lit.hpp"

namespace quadrille::discrete {

/// A value for each (vertex, timestep), by default T(). Memory grows with the latest timestep set
/// at each vertex.
template <class T>
class CellTable {
 public:
  explicit CellTable(std::size_t num_vertices) : rows_(num_vertices) {}

  /// The value, T() where nothing was set. Any timestep.
  [[nodiscard]] const T& operator()(VertexId v, Timestep t) const {
    static const T kNothing{};
    const auto& row = rows_[v];
    const auto at = static_cast<std::size_t>(t);
    return t >= 0 && at < row.size() ? row[at] : kNothing;
  }
  /// The values of a vertex, by timestep.
  [[nodiscard]] std::span<const T> row(VertexId v) const { return rows_[v]; }
  /// The value, to be changed. Requires t >= 0.
  [[nodiscard]] T& at(VertexId v, Timestep t) {
    auto& row = rows_[v];
    const auto at = static_cast<std::size_t>(t);
    if (at >= row.size()) row.resize(at + 1);
    return row[at];
  }

 private:
  IdVector<VertexId, std::vector<T>> rows_;
};

}  // namespace quadrille::discrete
