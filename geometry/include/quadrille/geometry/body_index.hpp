// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <optional>

#include "quadrille/core/export.hpp"
#include "quadrille/geometry/body.hpp"
#include "quadrille/geometry/place.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::geometry {

/// Bodies that rest, with numbers: finds who overlaps another one without looking at all of them.
/// Where few are near each other, a call takes time in the logarithm of their number.
class BodyIndex {
 public:
  BodyIndex();
  ~BodyIndex();
  BodyIndex(BodyIndex&&) noexcept;
  BodyIndex& operator=(BodyIndex&&) noexcept;

  /// Requires a place in range and a radius in [1, kMaxLength]. The body is copied.
  void add(std::size_t number, const Body& body, const Place& place);
  /// The least number of a body that is there and whose interior meets that of this one; both are
  /// balls unless all are in the plane. Requirements as of `add`.
  [[nodiscard]] std::optional<std::size_t> first_overlap(const Body& body,
                                                         const Place& place) const;

 private:
  class Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace quadrille::geometry

QUADRILLE_API_END
