// SPDX-License-Identifier: MIT
#include "joint/zone.hpp"

namespace quadrille::continuous {
namespace {

Ticks sum(Ticks a, Ticks b) { return a >= kForever || b >= kForever ? kForever : a + b; }

}  // namespace

Zone::Zone(std::size_t num_variables)
    : size_(num_variables), limits_(num_variables * num_variables, kForever) {
  for (std::size_t x = 0; x < size_; ++x) limit(x, x) = 0;
}

bool Zone::restrict(std::size_t x, std::size_t y, Ticks limit_xy) {
  if (most(x, y) <= limit_xy) return true;
  if (sum(most(y, x), limit_xy) < 0) return false;
  // What is shorter now goes by way of the limit that was added: a - b <= (a - x) + (x - y) +
  // (y - b).
  for (std::size_t a = 0; a < size_; ++a) {
    const Ticks to_y = sum(most(a, x), limit_xy);
    if (to_y >= kForever) continue;
    for (std::size_t b = 0; b < size_; ++b) {
      const Ticks by_way = sum(to_y, most(y, b));
      if (by_way < most(a, b)) limit(a, b) = by_way;
    }
  }
  return true;
}

void Zone::free_above(std::size_t x) {
  for (std::size_t y = 0; y < size_; ++y)
    if (y != x) limit(x, y) = kForever;
}

void Zone::forget(std::size_t x) {
  free_above(x);
  for (std::size_t y = 0; y < size_; ++y)
    if (y != x) limit(y, x) = kForever;
}

void Zone::assign(std::size_t x, std::size_t y) {
  for (std::size_t z = 0; z < size_; ++z) {
    if (z == x) continue;
    limit(x, z) = most(y, z);
    limit(z, x) = most(z, y);
  }
}

bool Zone::includes(const Zone& other) const {
  for (std::size_t at = 0; at < limits_.size(); ++at)
    if (limits_[at] < other.limits_[at]) return false;
  return true;
}

}  // namespace quadrille::continuous
