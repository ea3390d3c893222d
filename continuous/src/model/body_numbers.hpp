// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
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

/// Likewise of all bodies of an agent, as far as it has shapes.
[[nodiscard]] inline std::vector<Length> numbers_of(const Agent& agent) {
  std::vector<Length> all = numbers_of(agent.body);
  for (const Body& body : agent.shapes) {
    const std::vector<Length> numbers = numbers_of(body);
    all.push_back(Length(-static_cast<std::int64_t>(numbers.size())));
    all.insert(all.end(), numbers.begin(), numbers.end());
  }
  return all;
}

}  // namespace quadrille::continuous
