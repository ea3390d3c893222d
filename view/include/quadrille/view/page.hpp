// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "quadrille/continuous/grid.hpp"
#include "quadrille/continuous/instance.hpp"
#include "quadrille/continuous/plan.hpp"
#include "quadrille/continuous/pose_grid.hpp"
#include "quadrille/core/attribution.hpp"
#include "quadrille/core/export.hpp"
#include "quadrille/core/ids.hpp"
#include "quadrille/core/outcome.hpp"
#include "quadrille/discrete/instance.hpp"
#include "quadrille/discrete/plan.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::view {

/// Why an instance has no plan at all, such as `discrete::check_feasibility` finds it.
struct Obstruction {
  std::string reason;           ///< One sentence, UTF-8.
  std::vector<AgentId> agents;  ///< Whom it names.
  std::vector<VertexId>
      vertices;  ///< And the place, in the order of the way through it; may be empty.
};

/// What is shown of a plan besides the plan.
struct PageOptions {
  std::string title;  ///< UTF-8; empty: "Plan of 12 agents".
  /// What agents are called, by number; an empty text, or none: "agent 3".
  std::vector<std::string> agent_names = {};
  Objective objective = Objective::sum_of_costs;
  std::optional<Status> status;     ///< What is claimed about the plan.
  std::optional<Cost> lower_bound;  ///< Of the objective, in timesteps or ticks.
  /// Why no plan is cheaper, of this instance; shown as places, pairs of agents and raises.
  std::optional<Attribution> attribution;
  /// Shown instead of a plan and of what `verify` says: the plan should have no paths.
  std::optional<Obstruction> obstruction;
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
/// Robots that turn on a grid: `poses` are what the instance is made of. Arrows show where they
/// face.
[[nodiscard]] std::string page(const continuous::Instance& instance, const continuous::Plan& plan,
                               const PageOptions& options, const continuous::PoseGrid& poses);

/// A stay of a robot that is being watched, anywhere, in length units and ticks.
struct Sight {
  double x = 0, y = 0, z = 0;
  std::int64_t arrive = 0, depart = 0;
  /// Where it faces, in degrees from the axis of x towards that of y, if it has headings.
  std::optional<double> heading = {};
};
/// What it did: it stood at its sights, and went straight and evenly from each to the next,
/// turning by the shorter way.
using Track = std::vector<Sight>;
/// The same page of what robots did, in place of a plan. Tells of no costs and violations. Arrows
/// show where they face if all sights say so. Requires a track, of at least one sight, per agent,
/// whose bodies and roads are shown; those that change
/// their bodies on the way are shown with that of their start.
[[nodiscard]] std::string page(const continuous::Instance& instance,
                               const std::vector<Track>& tracks, const PageOptions& options = {},
                               const continuous::GridRoadmap* grid = nullptr);

}  // namespace quadrille::view

QUADRILLE_API_END
