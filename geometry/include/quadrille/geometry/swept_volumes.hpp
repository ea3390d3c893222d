// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "quadrille/core/export.hpp"
#include "quadrille/geometry/body.hpp"
#include "quadrille/geometry/motion.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::geometry {

/// Broad phase: what one body covers along each of a list of motions (rests are motions too, of any
/// duration), in a tree, so that the few that can ever collide with a given motion are found fast.
/// Built once per body class of a roadmap; queries are made when they are needed, so that a large
/// roadmap costs only what is asked.
///
/// Immutable; queries may be made from several threads at once.
class SweptVolumes {
 public:
  /// Requires valid motions. Memory and time grow as n and n log n with their number.
  SweptVolumes(const Body& body, std::vector<Motion> motions);
  ~SweptVolumes();
  SweptVolumes(SweptVolumes&&) noexcept;
  SweptVolumes& operator=(SweptVolumes&&) noexcept;

  [[nodiscard]] const std::vector<Motion>& motions() const noexcept;

  /// The indices, ascending, of exactly those motions with which `visitor` on `motion` can collide:
  /// BodyPair(visitor, body).can_meet(motion, motions()[index]).
  [[nodiscard]] std::vector<std::size_t> near(const Body& visitor, const Motion& motion) const;

  /// near(visitor, motions()[index]). The index itself is always among them: two agents may be on
  /// the same motion.
  [[nodiscard]] std::vector<std::size_t> near(const Body& visitor, std::size_t index) const;

 private:
  class Tree;

  std::unique_ptr<Tree> tree_;
};

}  // namespace quadrille::geometry

QUADRILLE_API_END
