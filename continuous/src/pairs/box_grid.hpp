// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "quadrille/continuous/roadmap.hpp"

namespace quadrille::continuous {

/// Around a move or a place, seen from above: what is far apart there is so in space.
struct Box {
  Length left, right, bottom, top;
};

/// Whether what is in the boxes is at least `reach` apart.
[[nodiscard]] constexpr bool are_far(const Box& a, const Box& b, Length reach) {
  return a.left - b.right >= reach || b.left - a.right >= reach || a.bottom - b.top >= reach ||
         b.bottom - a.top >= reach;
}

/// Boxes by the cells of a grid, to find those near another box without looking at all of them. As
/// large as the boxes on average, or as twice the `reach`; no more than a few cells per box, so
/// that n boxes are filled in linear time, if they are of about one size, and in n^1.5 at worst.
/// The same object can be filled again and again: it keeps its memory.
class BoxGrid {
 public:
  /// Boxes are numbered as they come. `reach`: about how far is asked for.
  void fill(std::span<const Box> boxes, Length reach);

  /// Calls `visit(number)` once for each box that is not far from this one, in an order that
  /// depends on nothing but the boxes.
  template <class Visit>
  void visit_near(const Box& box, Length reach, const Visit& visit) {
    if (boxes_.empty() || are_far(all_, box, reach)) return;
    ++now_;
    const Cells cells =
        cells_of({box.left - reach, box.right + reach, box.bottom - reach, box.top + reach});
    for (std::size_t row = cells.first_row; row <= cells.last_row; ++row)
      for (std::size_t at = row * columns_ + cells.first_column,
                       last = row * columns_ + cells.last_column;
           at <= last; ++at)
        for (std::size_t k = begins_[at]; k < begins_[at + 1]; ++k) {
          const std::uint32_t number = numbers_[k];
          ++num_looks_;
          if (seen_[number] == now_) continue;
          seen_[number] = now_;
          if (!are_far(boxes_[number], box, reach)) visit(number);
        }
  }
  /// Entries of cells that were looked at so far.
  [[nodiscard]] std::int64_t num_looks() const noexcept { return num_looks_; }

 private:
  struct Cells {
    std::size_t first_column, last_column, first_row, last_row;
  };
  void choose_cells(Length reach);
  /// What is outside belongs to the cells at the border.
  [[nodiscard]] Cells cells_of(const Box& box) const;
  template <class Visit>
  void visit_cells(const Box& box, const Visit& visit) const;

  std::vector<Box> boxes_;
  Box all_{};        // around them
  Length cell_ = 1;  // the side of a cell
  std::size_t columns_ = 1, rows_ = 1;
  std::vector<std::size_t> begins_;     // by cell, row by row, and one more: into numbers_
  std::vector<std::uint32_t> numbers_;  // of the boxes, by cell
  std::vector<std::uint64_t> seen_;     // by box, when it was last
  std::uint64_t now_ = 0;
  std::int64_t num_looks_ = 0;
};

}  // namespace quadrille::continuous
