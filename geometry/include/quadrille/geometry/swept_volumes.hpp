// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "quadrille/core/export.hpp"
#include "quadrille/geometry/motion.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::geometry {

/// Which motions can ever meet: the lines of a list of motions (rests are motions too, of any
/// duration) in FCL's tree of boxes, and FCL's distance between those whose boxes overlap. What a
/// body sweeps along a line is within its reach from it, of a disc all of that: a capsule. So one
/// tree serves bodies of all sizes, and few pairs are left for an exact test.
///
/// Immutable; queries may be made from several threads at once.
class SweptVolumes {
 public:
  /// Requires valid motions. Memory and time grow as n and n log n with their number.
  explicit SweptVolumes(std::vector<Motion> motions);
  ~SweptVolumes();
  SweptVolumes(SweptVolumes&&) noexcept;
  SweptVolumes& operator=(SweptVolumes&&) noexcept;

  [[nodiscard]] const std::vector<Motion>& motions() const noexcept;

  /// A motion that comes near.
  struct Nearby {
    std::size_t index;
    /// The lines come nearer than the reach, by more than rounding: discs with that sum of radii
    /// can collide.
    bool is_sure;
  };
  /// How many motions each stage has settled, and what is left.
  struct Tally {
    std::size_t by_boxes = 0;  ///< The boxes are apart.
    std::size_t apart = 0;     ///< FCL's distance is too large.
    std::size_t sure = 0;
    std::size_t doubtful = 0;
  };

  /// Those of the motions whose lines come nearer than `reach` to that of `motion`, ascending; none
  /// of them is missing, and others are among them only if they come nearer than `reach` plus
  /// 2^-20 of the extent of the two lines together. Requires a valid motion and `reach` of at
  /// least 0, at most 4 kMaxLength. Adds to `tally`.
  [[nodiscard]] std::vector<Nearby> near(const Motion& motion, Length reach,
                                         Tally* tally = nullptr) const;

 private:
  class Tree;

  std::unique_ptr<Tree> tree_;
};

}  // namespace quadrille::geometry

QUADRILLE_API_END
