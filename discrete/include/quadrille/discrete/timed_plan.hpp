// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "quadrille/core/export.hpp"
#include "quadrille/core/result.hpp"
#include "quadrille/discrete/instance.hpp"
#include "quadrille/discrete/plan.hpp"

// Plans as those who carry them out ask about them; quadrille/fleet/timed_plan.hpp has the same
// names for robots in continuous time. Times are in timesteps, between which agents move steadily,
// and absolute: a plan begins at Plan::now. Costs count from there.

QUADRILLE_API_BEGIN

namespace quadrille::discrete {

/// On the edge from one vertex to another, which differ only on the way: `share` of it is done.
struct Position {
  VertexId from;
  VertexId to;
  double share = 0;  ///< In [0, 1); 0 when the two are the same.
  friend bool operator==(const Position&, const Position&) = default;
};

/// Cells, and what lies between them; the centre of cell (x, y) is at (x, y).
struct GridPoint {
  double x = 0;
  double y = 0;
  friend bool operator==(const GridPoint&, const GridPoint&) = default;
};
/// nullopt if the graph is no grid.
[[nodiscard]] std::optional<GridPoint> grid_point(const Graph& graph, const Position& position);

/// A stay at a vertex, from `arrive` to `depart`; equal where the agent passes through.
struct Stop {
  VertexId vertex;
  Timestep arrive = 0;
  Timestep depart = 0;
  friend bool operator==(const Stop&, const Stop&) = default;
};

/// A stay that takes time, before the agent has arrived at its goal for good.
struct Wait {
  VertexId vertex;
  Timestep from = 0;
  Timestep until = 0;
  friend bool operator==(const Wait&, const Wait&) = default;
};

struct Sample {
  double time = 0;
  Position position;
  friend bool operator==(const Sample&, const Sample&) = default;
};

/// What one agent does.
class TimedPath {
 public:
  /// At least one; the last one is the goal, for ever.
  [[nodiscard]] const std::vector<Stop>& stops() const noexcept { return stops_; }

  /// Where the agent is: at its start before the plan begins, at its goal after the end.
  /// O(log stops).
  [[nodiscard]] Position at(double time) const;
  /// At the plan's beginning and 1/rate, 2/rate, ... later, up to the first such moment at which
  /// the agent has arrived for good. `rate`: samples per timestep. Requires a positive one.
  [[nodiscard]] std::vector<Sample> samples(double rate) const;
  /// The same up to the first such moment not before `until`, wherever the agent is then.
  [[nodiscard]] std::vector<Sample> samples(double rate, double until) const;

  [[nodiscard]] std::vector<Wait> waits() const;
  /// Timesteps from the plan's beginning until it arrives at its goal for good.
  [[nodiscard]] Cost cost() const noexcept {
    return Cost{stops_.back().arrive} - stops_.front().arrive;
  }
  /// What that would be without the other agents.
  [[nodiscard]] Cost free_cost() const noexcept { return free_cost_; }
  /// The difference: waits and detours.
  [[nodiscard]] Cost delay() const noexcept { return cost() - free_cost_; }

 private:
  friend class TimedPlan;
  TimedPath() = default;
  std::vector<Stop> stops_;
  Cost free_cost_ = 0;
};

/// What all agents do. A plan that has been verified. Cheap to copy.
class TimedPlan {
 public:
  /// Errors: invalid_plan with the first violation that `verify` finds. O(V + E) per goal.
  [[nodiscard]] static Result<TimedPlan> make(const Instance& instance, const Plan& plan);

  [[nodiscard]] std::size_t num_agents() const noexcept { return paths_->size(); }
  [[nodiscard]] IdRange<AgentId> agent_ids() const { return IdRange<AgentId>(num_agents()); }
  /// Requires an agent of the plan.
  [[nodiscard]] const TimedPath& operator[](AgentId agent) const { return (*paths_)[agent]; }

  [[nodiscard]] Cost sum_of_costs() const noexcept { return sum_of_costs_; }
  [[nodiscard]] Cost makespan() const noexcept { return makespan_; }
  /// The sum of the delays.
  [[nodiscard]] Cost delay() const noexcept { return delay_; }

 private:
  TimedPlan() = default;
  std::shared_ptr<const IdVector<AgentId, TimedPath>> paths_;
  Cost sum_of_costs_ = 0, makespan_ = 0, delay_ = 0;
};

}  // namespace quadrille::discrete

QUADRILLE_API_END
