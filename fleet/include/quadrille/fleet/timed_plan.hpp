// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "quadrille/continuous/plan.hpp"
#include "quadrille/core/export.hpp"
#include "quadrille/core/ids.hpp"
#include "quadrille/core/outcome.hpp"
#include "quadrille/core/result.hpp"
#include "quadrille/fleet/fleet.hpp"
#include "quadrille/fleet/verify.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::fleet {

/// A stay at a vertex, from `arrive` to `depart`; equal where the robot passes through. The first
/// one of a robot that begins in the middle of a move is there, see Fleet::place_name.
struct Stop {
  VertexId vertex;
  Point place;
  Seconds arrive;
  Seconds depart;
  friend bool operator==(const Stop&, const Stop&) = default;
};

/// A stay that takes time, before the robot has arrived at its goal for good.
struct Wait {
  VertexId vertex;
  Seconds from;
  Seconds until;
  friend bool operator==(const Wait&, const Wait&) = default;
};

struct Velocity {
  MetresPerSecond x;
  MetresPerSecond y;
  MetresPerSecond z = {};
  friend constexpr bool operator==(const Velocity&, const Velocity&) = default;
};

struct Sample {
  Seconds time;
  Point position;
  Velocity velocity;
  friend constexpr bool operator==(const Sample&, const Sample&) = default;
};

/// What one robot does. Its times and places are those of the plan in whole units, exactly, as far
/// as doubles hold them; what lies between them is computed in doubles.
class TimedPath {
 public:
  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  /// At least one; the last one is the goal, for ever.
  [[nodiscard]] const std::vector<Stop>& stops() const noexcept { return stops_; }

  /// The move in the middle of which it begins: as rounded, in whole steps of time. nullopt if it
  /// begins at a vertex.
  [[nodiscard]] const std::optional<UnderWay>& under_way() const noexcept { return under_way_; }

  /// Where the robot is: at its start before the plan begins, at its goal after the end.
  /// O(log stops).
  [[nodiscard]] Point at(Seconds time) const;
  /// How fast it goes in which direction; at the moment in which that changes, what comes after it.
  [[nodiscard]] Velocity velocity(Seconds time) const;
  /// When the plan begins and 1/rate, 2/rate, ... later, up to the first such moment at which the
  /// robot has arrived for good. Requires a positive rate. Linear in stops and samples.
  [[nodiscard]] std::vector<Sample> samples(Hertz rate) const;
  /// The same up to the first such moment not before `until`, wherever the robot is then.
  [[nodiscard]] std::vector<Sample> samples(Hertz rate, Seconds until) const;

  [[nodiscard]] std::vector<Wait> waits() const;
  /// How long it takes, from the plan's beginning, until it arrives at its goal for good.
  [[nodiscard]] Seconds cost() const noexcept { return cost_; }
  /// What that would be without the other robots.
  [[nodiscard]] Seconds free_cost() const noexcept { return free_cost_; }
  /// The difference: waits and detours.
  [[nodiscard]] Seconds delay() const noexcept { return delay_; }

 private:
  friend class TimedPlan;
  TimedPath() = default;
  [[nodiscard]] std::size_t stop_at(Seconds time) const;
  [[nodiscard]] Sample sample(std::size_t stop, Seconds time) const;

  std::string name_;
  std::vector<Stop> stops_;
  std::optional<UnderWay> under_way_;
  Seconds cost_, free_cost_, delay_;
};

/// What all robots do. A plan that has been verified. Cheap to copy.
class TimedPlan {
 public:
  /// `plan`: in whole units, of `fleet.instance()`. Errors: those of `instance`; invalid_plan with
  /// the first violation that `verify` finds.
  [[nodiscard]] static Result<TimedPlan> make(const Fleet& fleet, const continuous::Plan& plan);

  [[nodiscard]] std::size_t num_robots() const noexcept { return state_->paths.size(); }
  [[nodiscard]] IdRange<AgentId> robot_ids() const { return IdRange<AgentId>(num_robots()); }
  /// A `Robot` will do. Requires a robot of the plan.
  [[nodiscard]] const TimedPath& operator[](AgentId robot) const { return state_->paths[robot]; }

  [[nodiscard]] Seconds sum_of_costs() const noexcept { return state_->sum_of_costs; }
  [[nodiscard]] Seconds makespan() const noexcept { return state_->makespan; }
  /// The sum of the delays.
  [[nodiscard]] Seconds delay() const noexcept { return state_->delay; }
  /// The two robots that come closest to each other, and when. nullopt with fewer than two.
  [[nodiscard]] const std::optional<Clearance>& least_clearance() const noexcept {
    return state_->least_clearance;
  }
  /// One line per robot, and one for all.
  [[nodiscard]] std::string summary() const;

  /// The same in whole units, and what it is a plan of; for the layers below.
  [[nodiscard]] const continuous::Plan& in_units() const noexcept { return state_->plan; }
  [[nodiscard]] const continuous::Instance& instance() const noexcept { return state_->instance; }

 private:
  struct State {
    continuous::Instance instance;
    continuous::Plan plan;
    IdVector<AgentId, TimedPath> paths;
    Seconds sum_of_costs, makespan, delay;
    std::optional<Clearance> least_clearance;
  };
  explicit TimedPlan(std::shared_ptr<const State> state) : state_(std::move(state)) {}
  std::shared_ptr<const State> state_;
};

/// What another fleet has to keep clear of, when the robot does what the plan says. A polygon that
/// turns with its robot becomes the disc around all its headings. Nullopt for one
/// that leaves where it begins, and so is never anywhere. `fleet`: whose plan it is. Requires a
/// robot of the plan.
[[nodiscard]] std::optional<MovingObstacle> as_obstacle(const Fleet& fleet, const TimedPlan& plan,
                                                        AgentId robot);

}  // namespace quadrille::fleet

QUADRILLE_API_END
