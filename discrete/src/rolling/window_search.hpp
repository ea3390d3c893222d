// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "quadrille/core/goals.hpp"
#include "quadrille/core/random.hpp"
#include "quadrille/discrete/goal_distances.hpp"
#include "quadrille/discrete/graph.hpp"
#include "reservations/tie_breaker.hpp"
#include "rolling/window.hpp"

namespace quadrille::discrete {

/// What an agent is about, within a window. It stays where it is until `hold`. The first vertex of
/// its goals that it comes to is where it has arrived, and it stays there for `service` timesteps.
struct Errand {
  const Goals* goals = nullptr;  ///< Null: it has arrived, or there is nothing to do.
  Timestep service = 0, hold = 0;
};

/// Cheapest paths of single agents through a window, among those that are in it: A* over vertices
/// and timesteps. A path costs the timestep of its arrival, or, if it does not arrive, the length
/// of the window and the distance from its end to the goal. After the arrival all are equal, but
/// staying comes first.
class WindowSearch {
 public:
  /// All outlive this object.
  WindowSearch(const Graph& graph, const Window& window, Random& random);

  struct Found {
    Path path;
    Timestep cost = 0;
    std::optional<Timestep> arrival;
  };
  /// Nothing: there is no path, all cost more than `most`, or finding one takes more than `effort`.
  /// Requires that the agent is not in the window. `distances`: to the goals.
  [[nodiscard]] const Found* find(VertexId start, const Errand& errand,
                                  const GoalDistances::Row& distances, Timestep most,
                                  std::int64_t effort);
  /// States expanded by all calls.
  [[nodiscard]] std::int64_t effort() const noexcept { return effort_; }

 private:
  static constexpr std::uint32_t kNone = UINT32_MAX;
  struct Label {
    VertexId vertex;
    Timestep time;
    Timestep arrival;  // -1: not yet.
    std::uint32_t parent;
  };

  void begin();
  void reach(VertexId vertex, Timestep time, Timestep arrival, std::uint32_t parent);
  void expand(std::uint32_t from);
  const Found* finish(std::uint32_t last, Timestep cost);
  [[nodiscard]] std::size_t state(const Label& label) const {
    const auto at =
        static_cast<std::size_t>(label.time) * graph_.num_vertices() + label.vertex.index();
    return 2 * at + (label.arrival < 0 ? 0 : 1);
  }

  const Graph& graph_;
  const Window& window_;
  TieBreaker ties_;
  std::int64_t effort_ = 0;

  // Of the search at hand.
  Errand errand_;
  GoalDistances::Row distances_;
  Timestep least_ = 0, most_ = 0;  // Of costs.
  std::uint32_t search_ = 0;
  std::vector<std::uint32_t> seen_;  // By state: in which search.
  std::vector<Label> labels_;
  std::vector<std::vector<std::uint32_t>> buckets_;  // By estimate, from `least_` on.
  Found found_;
};

}  // namespace quadrille::discrete
