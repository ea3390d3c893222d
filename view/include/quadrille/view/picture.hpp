// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "quadrille/continuous/grid.hpp"
#include "quadrille/continuous/instance.hpp"
#include "quadrille/continuous/plan.hpp"
#include "quadrille/continuous/pose_grid.hpp"
#include "quadrille/core/export.hpp"
#include "quadrille/core/result.hpp"
#include "quadrille/discrete/instance.hpp"
#include "quadrille/discrete/plan.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::view {

enum class PictureKind {
  map,         ///< The map with paths, starts and goals.
  space_time,  ///< Time to the right, upwards the way along the path of the first agent chosen;
               ///< the others are drawn where they are on that path.
  waits,       ///< A row per agent: when it moves, when it waits.
};
[[nodiscard]] std::string_view to_string(
    PictureKind kind) noexcept;  ///< "map" | "space-time" | ...
[[nodiscard]] std::optional<PictureKind> parse_picture_kind(std::string_view text) noexcept;

struct PictureOptions {
  PictureKind kind = PictureKind::map;
  std::string title;            ///< UTF-8; may be empty.
  std::vector<AgentId> agents;  ///< Who is drawn; empty: all.
};

/// A plan as an SVG picture. Takes any plan, however broken, as `page` does. Deterministic. Errors:
/// out_of_range for an agent that the instance does not have.
[[nodiscard]] Result<std::string> picture(const discrete::Instance& instance,
                                          const discrete::Plan& plan,
                                          const PictureOptions& options = {});
/// `grid`: the cells of the roadmap, if it is that of a grid; drawn instead of edges.
[[nodiscard]] Result<std::string> picture(const continuous::Instance& instance,
                                          const continuous::Plan& plan,
                                          const PictureOptions& options = {},
                                          const continuous::GridRoadmap* grid = nullptr);
/// As `page`: arrows show where robots face that turn on a grid.
[[nodiscard]] Result<std::string> picture(const continuous::Instance& instance,
                                          const continuous::Plan& plan,
                                          const PictureOptions& options,
                                          const continuous::PoseGrid& poses);

}  // namespace quadrille::view

QUADRILLE_API_END
