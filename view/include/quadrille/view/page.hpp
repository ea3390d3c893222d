// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "quadrille/continuous/grid.hpp"
#include "quadrille/continuous/instance.hpp"
#include "quadrille/continuous/plan.hpp"
#include "quadrille/core/attribution.hpp"
#include "quadrille/core/export.hpp"
#include "quadrille/core/outcome.hpp"
#include "quadrille/discrete/instance.hpp"
#include "quadrille/discrete/plan.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::view {

/// What is shown of a plan besides the plan.
struct PageOptions {
  std::string title;  ///< UTF-8; empty: "Plan of 12 agents".
  Objective objective = Objective::sum_of_costs;
  std::optional<Status> status;     ///< What is claimed about the plan.
  std::optional<Cost> lower_bound;  ///< Of the objective, in timesteps or ticks.
  /// Why no plan is cheaper, of this instance; shown as places, pairs of agents and raises.
  std::optional<Attribution> attribution;
};

/// One HTML page that plays the plan in a browser: a single text that needs no other file and no
/// network. Takes any plan, however broken: what `verify` says against it is listed in the page.
/// A path counts up to its first vertex that the graph does not have; paths beyond the number of
/// agents are not shown. Deterministic. What it can do: docs/view.md.
///
/// Time: that of `verify`, and one breadth-first search (roadmaps: Dijkstra's) per agent for what
/// it would cost alone. Size: about 60 kB, and a few bytes per move and blocked cell, or 20 per
/// stop, vertex and edge.
[[nodiscard]] std::string page(const discrete::Instance& instance, const discrete::Plan& plan,
                               const PageOptions& options = {});
/// `grid`: the cells of the roadmap, if it is that of a grid; drawn instead of edges.
[[nodiscard]] std::string page(const continuous::Instance& instance, const continuous::Plan& plan,
                               const PageOptions& options = {},
                               const continuous::GridRoadmap* grid = nullptr);

}  // namespace quadrille::view

QUADRILLE_API_END
