// SPDX-License-Identifier: MIT
#pragma once

#include <variant>
#include <vector>

#include "quadrille/continuous/instance.hpp"

namespace quadrille::continuous {

/// For tables by body: equal for equal bodies; radii and corners, in order.
[[nodiscard]] inline std::vector<Length> numbers_of(const Body& body) {
  if (const auto* disc = std::get_if<Disc>(&body)) return {disc->radius};
  std::vector<Length> numbers;
  for (const Point& corner : std::get<ConvexPolygon>(body).vertices()) {
    numbers.push_back(corner.x);
    numbers.push_back(corner.y);
  }
  return numbers;
}

}  // namespace quadrille::continuous
