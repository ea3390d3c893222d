// SPDX-License-Identifier: MIT
// How a linear program begins with the solution of another one.
#include <algorithm>
#include <cmath>
#include <utility>

#include "cover/level_simplex.hpp"

namespace quadrille::continuous {
namespace {

constexpr double kTiny = 1e-9;
/// Rows with room in the solution before, as against tight ones.
constexpr double kLooseWeight = 1e-3;
/// What is divided by in a kernel when something is taken out.
constexpr double kSmallestPivot = 1e-4;
/// Changes after which a kernel is inverted anew, because of rounding.
constexpr int kMostAge = 100;

}  // namespace

void LevelSimplex::restore(const Basis& basis, const std::vector<double>& multipliers,
                           const Kernel* kernel) {
  Basis left;
  std::vector<double> values, all;
  for (std::size_t i = 0; i < basis.columns.size(); ++i) {
    all.push_back(multipliers[i] / scale_);
    if (basis.columns[i] == kGone) continue;
    left.columns.push_back(basis.columns[i]);
    values.push_back(all[i]);
  }
  for (const std::uint32_t r : basis.rows)
    if (r != kGone) left.rows.push_back(r);
  basis_.columns = left.columns;
  values_ = values;
  find_room();
  basis_.columns.clear();
  values_.clear();
  if (!is_feasible(values)) {
    clear_basis();
    return;
  }
  if (kernel == nullptr || !take_kernel(basis, all, *kernel)) find_kernel(left, values);
  find_room();
  fill_rows();
  find_values();
  if (!is_feasible(values_)) clear_basis();
}

/// False, with an empty basis: this kernel cannot be gone on with.
bool LevelSimplex::take_kernel(const Basis& basis, const std::vector<double>& multipliers,
                               const Kernel& kernel) {
  if (kernel.age() > kMostAge || kernel.size() != basis.columns.size()) return false;
  kernel_.copy(kernel);
  basis_ = basis;
  values_ = multipliers;
  if (!remove_gone()) {
    kernel_.clear();
    basis_ = {};
    values_.clear();
    return false;
  }
  for (std::size_t t = 0; t < basis_.rows.size(); ++t)
    position_[basis_.rows[t]] = static_cast<std::uint32_t>(t);
  return true;
}

/// Columns that are gone leave the kernel with a row each, one that is gone or has room rather than
/// others; then rows that are gone with a column each. False: that divides by too little.
bool LevelSimplex::remove_gone() {
  const auto weight = [&](std::size_t t) {
    const std::uint32_t r = basis_.rows[t];
    return r == kGone ? 1 / kLooseWeight : is_gone(r) || room_[r] > kTiny ? 1 : kLooseWeight;
  };
  for (std::size_t i = 0; i < basis_.columns.size();) {
    if (basis_.columns[i] != kGone) {
      ++i;
      continue;
    }
    std::size_t best = 0;
    for (std::size_t t = 1; t < basis_.rows.size(); ++t)
      if (std::abs(kernel_.at(i, t)) * weight(t) > std::abs(kernel_.at(i, best)) * weight(best))
        best = t;
    if (std::abs(kernel_.at(i, best)) < kSmallestPivot) return false;
    remove(i, best);
  }
  for (std::size_t t = 0; t < basis_.rows.size();) {
    if (basis_.rows[t] != kGone) {
      ++t;
      continue;
    }
    std::size_t best = 0;
    for (std::size_t i = 1; i < basis_.columns.size(); ++i)
      if (std::abs(kernel_.at(i, t)) > std::abs(kernel_.at(best, t))) best = i;
    if (std::abs(kernel_.at(best, t)) < kSmallestPivot) return false;
    remove(best, t);
  }
  return true;
}

/// Takes both out of the kernel.
void LevelSimplex::remove(std::size_t column, std::size_t row) {
  kernel_.shrink(column, row);
  basis_.columns[column] = basis_.columns.back();
  basis_.columns.pop_back();
  values_[column] = values_.back();
  values_.pop_back();
  basis_.rows[row] = basis_.rows.back();
  basis_.rows.pop_back();
}

// Columns that depend on others get the multiplier 0, which they share with all that are gone.
void LevelSimplex::find_kernel(const Basis& basis, const std::vector<double>& multipliers) {
  const std::size_t width = basis.columns.size(), height = basis.rows.size();
  for (std::size_t t = 0; t < height; ++t) position_[basis.rows[t]] = static_cast<std::uint32_t>(t);
  std::vector<double> cells(width * height), worths(width), weights(height);
  for (std::size_t i = 0; i < width; ++i) {
    worths[i] = worth(basis.columns[i]);
    list_tight(basis.columns[i]);
    for (const Kernel::Entry& entry : entries_) cells[entry.at * width + i] += entry.value;
  }
  for (std::size_t t = 0; t < height; ++t) {
    const std::uint32_t row = basis.rows[t];
    weights[t] = is_gone(row) || room_[row] > kTiny ? kLooseWeight : 1;
    position_[row] = kNone;
  }
  for (const Kernel::Pair& pair : kernel_.invert(std::move(cells), worths, weights)) {
    basis_.columns.push_back(basis.columns[pair.column]);
    values_.push_back(multipliers[pair.column]);
    basis_.rows.push_back(basis.rows[pair.row]);
    position_[basis_.rows.back()] = static_cast<std::uint32_t>(basis_.rows.size() - 1);
  }
}

bool LevelSimplex::is_feasible(const std::vector<double>& values) const {
  const auto is_negative = [](double value) { return value < -kTiny; };
  if (std::any_of(values.begin(), values.end(), is_negative)) return false;
  for (std::uint32_t k = 0; k < num_lows(); ++k) {
    const Line& line = lines_[k];
    if (line.is_raised && is_negative(room_[low_row(k)])) return false;
    if (std::any_of(room_.begin() + line.first, room_.begin() + line.last, is_negative))
      return false;
  }
  return true;
}

/// Rows of the basis that are not tight become so, or get out of it.
void LevelSimplex::fill_rows() {
  for (std::size_t t = 0; t < basis_.rows.size();) {
    const std::uint32_t row = basis_.rows[t];
    if (is_gone(row) || room_[row] <= kTiny) {
      ++t;
      continue;
    }
    if (kernel_.prices()[t] < 0 ? !enter({false, t, 1}) : !enter({false, t, -1, room_[row]}))
      return;
    t = 0;
  }
}

/// Rows that are none any more have no limit: whichever way that changes the multipliers for the
/// better, up to the next limit.
void LevelSimplex::drop_gone_rows() {
  for (std::size_t t = 0; t < basis_.rows.size();) {
    if (!is_gone(basis_.rows[t])) {
      ++t;
      continue;
    }
    const double sign = kernel_.prices()[t] > 0 ? -1 : 1;
    if (!enter({false, t, sign}) && !enter({false, t, -sign})) {
      clear_basis();
      return;
    }
    t = 0;
  }
}

}  // namespace quadrille::continuous
