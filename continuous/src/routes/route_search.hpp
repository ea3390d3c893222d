// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

#include "quadrille/continuous/plan.hpp"
#include "traffic/scene.hpp"

namespace quadrille::continuous {

struct RouteSearchReport {
  Cost lower_bound = 0;      ///< No plan costs less.
  std::optional<Plan> plan;  ///< A valid one, optimal if it costs `lower_bound`.
};

/// For few agents in each other's way: looks at all routes that a plan below some cost could have,
/// and at the orders in which they can be followed, for higher and higher costs. `work` bounds the
/// effort, whatever the clock says: about 10^8 take a second.
[[nodiscard]] RouteSearchReport search_routes(Scene& scene, Objective objective, std::int64_t work);

}  // namespace quadrille::continuous
