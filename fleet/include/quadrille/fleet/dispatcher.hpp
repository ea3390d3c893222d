// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "quadrille/core/export.hpp"
#include "quadrille/core/result.hpp"
#include "quadrille/dispatch/dispatcher.hpp"
#include "quadrille/fleet/fleet.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::fleet {

/// As dispatch::Options, where more is said.
struct DispatchOptions {
  /// For looking for paths, per call: nominal, counted in steps and not by clocks. At 0 s nobody
  /// gets a new path.
  Seconds effort = Seconds(0.02);
  Seconds reach = {};     ///< How far a robot may go beyond where it was last seen; 0 s: any.
  Seconds patience = {};  ///< Who is later is planned for from where it is; 0 s: eight calls.
  bool improves = true;   ///< What is left of the effort makes paths cheaper.
};

/// What goes with a task.
struct TaskSpec {
  Seconds service = {};                  ///< How long it takes there.
  std::optional<Seconds> deadline = {};  ///< By when it should be there: what is urgent goes first.
};

/// What became of a call of Dispatcher::tick.
struct Orders {
  std::vector<AgentId> served;  ///< Whose task is done.
  std::size_t num_waiting = 0;  ///< That have a task, and no path to it yet.
  bool has_new_plan = false;
  Seconds cost;         ///< Until all that have a path to their goal arrive there, in sum.
  Seconds lower_bound;  ///< What that takes at least.
  /// How much dearer than at least that is; 0 if nothing is to be done.
  [[nodiscard]] double gap_percent() const {
    return lower_bound > Seconds(0) ? 100 * ((cost - lower_bound) / lower_bound) : 0;
  }
};

/// A stop on a robot's course: at `vertex`, or within the lane from there to another vertex.
struct CourseStop {
  VertexId vertex;
  std::optional<VertexId> to;  ///< On the lane to this vertex,
  double fraction = 0;         ///< with so much of it behind.
  Seconds arrive, depart;
  friend bool operator==(const CourseStop&, const CourseStop&) = default;
};

/// A live fleet: tasks keep coming, robots are late, and nobody collides. Says who may go where
/// until when; see dispatch::Dispatcher, and docs/dispatch.md.
class Dispatcher {
 public:
  /// The robots stand at their starts, at 0 s on the clock of courses. Those that have goals have
  /// them as their first task, by their deadline; else they need none. Lanes that are closed are.
  /// Errors: those of Fleet::instance; invalid_instance for all that would not be heeded:
  /// dispatch::Dispatcher::make.
  [[nodiscard]] static Result<Dispatcher> make(const Fleet& fleet, DispatchOptions options = {});

  /// Any one of these goals, after all that the robot has been told before; several tasks are
  /// served in their order. Several robots that are sent to one place get it in turn. Errors:
  /// invalid_instance for a robot or vertices that there are not, and goals that it cannot reach;
  /// out_of_range for times that are negative or too long.
  [[nodiscard]] std::optional<Error> assign(AgentId robot, std::vector<VertexId> goals,
                                            TaskSpec spec = {});
  [[nodiscard]] std::optional<Error> assign(AgentId robot, VertexId goal, TaskSpec spec = {}) {
    return assign(robot, std::vector<VertexId>{goal}, spec);
  }
  /// Of what it has been told, nothing is left to do.
  [[nodiscard]] std::optional<Error> cancel(AgentId robot);
  /// Nobody enters the lane from one vertex to another one any more, but for robots that have been
  /// allowed to, until it is opened. Errors: invalid_instance if there is no such lane, or it is
  /// closed (open) already.
  [[nodiscard]] std::optional<Error> close(VertexId from, VertexId to);
  [[nodiscard]] std::optional<Error> open(VertexId from, VertexId to);
  /// How far it has got: the time on its course, which is rounded down. Errors: invalid_instance
  /// for a robot that there is not; out_of_range if it goes back, or beyond `limit`.
  [[nodiscard]] std::optional<Error> report(AgentId robot, Seconds clock);
  /// So much more time: courses, and how far everybody may go until then. Rounded up to whole
  /// steps. `wall`: a limit of the time for it. Requires a duration that is positive.
  Orders tick(Seconds duration, std::optional<Seconds> wall = {});

  /// All of these require a robot of the fleet. The clock as reported, or counted anew by `tick`.
  [[nodiscard]] Seconds clock(AgentId robot) const;
  /// How far it may go on its course, on the same clock.
  [[nodiscard]] Seconds limit(AgentId robot) const;
  /// From where it is, or before, to the end.
  [[nodiscard]] std::vector<CourseStop> course(AgentId robot) const;
  /// Where one is that has got so far.
  [[nodiscard]] Point at(AgentId robot, Seconds clock) const;
  /// Of those not done yet.
  [[nodiscard]] std::size_t num_tasks(AgentId robot) const;
  /// Until when everybody has been told what to do.
  [[nodiscard]] Seconds now() const;

 private:
  Dispatcher(Roadmap roadmap, std::vector<std::string> names, dispatch::Dispatcher dispatcher)
      : roadmap_(std::move(roadmap)),
        names_(std::move(names)),
        dispatcher_(std::move(dispatcher)) {}
  [[nodiscard]] Seconds seconds(continuous::Ticks ticks) const;

  Roadmap roadmap_;
  std::vector<std::string> names_;  // by robot
  dispatch::Dispatcher dispatcher_;
};

}  // namespace quadrille::fleet

QUADRILLE_API_END
