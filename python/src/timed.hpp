// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/pybind11.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "errors.hpp"
#include "quadrille/continuous/grid.hpp"
#include "quadrille/continuous/in_words.hpp"
#include "quadrille/continuous/instance.hpp"

namespace quadrille::python {

/// Sizes of a length unit and of a tick, as Python has them.
using Sizes = std::pair<double, double>;
inline continuous::Resolution resolution_of(const Sizes& sizes) {
  return {sizes.first, sizes.second};
}

/// `name`: for messages.
inline VertexId vertex_of(std::int64_t vertex, std::size_t size, const std::string& name) {
  if (vertex < 0 || vertex >= static_cast<std::int64_t>(size))
    refuse(name + ": there is no vertex " + std::to_string(vertex) + " among " +
           std::to_string(size));
  return VertexId(static_cast<std::size_t>(vertex));
}

/// A set of groups as the bits of a number.
continuous::Groups groups_of(std::uint64_t bits);

/// What an instance is made of.
struct TimedParts {
  std::shared_ptr<const continuous::Roadmap> roadmap;
  std::vector<continuous::Agent> agents;
  continuous::Resolution resolution;
  std::vector<continuous::MovingObstacle> obstacles;
  continuous::Ticks now;
};

/// An instance in continuous time, and the grid that its roadmap comes from, if any: logs name its
/// cells. Where it can be seen that there is no plan there is no instance, but the error that says
/// why; and its parts, unless they are in a file.
class TimedInstance {
 public:
  explicit TimedInstance(continuous::Instance instance,
                         std::optional<continuous::GridRoadmap> grid = {})
      : instance_(std::move(instance)), grid_(std::move(grid)) {}
  TimedInstance(Error no_plan, std::optional<TimedParts> parts)
      : no_plan_(std::move(no_plan)), parts_(std::move(parts)) {}

  /// Why there is no plan, if that was seen.
  [[nodiscard]] const std::optional<Error>& no_plan() const noexcept { return no_plan_; }
  /// Raises `no_plan`.
  [[nodiscard]] const continuous::Instance& instance() const {
    if (no_plan_) raise(*no_plan_);
    return *instance_;
  }
  /// Whether, without an instance, its parts are known.
  [[nodiscard]] bool has_parts() const noexcept { return parts_.has_value(); }
  // Raise `no_plan` where they are not known.
  [[nodiscard]] std::shared_ptr<const continuous::Roadmap> roadmap() const {
    return parts_ ? parts_->roadmap : instance().shared_roadmap();
  }
  [[nodiscard]] std::span<const continuous::Agent> agents() const {
    if (parts_) return parts_->agents;
    return {instance().agents().begin(), instance().agents().end()};
  }
  [[nodiscard]] const continuous::Resolution& resolution() const {
    return parts_ ? parts_->resolution : instance().resolution();
  }
  [[nodiscard]] const std::vector<continuous::MovingObstacle>& obstacles() const {
    return parts_ ? parts_->obstacles : instance().obstacles();
  }
  [[nodiscard]] continuous::Ticks now() const { return parts_ ? parts_->now : instance().now(); }
  [[nodiscard]] const continuous::GridRoadmap* grid_or_null() const {
    return grid_ ? &*grid_ : nullptr;
  }

 private:
  std::optional<Error> no_plan_;
  std::optional<continuous::Instance> instance_;  // if there is no such error
  std::optional<continuous::GridRoadmap> grid_;
  std::optional<TimedParts> parts_;  // of one that cannot have a plan
};

/// Starts and goals are vertices, the goals of the first agent, then those of the next one;
/// `num_goals`: how many each has; a body is a radius, or float64[k, 2], the corners of a polygon.
/// `rules`: what rules_of gives, "poses": a PoseMap whose roadmap it is, or None, `now`: when all
/// begins, and `under_way`: [(agent, from, to, fraction, begun or None, may_wait)], instead of
/// starts. `called`: "agent" and "vertex", functions from a number to what it is called in
/// messages.
TimedInstance instance_of(const std::shared_ptr<continuous::Roadmap>& roadmap, const Sizes& sizes,
                          const Ints& starts, const Ints& goals,
                          const std::vector<std::size_t>& num_goals, const py::list& bodies,
                          const Doubles& speeds, const py::dict& rules, const py::dict& called);
/// The agents alone, each at a vertex: `rules` has no obstacles, and nobody is under way.
std::vector<continuous::Agent> agents_of(const continuous::Roadmap& roadmap, const Sizes& sizes,
                                         const Ints& starts, const Ints& goals,
                                         const std::vector<std::size_t>& num_goals,
                                         const py::list& bodies, const Doubles& speeds,
                                         const py::dict& rules, const py::dict& called);
/// `called`: as above; times are in the units of `resolution`.
continuous::Words words_of(const py::dict& called, const continuous::Resolution& resolution);
/// Obstacles, of the rules.
std::vector<continuous::MovingObstacle> obstacles_of(const py::list& given, const Sizes& sizes);
/// A moment, to the nearest tick; raises InputError for one that is out of range, or no number.
/// `who`: for messages.
continuous::Ticks moment_of(double value, const Sizes& sizes, const std::string& who);
/// How many whole ticks of its move lie behind an agent: (fraction, begun or None).
continuous::Ticks ticks_behind(double fraction, const std::optional<double>& begun,
                               continuous::Ticks now, continuous::Ticks whole, const Sizes& sizes,
                               const std::string& who);
// And back: int32[n], a list as above, float64[n].
py::array starts_of(const TimedInstance& self);
py::array goals_of(const TimedInstance& self);  ///< Requires that each agent has one only.
py::list goal_sets_of(const TimedInstance& self);
bool has_goal_sets(const TimedInstance& self);
py::list bodies_of(const TimedInstance& self);
py::array speeds_of(const TimedInstance& self);
/// (relative error, agent, from, to, planned and exact duration) of the largest error; or None.
py::object duration_error_of(const TimedInstance& self);
/// `groups`: int64[n]; `releases`, `deadlines`: float64[n], NaN for none; `leaves`, `under_way`:
/// bool[n]; `obstacles`: [(body, float64[k, 4], leaves)], x, y, arrival and departure of each stop;
/// `moves`: [(agent, from, to, fraction, may_wait)] of those that begin in the middle of one.
py::dict rules_of(const TimedInstance& self);

}  // namespace quadrille::python
