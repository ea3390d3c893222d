// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "traffic/steps.hpp"

namespace quadrille::continuous {

/// Where a body may be: all points from `low` to `high`.
struct Extent {
  Point low, high;
  [[nodiscard]] bool overlaps(const Extent& other) const {
    return low.x < other.high.x && other.low.x < high.x && low.y < other.high.y &&
           other.low.y < high.y && low.z < other.high.z && other.low.z < high.z;
  }
};

/// Squares that cover a roadmap, seen from above: about as many as it has vertices, so that an edge
/// to a neighbour covers few of them. What is beyond counts to the squares at the border, so that
/// boxes that overlap have a square in common.
class SquareGrid {
 public:
  explicit SquareGrid(const Instance& instance) : instance_(instance) {
    const std::vector<Point>& positions = instance.roadmap().positions();
    if (positions.empty()) return;
    Point low = positions.front(), high = low;
    for (const Point& p : positions) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    origin_ = low;
    const std::int64_t width = (high.x - low.x).value(), height = (high.y - low.y).value();
    const auto per_side =
        static_cast<std::int64_t>(std::sqrt(static_cast<double>(positions.size())));
    side_ = std::max(width, height) / std::max<std::int64_t>(per_side, 1) + 1;
    columns_ = width / side_ + 1;
    rows_ = height / side_ + 1;
  }

  [[nodiscard]] std::size_t size() const { return static_cast<std::size_t>(columns_ * rows_); }
  /// Where an agent of class `c` may be that goes from `p` to `q`.
  [[nodiscard]] Extent box_of(ClassId c, const Point& p, const Point& q) const {
    const Length reach = instance_.reach(c);
    return {{std::min(p.x, q.x) - reach, std::min(p.y, q.y) - reach, std::min(p.z, q.z) - reach},
            {std::max(p.x, q.x) + reach, std::max(p.y, q.y) + reach, std::max(p.z, q.z) + reach}};
  }
  [[nodiscard]] Extent box_of(ClassId c, const Step& step) const {
    const Roadmap& roadmap = instance_.roadmap();
    const Point from = roadmap.position(step.is_move ? roadmap.edge(step.edge).from : step.vertex);
    return box_of(c, from, step.is_move ? roadmap.position(roadmap.edge(step.edge).to) : from);
  }
  /// Calls `visit` with the number of each square that the box covers.
  template <class Visit>
  void for_each(const Extent& box, const Visit& visit) const {
    const std::int64_t left = square(box.low.x, origin_.x, columns_),
                       right = square(box.high.x, origin_.x, columns_),
                       bottom = square(box.low.y, origin_.y, rows_),
                       top = square(box.high.y, origin_.y, rows_);
    for (std::int64_t row = bottom; row <= top; ++row)
      for (std::int64_t column = left; column <= right; ++column)
        visit(static_cast<std::size_t>(row * columns_ + column));
  }

 private:
  [[nodiscard]] std::int64_t square(Length at, Length origin, std::int64_t count) const {
    return std::clamp<std::int64_t>((at - origin).value() / side_, 0, count - 1);
  }

  const Instance& instance_;
  Point origin_;
  std::int64_t side_ = 1, columns_ = 1, rows_ = 1;
};

}  // namespace quadrille::continuous
