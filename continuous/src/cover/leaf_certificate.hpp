// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cover/level_simplex.hpp"

namespace quadrille::continuous {

/// Whole multipliers of the columns of a leaf's linear program, in fractions of a tick. Wherever
/// they come from, they prove a bound: if they exceed no row, their sum is one. For each core is
/// hit by some agent, and for each agent the row of the highest level that it reaches, or of its
/// low end, says that the cores it hits, and its low end, ask for no more than it pays.
class LeafCertificate {
 public:
  /// Of a tick: rounding down this number of multipliers loses less than a tick.
  static constexpr Cost kFraction = 1024;

  /// The simplex outlives this, and says which leaf it is about.
  explicit LeafCertificate(const LevelSimplex& simplex) : simplex_(simplex) {}

  /// All multipliers are 0.
  void clear();
  /// More of the columns, each times `factor` and rounded down; what is negative counts as nothing.
  void add(std::span<const std::uint32_t> columns, const std::vector<double>& multipliers,
           Cost factor);
  /// What agents of the program pay above their free costs in all costs of the leaf that hit all
  /// cores, in ticks: costs are integers. What a row is asked for too much is cut from the columns
  /// as they come.
  [[nodiscard]] Cost bound();

  /// To find what more there is, with numbers so small that doubles do: the multipliers without the
  /// last `margin` of each, which are for another linear program to say.
  struct Rest {
    std::vector<Cost> rooms;  ///< That they leave, by row, in fractions; no more than can matter.
    std::vector<double> multipliers;  ///< What was taken off, by column of `columns`.
  };
  /// Requires that bound() was called since they changed.
  [[nodiscard]] Rest take_off(Cost margin, std::span<const std::uint32_t> columns);
  /// Of a column.
  [[nodiscard]] Cost units(std::uint32_t column) const { return units_[column]; }
  /// The largest one.
  [[nodiscard]] Cost largest() const;

 private:
  [[nodiscard]] bool find_used();
  [[nodiscard]] Cost room(std::uint32_t row) const { return simplex_.cost_of(row) * kFraction; }
  template <class Visit>
  void visit_rows(std::uint32_t column, const Visit& visit) const;

  const LevelSimplex& simplex_;
  std::vector<std::uint32_t> columns_;  // with multipliers, as they came
  std::vector<Cost> units_;             // by column
  std::vector<Cost> used_;              // by row, of the leaf
};

}  // namespace quadrille::continuous
