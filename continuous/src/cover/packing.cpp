// SPDX-License-Identifier: MIT
#include "cover/packing.hpp"

#include <algorithm>
#include <cstdint>

namespace quadrille::continuous {
namespace {

constexpr double kTiny = 1e-9;

/// Rows for the constraints and a last one for the objective; the last column is the right side.
/// All slack variables are basic at first, which is feasible.
class Tableau {
 public:
  explicit Tableau(const Packing& packing)
      : rows_(packing.capacity.size()),
        columns_(packing.num_columns()),
        width_(columns_ + 1),
        cells_((rows_ + 1) * width_, 0.0),
        basic_(rows_),
        other_(columns_) {
    double largest = 1;
    for (const double c : packing.capacity) largest = std::max(largest, c);
    for (std::size_t r = 0; r < rows_; ++r) {
      // Slightly different right sides keep the method from going round in circles.
      at(r, columns_) = packing.capacity[r] / largest +
                        1e-11 * static_cast<double>(r + 1) / static_cast<double>(rows_ + 1);
      basic_[r] = columns_ + r;
    }
    for (std::size_t c = 0; c < columns_; ++c) {
      for (const std::uint32_t r : packing.rows_of(c)) at(r, c) = 1;
      at(rows_, c) = -1;
      other_[c] = c;
    }
    scale_ = largest;
  }

  void solve() {
    // Many times what is ever needed; an unfinished solution is of less use, but does no harm.
    const std::size_t max_pivots = 50 * (rows_ + columns_) + 1000;
    for (std::size_t k = 0; k < max_pivots; ++k) {
      const double* const objective = &at(rows_, 0);
      const auto entering =
          static_cast<std::size_t>(std::min_element(objective, objective + columns_) - objective);
      if (columns_ == 0 || objective[entering] > -kTiny) return;
      const std::size_t leaving = leaving_row(entering);
      if (leaving == rows_) return;
      pivot(leaving, entering);
    }
  }

  [[nodiscard]] PackingSolution solution() const {
    PackingSolution result{std::vector<double>(columns_, 0), std::vector<double>(rows_, 0),
                           effort_};
    for (std::size_t r = 0; r < rows_; ++r)
      if (basic_[r] < columns_) result.primal[basic_[r]] = scale_ * at(r, columns_);
    for (std::size_t c = 0; c < columns_; ++c)
      if (other_[c] >= columns_) result.dual[other_[c] - columns_] = at(rows_, c);
    return result;
  }

 private:
  [[nodiscard]] double& at(std::size_t row, std::size_t column) {
    return cells_[row * width_ + column];
  }
  [[nodiscard]] const double& at(std::size_t row, std::size_t column) const {
    return cells_[row * width_ + column];
  }

  /// Reads the entering column into `entering_`.
  [[nodiscard]] std::size_t leaving_row(std::size_t entering) {
    entering_.clear();
    std::size_t best = rows_;
    double best_ratio = 0;
    for (std::size_t r = 0; r <= rows_; ++r) {
      const double step = at(r, entering);
      entering_.push_back(step);
      if (step <= kTiny || r == rows_) continue;
      const double ratio = at(r, columns_) / step;
      if (best == rows_ || ratio < best_ratio) {
        best = r;
        best_ratio = ratio;
      }
    }
    return best;
  }

  void pivot(std::size_t leaving, std::size_t entering) {
    double* const pivot_row = &at(leaving, 0);
    const double inverse = 1 / pivot_row[entering];
    pivot_row[entering] = 0;
    nonzero_.clear();
    for (std::size_t c = 0; c < width_; ++c) {
      if (pivot_row[c] == 0) continue;
      pivot_row[c] *= inverse;
      nonzero_.push_back(c);
    }
    pivot_row[entering] = inverse;
    for (std::size_t r = 0; r <= rows_; ++r) {
      const double factor = entering_[r];
      if (r == leaving || factor == 0) continue;
      double* const row = &at(r, 0);
      for (const std::size_t c : nonzero_) row[c] -= factor * pivot_row[c];
      row[entering] = -factor * inverse;
      effort_ += static_cast<std::int64_t>(nonzero_.size());
    }
    effort_ += static_cast<std::int64_t>(rows_ + width_);
    std::swap(basic_[leaving], other_[entering]);
  }

  std::size_t rows_, columns_, width_;
  std::vector<double> cells_;
  std::vector<std::size_t> basic_, other_;  // variables; from columns_ on slacks
  std::vector<std::size_t> nonzero_;        // of the pivot row
  std::vector<double> entering_;            // by row
  double scale_ = 1;
  std::int64_t effort_ = 0;
};

}  // namespace

PackingSolution solve_packing(const Packing& packing) {
  Tableau tableau(packing);
  tableau.solve();
  return tableau.solution();
}

}  // namespace quadrille::continuous
