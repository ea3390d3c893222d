// SPDX-License-Identifier: MIT
#include "cover/kernel.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace quadrille::continuous {
namespace {

constexpr double kSmallestPivot = 1e-7;

void subtract_line(double* __restrict from, const double* __restrict line, double factor,
                   std::size_t size) {
  for (std::size_t t = 0; t < size; ++t) from[t] -= factor * line[t];
}

}  // namespace

void Kernel::clear() {
  size_ = 0;
  age_ = 0;
  prices_.clear();
}

void Kernel::copy(const Kernel& other) {
  if (other.size_ > stride_) {
    stride_ = other.size_;
    cells_.assign(stride_ * stride_, 0.0);
  }
  size_ = other.size_;
  age_ = other.age_;
  prices_ = other.prices_;
  for (std::size_t i = 0; i < size_; ++i)
    std::copy_n(other.cells_.data() + i * other.stride_, size_, row(i));
  effort_ += static_cast<std::int64_t>(size_ * size_ / 4);
}

void Kernel::subtract(double* from, double factor, const double* line) {
  if (factor == 0) return;
  subtract_line(from, line, factor, size_);
  effort_ += static_cast<std::int64_t>(size_);
}

// Room for `size` columns and rows. What is beyond `size_` has any value.
void Kernel::reserve(std::size_t size) {
  if (size > stride_) {
    const std::size_t wider = size + size / 2 + 6;
    std::vector<double> cells(wider * wider, 0.0);
    for (std::size_t i = 0; i < size_; ++i)
      std::copy_n(cells_.data() + i * stride_, size_, cells.data() + i * wider);
    cells_ = std::move(cells);
    stride_ = wider;
  }
}

// Gauss and Jordan in place: for each column the row with its largest cell among those that no
// column has yet.
std::vector<Kernel::Pair> Kernel::invert(std::vector<double> cells,
                                         const std::vector<double>& values,
                                         const std::vector<double>& weights) {
  clear();
  const std::size_t width = values.size(), height = weights.size();
  std::vector<Pair> pairs;
  std::vector<char> is_taken(height, 0);
  for (std::size_t j = 0; j < width; ++j) {
    std::size_t pivot = height;
    double largest = kSmallestPivot;
    for (std::size_t t = 0; t < height; ++t) {
      const double cell = std::abs(cells[t * width + j]) * weights[t];
      if (is_taken[t] != 0 || cell <= largest) continue;
      largest = cell;
      pivot = t;
    }
    if (pivot == height) continue;
    is_taken[pivot] = 1;
    pairs.push_back({j, pivot});
    double* const line = cells.data() + pivot * width;
    const double inverse = 1 / line[j];
    line[j] = 1;
    for (std::size_t k = 0; k < width; ++k) line[k] *= inverse;
    for (std::size_t t = 0; t < height; ++t) {
      double* const other = cells.data() + t * width;
      const double factor = other[j];
      if (t == pivot || factor == 0) continue;
      other[j] = 0;
      subtract_line(other, line, factor, width);
      effort_ += static_cast<std::int64_t>(width);
    }
  }
  reserve(pairs.size());
  size_ = pairs.size();
  prices_.assign(size_, 0);
  for (std::size_t i = 0; i < size_; ++i) {
    for (std::size_t t = 0; t < size_; ++t)
      row(i)[t] = cells[pairs[i].row * width + pairs[t].column];
    subtract(prices_.data(), -values[pairs[i].column], row(i));
  }
  return pairs;
}

void Kernel::times(const std::vector<Entry>& column, std::vector<double>& result) {
  result.assign(size_, 0);
  for (std::size_t i = 0; i < size_; ++i) {
    const double* const cells = row(i);
    double sum = 0;
    for (const Entry& entry : column) sum += entry.value * cells[entry.at];
    result[i] = sum;
  }
  effort_ += static_cast<std::int64_t>(size_ * column.size());
}

void Kernel::times(const std::vector<double>& column, std::vector<double>& result) {
  result.assign(size_, 0);
  for (std::size_t i = 0; i < size_; ++i) {
    const double* const cells = row(i);
    double even = 0, odd = 0;
    std::size_t t = 0;
    for (; t + 1 < size_; t += 2) {
      even += cells[t] * column[t];
      odd += cells[t + 1] * column[t + 1];
    }
    if (t < size_) even += cells[t] * column[t];
    result[i] = even + odd;
  }
  effort_ += static_cast<std::int64_t>(size_ * size_);
}

void Kernel::times_row(const std::vector<Entry>& entries, std::vector<double>& result) {
  result.assign(size_, 0);
  for (const Entry& entry : entries) subtract(result.data(), -entry.value, row(entry.at));
}

void Kernel::replace_column(std::size_t column, const std::vector<double>& image, double missing) {
  ++age_;
  double* const line = row(column);
  const double inverse = 1 / image[column];
  for (std::size_t t = 0; t < size_; ++t) line[t] *= inverse;
  for (std::size_t i = 0; i < size_; ++i)
    if (i != column) subtract(row(i), image[i], line);
  subtract(prices_.data(), missing, line);
}

void Kernel::grow(const std::vector<double>& image, const std::vector<double>& row_image,
                  double pivot, double missing) {
  ++age_;
  reserve(size_ + 1);
  for (std::size_t i = 0; i < size_; ++i) row(i)[size_] = 0;
  prices_.push_back(0);
  double* const line = row(size_);
  const double inverse = 1 / pivot;
  for (std::size_t t = 0; t < size_; ++t) line[t] = -inverse * row_image[t];
  line[size_] = inverse;
  const std::size_t before = size_++;
  for (std::size_t i = 0; i < before; ++i) subtract(row(i), image[i], line);
  subtract(prices_.data(), missing, line);
}

void Kernel::shrink(std::size_t column, std::size_t of_row) {
  ++age_;
  double* const line = row(column);
  const double inverse = 1 / line[of_row];
  for (std::size_t t = 0; t < size_; ++t) line[t] *= inverse;
  for (std::size_t i = 0; i < size_; ++i)
    if (i != column) subtract(row(i), row(i)[of_row], line);
  subtract(prices_.data(), prices_[of_row], line);
  const std::size_t last = size_ - 1;
  if (column != last) std::copy_n(row(last), size_, line);
  for (std::size_t i = 0; i < last; ++i) row(i)[of_row] = row(i)[last];
  prices_[of_row] = prices_[last];
  prices_.pop_back();
  size_ = last;
}

void Kernel::replace_row(std::size_t of_row, const std::vector<double>& row_image) {
  ++age_;
  const double inverse = 1 / row_image[of_row];
  line_.resize(size_);
  for (std::size_t t = 0; t < size_; ++t) line_[t] = inverse * row_image[t];
  line_[of_row] = 1 - inverse;
  for (std::size_t i = 0; i < size_; ++i) subtract(row(i), row(i)[of_row], line_.data());
  subtract(prices_.data(), prices_[of_row], line_.data());
}

}  // namespace quadrille::continuous
