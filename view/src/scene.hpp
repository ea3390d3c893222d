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
#include "quadrille/continuous/pose_grid.hpp"
#include "quadrille/core/attribution.hpp"
#include "quadrille/core/goals.hpp"
#include "quadrille/core/ids.hpp"
#include "quadrille/discrete/instance.hpp"
#include "quadrille/discrete/plan.hpp"
#include "quadrille/view/page.hpp"

namespace quadrille::view {

/// In cells (x = column, y = row, down), or in length units of a roadmap. What is drawn is seen
/// from above.
struct Position {
  double x = 0, y = 0, z = 0;
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

/// Of an agent's goals the one at which its path ends, or the first one.
[[nodiscard]] inline VertexId goal_shown(const Goals& goals, VertexId end) {
  return goals.contains(end) ? end : goals.vertices().front();
}

/// All the others.
[[nodiscard]] inline std::vector<std::size_t> goals_not_shown(const Goals& goals, VertexId shown) {
  std::vector<std::size_t> places;
  for (const VertexId goal : goals.vertices())
    if (goal != shown) places.push_back(goal.index());
  return places;
}

struct SceneAgent {
  std::size_t start, goal;                ///< Places. Of several goals the one where it ends.
  std::size_t body = 0;                   ///< At its start; into Scene::bodies, if there are any.
  std::optional<std::int64_t> free_cost;  ///< Alone in the world; nullopt: no way.
  std::optional<std::int64_t> cost;       ///< Nullopt without a path.
  std::vector<SceneStop> stops;           ///< In order of time; empty without a path.
  bool leaves = false;                    ///< It is nowhere after its arrival.
  std::vector<std::size_t> other_goals;   ///< Places where it may end, too.
  std::size_t goal_body = 0;              ///< At its goal.
  /// Of one whose body changes on the way: at the first stop, from there to the next, at that, ...
  std::vector<std::size_t> looks = {};
};

/// A moving obstacle: nowhere before its first stop, and nowhere after the last one if it leaves.
struct SceneObstacle {
  struct Stop {
    Position at;
    std::int64_t arrive, depart;
  };
  std::size_t body;  ///< Into Scene::bodies.
  std::vector<Stop> stops;
  bool leaves;
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

/// Where two agents are in each other's way: lines through places, or single ones.
struct SceneSite {
  std::size_t agent, other;
  std::vector<std::vector<Position>> lines;
  std::int64_t begin;
  std::optional<std::int64_t> end;  ///< Nullopt: for ever.
  std::int64_t lemmas;
};

/// The leader ends its move before the follower gets further than `slack` behind it.
struct ScenePrecedence {
  std::size_t leader;
  std::int64_t leader_begin, leader_end;
  std::size_t follower;
  std::int64_t follower_begin, follower_end;
  std::int64_t slack;
};

/// All that pictures show, in either domain. Times are in timesteps or ticks, and count from `now`:
/// pictures begin at 0, and add `now` where they tell a time.
struct Scene {
  std::int64_t now = 0;  ///< When instance and plan begin.
  bool is_continuous = false;
  bool has_layout = true;  ///< Positions are those of the input.
  bool y_up = false;
  bool has_heights = false;  ///< Bodies are spheres, and places may be above each other.
  double time_unit = 1, length_unit = 1;  ///< One tick and one length unit, as the input counts.
  std::optional<Cells> cells;
  std::vector<Position> places;
  /// By place: where who is there faces, in degrees from the axis of x towards that of y. None: no
  /// agent has headings.
  std::vector<double> headings;
  std::size_t num_vertices = SIZE_MAX;  ///< So many of the places, the first ones, are drawn.
  std::vector<Link> links;
  std::size_t hidden_links = 0;  ///< Links that are left out because there are too many.
  std::vector<continuous::Body> bodies;
  std::vector<SceneAgent> agents;
  std::vector<SceneObstacle> obstacles;
  std::vector<SceneViolation> violations;
  std::vector<Nearness> nearest;  ///< The pairs that come nearest, nearest first.
  std::int64_t sum_of_costs = 0, makespan = 0;
  /// Why no plan is cheaper, if that is known.
  bool has_attribution = false;
  std::int64_t free_bound = 0, lower_bound = 0;
  std::vector<Raise> raises;
  std::vector<SceneSite> sites;  ///< Most lemmas first.
  std::vector<ScenePrecedence> precedences;
};

[[nodiscard]] Scene make_scene(const discrete::Instance& instance, const discrete::Plan& plan);
[[nodiscard]] Scene make_scene(const continuous::Instance& instance, const continuous::Plan& plan,
                               const continuous::GridRoadmap* grid);

/// `poses`: those that the instance is made of.
void add_headings(const continuous::PoseGrid& poses, Scene& scene);

/// Of an instance whose agents have no paths: what they did instead, by agent.
void add_tracks(const std::vector<Track>& tracks, Scene& scene);
/// Of the instance that the scene was made of.
void add_attribution(const discrete::Instance& instance, const Attribution& attribution,
                     Scene& scene);
void add_attribution(const Attribution& attribution, Scene& scene);  ///< On a roadmap.
/// Who follows whom in the plan that the scene was made of; nothing of a plan with violations, or
/// of one with too many moves to look at.
void add_precedences(const discrete::Instance& instance, const discrete::Plan& plan, Scene& scene);
void add_precedences(const continuous::Instance& instance, const continuous::Plan& plan,
                     Scene& scene);

/// Makes absolute times those of a scene.
void count_from_now(Scene& scene);

/// Where the path is at a time. Requires a path.
[[nodiscard]] Position position_at(const Scene& scene, const SceneAgent& agent, double time);

/// Positions for a graph that has none, about one unit apart: neighbours are near each other.
/// Deterministic. O(V + E), and O(V^2) up to some hundred vertices.
[[nodiscard]] std::vector<Position> lay_out(const discrete::Graph& graph);

}  // namespace quadrille::view
