// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace quadrille::continuous {

/// The inverse of a square matrix that changes by a row, a column or one of each at a time, and a
/// line below it, the *prices*, that keeps in step: some values of the columns times the inverse.
/// What a step costs is the size squared, less where the inverse is sparse.
///
/// Row i of the inverse is about column i of the matrix, column t about row t of the matrix.
class Kernel {
 public:
  struct Entry {
    std::size_t at;
    double value;
  };
  struct Pair {
    std::size_t column, row;
  };
  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  [[nodiscard]] double at(std::size_t i, std::size_t t) const { return cells_[i * stride_ + t]; }
  [[nodiscard]] const std::vector<double>& prices() const noexcept { return prices_; }

  void clear();
  /// Becomes equal to the other one, in no more room than needed.
  void copy(const Kernel& other);
  /// Changes since it was inverted: each one adds to what rounding has left.
  [[nodiscard]] int age() const noexcept { return age_; }
  /// Of the part of a matrix, given row by row, that pairs of a column and a row make up: as many
  /// as there are, in rows of large weight rather than others. `values` and `weights` are by column
  /// and row of the matrix. Says which ones, in the order in which the inverse has them.
  std::vector<Pair> invert(std::vector<double> cells, const std::vector<double>& values,
                           const std::vector<double>& weights);
  /// The inverse times a column of as many rows.
  void times(const std::vector<double>& column, std::vector<double>& result);
  void times(const std::vector<Entry>& column, std::vector<double>& result);
  /// A row of as many columns times the inverse.
  void times_row(const std::vector<Entry>& row, std::vector<double>& result);

  /// A column gets another one's place: the inverse times this one is `image`, and `missing` what
  /// the prices times it are more than its value.
  void replace_column(std::size_t column, const std::vector<double>& image, double missing);
  /// One more column, as above, and a row; the row times the inverse is `row_image`, and what it
  /// has in the new column less `row_image` times that column is `pivot`.
  void grow(const std::vector<double>& image, const std::vector<double>& row_image, double pivot,
            double missing);
  /// Without a column and a row: the last ones get their places.
  void shrink(std::size_t column, std::size_t row);
  /// A row gets another one's place: this one times the inverse is `row_image`.
  void replace_row(std::size_t row, const std::vector<double>& row_image);

  /// Cells that were changed so far.
  [[nodiscard]] std::int64_t effort() const noexcept { return effort_; }

 private:
  [[nodiscard]] double* row(std::size_t i) { return cells_.data() + i * stride_; }
  void reserve(std::size_t size);
  void subtract(double* from, double factor, const double* line);

  std::size_t size_ = 0, stride_ = 0;
  std::vector<double> cells_, prices_, line_;
  int age_ = 0;
  std::int64_t effort_ = 0;
};

}  // namespace quadrille::continuous
