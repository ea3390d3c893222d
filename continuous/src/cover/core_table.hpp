// SPDX-License-Identifier: MIT
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "quadrille/core/ids.hpp"

namespace quadrille::continuous {

/// "The agent costs `cost` or more."
struct Level {
  AgentId agent;
  Cost cost = 0;
  friend auto operator<=>(const Level&, const Level&) = default;
};
/// One of its levels is reached in every plan that counts: costs *hit* the core if some agent costs
/// its level or more. By agent; no agent twice.
using LevelCore = std::vector<Level>;

/// Some cores, with their levels as numbers of *rows*: the distinct levels, by agent and cost.
class CoreTable {
 public:
  CoreTable() = default;  ///< Of no cores.
  /// None is empty. The cores are copied.
  explicit CoreTable(std::span<const LevelCore* const> cores);

  [[nodiscard]] std::size_t num_cores() const noexcept {
    return row_begins_.empty() ? 0 : row_begins_.size() - 1;
  }
  [[nodiscard]] const std::vector<Level>& rows() const noexcept { return rows_; }
  /// The levels of a core, increasing.
  [[nodiscard]] std::span<const std::uint32_t> rows_of(std::size_t core) const {
    return {core_rows_.data() + row_begins_[core], core_rows_.data() + row_begins_[core + 1]};
  }
  /// The cores that have a level, increasing.
  [[nodiscard]] std::span<const std::uint32_t> cores_of(std::size_t row) const {
    return {row_cores_.data() + core_begins_[row], row_cores_.data() + core_begins_[row + 1]};
  }

  /// Raises `costs` by greed until all cores are hit: again and again to the level that hits most
  /// further cores for what it adds to the costs, to the first row of equals. Then lowers agent by
  /// agent, the dearest above its free cost first, to the least level, or the free cost, with which
  /// all cores stay hit: in the end none can be lowered alone. Costs of agents that are in no core
  /// stay. Requires costs of at least `free_costs`, and levels above these.
  void complete(const IdVector<AgentId, Cost>& free_costs, IdVector<AgentId, Cost>& costs) const;

 private:
  /// The row that hits most open cores for its price.
  [[nodiscard]] std::size_t best_row(const std::vector<int>& open_cores_of,
                                     const IdVector<AgentId, Cost>& costs) const;
  void lower(const IdVector<AgentId, Cost>& free_costs, IdVector<AgentId, Cost>& costs) const;

  std::vector<Level> rows_;
  std::vector<std::uint32_t> core_rows_, row_cores_;
  std::vector<std::size_t> row_begins_, core_begins_;  // one more than cores, rows
};

}  // namespace quadrille::continuous
