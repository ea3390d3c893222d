// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "paths/timed_path.hpp"

namespace quadrille::continuous {

/// A set of moments x_0, x_1, ..., one per variable, that is described by upper limits on their
/// differences: a difference-bound matrix (Dill 1989, CAV), always closed, so that each limit is
/// the least one that follows from all of them. With whole limits a set that has a point has a
/// whole one. Never empty. Limits and moments are in ticks, below kForever.
class Zone {
 public:
  /// Without limits.
  explicit Zone(std::size_t num_variables);

  /// The least upper limit on x - y; kForever: none.
  [[nodiscard]] Ticks most(std::size_t x, std::size_t y) const { return limits_[x * size_ + y]; }
  /// Keeps those with x - y <= `limit`. False: there are none; the zone is of no use then. O(n^2).
  [[nodiscard]] bool restrict(std::size_t x, std::size_t y, Ticks limit);
  /// x may be larger, whatever the others are. O(n), as those that follow.
  void free_above(std::size_t x);
  /// x may be anything.
  void forget(std::size_t x);
  /// x is what y is.
  void assign(std::size_t x, std::size_t y);
  /// Whether each point of `other` is one of this. Of equally many variables. O(n^2).
  [[nodiscard]] bool includes(const Zone& other) const;

 private:
  [[nodiscard]] Ticks& limit(std::size_t x, std::size_t y) { return limits_[x * size_ + y]; }

  std::size_t size_;
  std::vector<Ticks> limits_;  // by x, by y
};

}  // namespace quadrille::continuous
