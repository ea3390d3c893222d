// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "quadrille/core/export.hpp"
#include "quadrille/geometry/body_pair.hpp"
#include "quadrille/geometry/motion.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::geometry {

/// Which motions can ever meet, before any exact test: FCL's tree of boxes, then FCL's distances
/// between what the bodies sweep. Rests are motions too, of any duration.
///
/// What a disc sweeps is a capsule, what a polygon sweeps the convex hull of its first and its last
/// place, because it does not turn. All radii and polygons go to one side, which changes no
/// distance: a list of motions is a list of lines, in one tree that serves bodies of all kinds, and
/// the motion that is looked at has both bodies, its own grown by the mirrored other one.
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
    /// The bodies can collide, by more than rounding: no other test is needed.
    bool is_sure;
  };
  /// How many motions each stage has settled, and what is left.
  struct Tally {
    std::size_t by_boxes = 0;  ///< The boxes are apart.
    std::size_t apart = 0;     ///< FCL's distance of the lines is too large.
    /// With a polygon: what the bodies sweep is apart, as a straight line shows between the points
    /// in which the lines are nearest, or what is swept.
    std::size_t by_nearest = 0, by_hulls = 0;
    std::size_t sure = 0;
    std::size_t doubtful = 0;
  };

  /// Those of the motions that the second of the bodies may make and collide with the first one on
  /// `motion` at some offset, ascending. None that can is missing (BodyPair::can_meet). Of two
  /// discs, others are among them only if the lines come nearer than the radii plus 2^-20 of the
  /// extent of the two lines together. With a polygon a straight line has to be found between what
  /// the two sweep, leaving them 2^-47 of the sum of all lengths apart: FCL's nearest points
  /// propose it, what it proves is computed from corners and radii, so that FCL's tolerances and
  /// failures can leave motions in doubt but never drop one.
  ///
  /// Requires a valid motion, and with a polygon that it and all of the list have one height. Adds
  /// to `tally`.
  [[nodiscard]] std::vector<Nearby> near(const Motion& motion, const BodyPair& bodies,
                                         Tally* tally = nullptr) const;

 private:
  class Tree;

  std::unique_ptr<Tree> tree_;
};

}  // namespace quadrille::geometry

QUADRILLE_API_END
