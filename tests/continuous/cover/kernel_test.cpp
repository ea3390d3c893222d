// SPDX-License-Identifier: MIT
// The inverse of a matrix that changes, against the matrix.
#include "cover/kernel.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/environment.hpp"
#include "support/random.hpp"

namespace quadrille::continuous::test {
namespace {

using quadrille::support::scaled;
using support::Random;

/// A matrix by columns, and values of these.
struct Matrix {
  std::vector<std::vector<double>> columns;
  std::vector<double> values;

  static std::vector<double> draw(Random& random, std::size_t size) {
    std::vector<double> cells;
    for (std::size_t t = 0; t < size; ++t)
      cells.push_back(random.percent(40) ? static_cast<double>(random.between(1, 2)) : 0);
    return cells;
  }
  [[nodiscard]] std::vector<Kernel::Entry> column(std::size_t i) const {
    std::vector<Kernel::Entry> entries;
    for (std::size_t t = 0; t < columns[i].size(); ++t)
      if (columns[i][t] != 0) entries.push_back({t, columns[i][t]});
    return entries;
  }
  static std::vector<Kernel::Entry> sparse(const std::vector<double>& cells) {
    std::vector<Kernel::Entry> entries;
    for (std::size_t t = 0; t < cells.size(); ++t)
      if (cells[t] != 0) entries.push_back({t, cells[t]});
    return entries;
  }
};

void expect_inverse(const Matrix& matrix, Kernel& kernel) {
  const std::size_t size = matrix.columns.size();
  ASSERT_EQ(kernel.size(), size);
  std::vector<double> image, same;
  for (std::size_t i = 0; i < size; ++i) {
    kernel.times(matrix.column(i), image);
    kernel.times(matrix.columns[i], same);
    double price = 0;
    for (std::size_t t = 0; t < size; ++t) {
      EXPECT_NEAR(image[t], t == i ? 1 : 0, 1e-6);
      EXPECT_NEAR(image[t], same[t], 1e-6);
      price += kernel.prices()[t] * matrix.columns[i][t];
    }
    EXPECT_NEAR(price, matrix.values[i], 1e-6);
  }
}

/// One change of those that there are, unless it divides by too little.
void change(Random& random, Matrix& matrix, Kernel& kernel) {
  const std::size_t size = matrix.columns.size();
  std::vector<double> image, row_image;
  const auto missing = [&](const std::vector<double>& cells, double value) {
    for (std::size_t t = 0; t < size; ++t) value -= kernel.prices()[t] * cells[t];
    return -value;
  };
  const double value = static_cast<double>(random.between(1, 3));
  const std::size_t kind = size == 0 ? 4 : random.below(5);
  if (kind > 2 && size < 12) {
    std::vector<double> column = Matrix::draw(random, size + 1);
    const std::vector<double> row = Matrix::draw(random, size);
    const double corner = column.back();
    column.pop_back();
    kernel.times(Matrix::sparse(column), image);
    kernel.times_row(Matrix::sparse(row), row_image);
    double pivot = corner;
    for (std::size_t i = 0; i < size; ++i) pivot -= row[i] * image[i];
    if (std::abs(pivot) < 0.1) return;
    kernel.grow(image, row_image, pivot, missing(column, value));
    for (std::size_t i = 0; i < size; ++i) matrix.columns[i].push_back(row[i]);
    column.push_back(corner);
    matrix.columns.push_back(column);
    matrix.values.push_back(value);
  } else if (kind == 0) {
    const std::size_t at = random.below(size);
    const std::vector<double> column = Matrix::draw(random, size);
    kernel.times(Matrix::sparse(column), image);
    if (std::abs(image[at]) < 0.1) return;
    kernel.replace_column(at, image, missing(column, value));
    matrix.columns[at] = column;
    matrix.values[at] = value;
  } else if (kind == 1) {
    const std::size_t at = random.below(size);
    const std::vector<double> row = Matrix::draw(random, size);
    kernel.times_row(Matrix::sparse(row), row_image);
    if (std::abs(row_image[at]) < 0.1) return;
    kernel.replace_row(at, row_image);
    for (std::size_t i = 0; i < size; ++i) matrix.columns[i][at] = row[i];
  } else if (kind == 2) {
    const std::size_t at = random.below(size), row = random.below(size);
    if (std::abs(kernel.at(at, row)) < 0.1) return;
    kernel.shrink(at, row);
    matrix.columns[at] = matrix.columns.back();
    matrix.columns.pop_back();
    matrix.values[at] = matrix.values.back();
    matrix.values.pop_back();
    for (auto& column : matrix.columns) {
      column[row] = column.back();
      column.pop_back();
    }
  }
}

TEST(Kernel, KeepsInStep) {
  std::size_t largest = 0;
  for (std::size_t seed = 0; seed < scaled(300); ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    Matrix matrix;
    Kernel kernel;
    for (int k = 0; k < 40; ++k) {
      change(random, matrix, kernel);
      largest = std::max(largest, kernel.size());
    }
    expect_inverse(matrix, kernel);
    Kernel copy;
    copy.copy(kernel);
    expect_inverse(matrix, copy);
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GE(largest, 8u);
}

// Of a matrix with more rows than columns, and with a column that others make up.
TEST(Kernel, InvertsWhatItCan) {
  for (std::size_t seed = 0; seed < scaled(300); ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const std::size_t width = random.between(2, 6), height = width + random.below(3);
    std::vector<double> cells(width * height), values;
    for (double& cell : cells) cell = random.percent(50) ? 1 : 0;
    for (std::size_t t = 0; t < height; ++t)  // the last is the first two
      cells[t * width + width - 1] = cells[t * width] + (width > 2 ? cells[t * width + 1] : 0);
    for (std::size_t i = 0; i < width; ++i) values.push_back(static_cast<double>(i + 1));
    Kernel kernel;
    const auto pairs = kernel.invert(cells, values, std::vector<double>(height, 1));
    EXPECT_LT(pairs.size(), width);
    Matrix matrix;
    for (const auto& of_column : pairs) {
      matrix.values.push_back(values[of_column.column]);
      matrix.columns.emplace_back();
      for (const auto& of_row : pairs)
        matrix.columns.back().push_back(cells[of_row.row * width + of_column.column]);
    }
    expect_inverse(matrix, kernel);
    if (testing::Test::HasFailure()) return;
  }
}

}  // namespace
}  // namespace quadrille::continuous::test
