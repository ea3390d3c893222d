// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "quadrille/continuous/grid.hpp"
#include "quadrille/continuous/instance.hpp"
#include "quadrille/continuous/plan.hpp"
#include "quadrille/core/ids.hpp"
#include "quadrille/discrete/instance.hpp"
#include "quadrille/discrete/plan.hpp"

namespace quadrille::view {

/// In cells (x = column, y = row, down), or in length units of a roadmap.
struct Position {
  double x = 0, y = 0;
};

/// A connection between two places.
struct Link {
  std::size_t from, to;
  bool one_way = false;
};

/// The cells behind the agents. Cell (x, y) is the square around (x, y) * pitch.
struct Cells {
  std::int32_t width = 0, height = 0;
  std::vector<bool> passable;  ///< Row by row.
  double pitch = 1;
};

/// A stay at a place, from `arrive` to `depart`.
struct SceneStop {
  std::size_t place;
  std::int64_t arrive, depart;
};

struct SceneAgent {
  std::size_t start, goal;                ///< Places.
  std::size_t body = 0;                   ///< Into Scene::bodies, where there are any.
  std::optional<std::int64_t> free_cost;  ///< Alone in the world; nullopt: no way.
  std::optional<std::int64_t> cost;       ///< Nullopt without a path.
  std::vector<SceneStop> stops;           ///< In order of time; empty without a path.
};

struct SceneViolation {
  std::string kind, message;
  std::size_t agent;
  std::optional<std::size_t> other;
  double time;  ///< When it is best looked at.
};

/// Two agents, how near they come, and when.
struct Nearness {
  std::size_t agent, other;
  double gap, time;
};

/// All that pictures show, in either domain. Times are in timesteps or ticks.
struct Scene {
  bool is_continuous = false;
  bool has_layout = true;  ///< Positions are those of the input.
  bool y_up = false;
  double time_unit = 1, length_unit = 1;  ///< One tick and one length unit, as the input counts.
  std::optional<Cells> cells;
  std::vector<Position> places;
  std::vector<Link> links;
  std::size_t hidden_links = 0;  ///< Links that are left out because there are too many.
  std::vector<continuous::Body> bodies;
  std::vector<SceneAgent> agents;
  std::vector<SceneViolation> violations;
  std::vector<Nearness> nearest;  ///< The pairs that come nearest, nearest first.
  std::int64_t sum_of_costs = 0, makespan = 0;
};

[[nodiscard]] Scene make_scene(const discrete::Instance& instance, const discrete::Plan& plan);
[[nodiscard]] Scene make_scene(const continuous::Instance& instance, const continuous::Plan& plan,
                               const continuous::GridRoadmap* grid);

/// Where the path is at a time. Requires a path.
[[nodiscard]] Position position_at(const Scene& scene, const SceneAgent& agent, double time);

/// Positions for a graph that has none, about one unit apart: neighbours are near each other.
/// Deterministic. O(V + E), and O(V^2) up to some hundred vertices.
[[nodiscard]] std::vector<Position> lay_out(const discrete::Graph& graph);

}  // namespace quadrille::view
