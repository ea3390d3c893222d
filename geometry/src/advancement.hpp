// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>

#include "planar.hpp"
#include "quadrille/geometry/body.hpp"

namespace quadrille::geometry {

/// Conservative advancement for two bodies of which at least one is a polygon: looks for a proof
/// that they stay apart. FCL's distance query proposes directions that separate the bodies; what
/// a direction proves is computed here, from the corners and with an error bound, so that neither
/// FCL's and libccd's tolerances nor their failures can make an answer wrong.
///
/// Immutable; may be used from several threads at once.
class Advancement {
 public:
  /// `shape`: the corners of a grown by the mirrored b, `reach` the radius on top.
  Advancement(const Body& a, const Body& b, std::span<const Point> shape, Length reach);
  ~Advancement();

  /// True only if b, moving along `path` relative to a, never comes so near that the interiors
  /// meet. False says nothing.
  [[nodiscard]] bool proves_apart(const RelativePath& path) const;

 private:
  struct Shapes;
  std::unique_ptr<const Shapes> shapes_;
  std::vector<Vec> shape_;
  double reach_;
};

}  // namespace quadrille::geometry
