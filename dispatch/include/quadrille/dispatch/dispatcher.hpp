// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "quadrille/continuous/instance.hpp"
#include "quadrille/core/effort.hpp"
#include "quadrille/core/export.hpp"
#include "quadrille/core/limits.hpp"
#include "quadrille/core/result.hpp"
#include "quadrille/dispatch/course.hpp"
#include "quadrille/dispatch/task.hpp"
#include "quadrille/execution/precedences.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::dispatch {

struct Options {
  /// For looking for paths, per call. 0: nobody gets a new path.
  Effort effort = Effort::microseconds(20'000);
  /// How far a robot may go beyond where it was last seen, in ticks of its clock; 0: as far as the
  /// others allow. What a robot that is late has been allowed by then it is taken to have done.
  Ticks reach = 0;
  /// A robot that is later than that is planned for from where it is; 0: that of eight calls.
  Ticks patience = 0;
  /// What is left of the effort makes paths cheaper.
  bool improves = true;
};

/// A fleet whose tasks keep coming, and whose robots are late: says who may go where until when.
///
/// Robots follow courses by their own *clocks*, the times of the plan that they have got to
/// (docs/execution.md), and go no further than they are allowed: so nobody collides, however late
/// anybody is. Whoever is allowed something, and moves that have been begun by then, keep to it:
/// new courses begin after that, agree with the old ones before, and are put into force only if
/// they leave everybody what it was allowed (docs/dispatch.md). The courses there are end with
/// everybody at rest, so there is always something to fall back on.
///
/// Robots with new tasks, the most urgent first, get paths around all others; those without a task
/// that are in the way step aside. Of several that are sent to one place each goes in turn. Effort
/// is counted, so that the same calls give the same answers. For one thread at a time.
class Dispatcher {
 public:
  /// All stand at their starts. Goals and deadlines of agents are for `assign`. Errors:
  /// invalid_instance for all that would not be heeded: a beginning other than 0, moving obstacles,
  /// plans for whole moves, bodies that change, places where nobody may wait, and agents that are
  /// released later, leave, begin in the middle of a move, or overlap at their starts.
  [[nodiscard]] static Result<Dispatcher> make(const continuous::Instance& instance,
                                               const Options& options = {});
  /// The same of robots that need no goals. Errors: those of Instance::make, too.
  [[nodiscard]] static Result<Dispatcher> make(std::shared_ptr<const continuous::Roadmap> roadmap,
                                               std::vector<continuous::Agent> robots,
                                               continuous::Resolution resolution = {},
                                               const Options& options = {});
  ~Dispatcher();
  Dispatcher(Dispatcher&&) noexcept;
  Dispatcher& operator=(Dispatcher&&) noexcept;

  [[nodiscard]] std::size_t num_robots() const noexcept;

  /// What the robot is to do after all that it has been told before. Errors: invalid_instance for a
  /// robot or a vertex that does not exist, or goals none of which it can reach;
  /// out_of_range for times that are negative or too long.
  [[nodiscard]] std::optional<Error> assign(AgentId robot, Task task);
  /// All that it has not been served with is forgotten; it finishes its move, and stands where it
  /// can.
  [[nodiscard]] std::optional<Error> cancel(AgentId robot);
  /// Nobody enters the lane from one vertex to another one any more, but for those that have been
  /// allowed to; until it is opened. Who was to go there finds another way, or waits where it can.
  /// Errors: invalid_instance if there is no such lane, or it is closed (open) already.
  [[nodiscard]] std::optional<Error> close(VertexId from, VertexId to);
  [[nodiscard]] std::optional<Error> open(VertexId from, VertexId to);
  /// How far the robot has got: the time on its course, rounded down. Errors: invalid_instance for
  /// a robot that does not exist; out_of_range if it goes back, or beyond what was allowed.
  [[nodiscard]] std::optional<Error> report(AgentId robot, Ticks clock);

  /// So much more time: new courses, and how far everybody may go until then. `limits` end the
  /// search for paths early, and nothing else. Requires at least one tick.
  News tick(Ticks duration, const Limits& limits = {});

  /// From where the robot is, or before, to the end. Changes with `tick`.
  [[nodiscard]] const Course& course(AgentId robot) const;
  /// On the course, as reported. `tick` may count it anew where it has a new origin, with the
  /// course.
  [[nodiscard]] Ticks clock(AgentId robot) const;
  /// How far it may go on its course.
  [[nodiscard]] Ticks limit(AgentId robot) const;
  /// In which order robots pass the places that they share, on these courses; each move of it ends
  /// where and when a stop of its robot's course begins. Robots that obey it may go further than
  /// their limits, and do not collide. What nobody has to wait for any more is left out.
  [[nodiscard]] const execution::Precedences& order() const noexcept;
  /// Until when everybody was told what to do.
  [[nodiscard]] Ticks now() const noexcept;
  /// Of the robot, those not done yet, the present one included.
  [[nodiscard]] std::size_t num_tasks(AgentId robot) const;

 private:
  class Parts;
  explicit Dispatcher(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace quadrille::dispatch

QUADRILLE_API_END
