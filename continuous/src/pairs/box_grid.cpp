// SPDX-License-Identifier: MIT
#include "pairs/box_grid.hpp"

#include <algorithm>

namespace quadrille::continuous {
namespace {

/// Cells of the grid for each box, at most.
constexpr std::int64_t kCellsPerBox = 4;

}  // namespace

void BoxGrid::fill(std::span<const Box> boxes, Length reach) {
  boxes_.assign(boxes.begin(), boxes.end());
  if (boxes_.empty()) return;
  seen_.assign(boxes_.size(), now_);
  choose_cells(reach);
  begins_.assign(columns_ * rows_ + 1, 0);
  for (const Box& box : boxes_) visit_cells(box, [&](std::size_t at) { ++begins_[at + 1]; });
  for (std::size_t at = 1; at < begins_.size(); ++at) begins_[at] += begins_[at - 1];
  numbers_.resize(begins_.back());
  // Each begin moves to its end, which is the next one's begin.
  for (std::uint32_t k = 0; k < boxes_.size(); ++k)
    visit_cells(boxes_[k], [&](std::size_t at) { numbers_[begins_[at]++] = k; });
  std::copy_backward(begins_.begin(), begins_.end() - 1, begins_.end());
  begins_.front() = 0;
}

void BoxGrid::choose_cells(Length reach) {
  all_ = boxes_.front();
  Length sum = 0;
  for (const Box& box : boxes_) {
    all_ = {std::min(all_.left, box.left), std::max(all_.right, box.right),
            std::min(all_.bottom, box.bottom), std::max(all_.top, box.top)};
    sum += std::max(box.right - box.left, box.top - box.bottom);
  }
  const auto size = static_cast<std::int64_t>(boxes_.size());
  const Length width = all_.right - all_.left, height = all_.top - all_.bottom;
  const auto count = [&](Length extent) { return extent.value() / cell_.value() + 1; };
  cell_ = std::max({sum / size, 2 * reach, Length(1)});
  while (count(width) > kCellsPerBox * size / count(height)) cell_ = 2 * cell_;
  columns_ = static_cast<std::size_t>(count(width));
  rows_ = static_cast<std::size_t>(count(height));
}

BoxGrid::Cells BoxGrid::cells_of(const Box& box) const {
  const auto cell = [&](Length offset, std::size_t count) {
    return static_cast<std::size_t>(std::clamp<std::int64_t>(offset.value() / cell_.value(), 0,
                                                             static_cast<std::int64_t>(count) - 1));
  };
  return {cell(box.left - all_.left, columns_), cell(box.right - all_.left, columns_),
          cell(box.bottom - all_.bottom, rows_), cell(box.top - all_.bottom, rows_)};
}

template <class Visit>
void BoxGrid::visit_cells(const Box& box, const Visit& visit) const {
  const Cells cells = cells_of(box);
  for (std::size_t row = cells.first_row; row <= cells.last_row; ++row)
    for (std::size_t column = cells.first_column; column <= cells.last_column; ++column)
      visit(row * columns_ + column);
}

}  // namespace quadrille::continuous
