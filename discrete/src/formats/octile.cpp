// SPDX-License-Identifier: MIT
#include "formats/octile.hpp"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <queue>
#include <tuple>

namespace quadrille::discrete {
namespace {

/// Straight and diagonal steps are counted apart, so that sums carry no rounding errors.
struct Steps {
  std::int32_t straight = 0, diagonal = 0;
  [[nodiscard]] double length() const { return straight + diagonal * std::numbers::sqrt2; }
};

struct Entry {
  double estimate;  // Of the whole way; never too large.
  Steps steps;
  Cell cell;
  friend bool operator>(const Entry& a, const Entry& b) {
    return std::tie(a.estimate, a.cell) > std::tie(b.estimate, b.cell);
  }
};

double estimate(Steps steps, Cell from, Cell to) {
  const std::int32_t dx = std::abs(from.x - to.x), dy = std::abs(from.y - to.y);
  steps.diagonal += std::min(dx, dy);
  steps.straight += std::max(dx, dy) - std::min(dx, dy);
  return steps.length();
}

}  // namespace

OctileDistance::OctileDistance(const GridMap& map)
    : map_(map), length_(map.passable.size()), queried_(map.passable.size(), 0) {}

bool OctileDistance::is_open(std::int32_t x, std::int32_t y) const {
  return x >= 0 && y >= 0 && x < map_.width && y < map_.height && map_.is_passable({x, y});
}

std::size_t OctileDistance::index(Cell cell) const {
  return static_cast<std::size_t>(cell.y) * static_cast<std::size_t>(map_.width) +
         static_cast<std::size_t>(cell.x);
}

double OctileDistance::between(Cell start, Cell goal) {
  ++query_;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  const auto reach = [&](Steps steps, Cell cell) {
    const std::size_t at = index(cell);
    if (queried_[at] == query_ && length_[at] <= steps.length()) return;
    queried_[at] = query_;
    length_[at] = steps.length();
    open.push({estimate(steps, cell, goal), steps, cell});
  };
  reach({}, start);
  while (!open.empty()) {
    const auto [unused, steps, cell] = open.top();
    open.pop();
    if (cell == goal) return steps.length();
    if (steps.length() > length_[index(cell)]) continue;
    for (std::int32_t dy = -1; dy <= 1; ++dy)
      for (std::int32_t dx = -1; dx <= 1; ++dx) {
        const bool diagonal = dx != 0 && dy != 0;
        if ((dx == 0 && dy == 0) || !is_open(cell.x + dx, cell.y + dy)) continue;
        if (diagonal && !(is_open(cell.x + dx, cell.y) && is_open(cell.x, cell.y + dy))) continue;
        reach({steps.straight + (diagonal ? 0 : 1), steps.diagonal + (diagonal ? 1 : 0)},
              {cell.x + dx, cell.y + dy});
      }
  }
  return std::numeric_limits<double>::infinity();
}

}  // namespace quadrille::discrete
