// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "quadrille/core/effort.hpp"
#include "quadrille/core/export.hpp"
#include "quadrille/core/limits.hpp"
#include "quadrille/core/result.hpp"
#include "quadrille/discrete/graph.hpp"
#include "quadrille/discrete/plan.hpp"
#include "quadrille/dispatch/task.hpp"
#include "quadrille/execution/precedences.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::dispatch {

struct GridOptions {
  /// For better paths, per call. 0: the next timestep of each window by PIBT, and no more.
  Effort effort = Effort::microseconds(20'000);
  /// Timesteps that are planned ahead, at least 1.
  Timestep window = 20;
  std::uint64_t seed = 0;
  /// Whether what is left of the effort, once everybody with a task has a path, makes paths
  /// cheaper.
  bool improves = true;
};

/// A fleet on a grid or graph whose tasks keep coming, and whose robots are held up: says who goes
/// where in the next timestep. All take it at the same time, and nobody ever collides, however many
/// are held up: who is behind one that is waits for it (docs/dispatch.md). There is a next step
/// whatever the effort, and thousands of robots are no more than a matter of milliseconds.
///
/// Times are timesteps. Who has no task gets out of the way. Effort is counted, so that the same
/// calls give the same answers. For one thread at a time.
class GridDispatcher {
 public:
  /// At these vertices, at time 0. Errors: invalid_instance for vertices that do not exist or are
  /// there twice, and graphs with one-way edges; out_of_range for a window of no timestep.
  [[nodiscard]] static Result<GridDispatcher> make(std::shared_ptr<const discrete::Graph> graph,
                                                   std::vector<VertexId> places,
                                                   const GridOptions& options = {});
  ~GridDispatcher();
  GridDispatcher(GridDispatcher&&) noexcept;
  GridDispatcher& operator=(GridDispatcher&&) noexcept;

  [[nodiscard]] std::size_t num_robots() const noexcept;

  /// What the robot is to do after all that it has been told before. Errors: invalid_instance for a
  /// robot or a vertex that does not exist, or goals none of which it can reach; out_of_range for
  /// times that are negative or too long. O(graph) if it has nothing else to do.
  [[nodiscard]] std::optional<Error> assign(AgentId robot, const Task& task);
  /// All that it has not been served with is forgotten.
  [[nodiscard]] std::optional<Error> cancel(AgentId robot);

  /// Nobody takes the edge between two vertices any more, in either direction, until it is opened;
  /// the next call makes all paths anew. Whose goals are behind closed edges wait. Errors:
  /// invalid_instance if there is no such edge, or it is closed (open) already.
  [[nodiscard]] std::optional<Error> close(VertexId a, VertexId b);
  [[nodiscard]] std::optional<Error> open(VertexId a, VertexId b);

  /// A timestep. Those that are held up in it stay where they are. In the news, costs are timesteps
  /// of those that arrive within the window. `limits` end the search for better paths early, and
  /// nothing else. Requires robots that exist.
  News tick(std::span<const AgentId> held = {}, const Limits& limits = {});

  [[nodiscard]] VertexId place(AgentId robot) const;
  /// Where it is now, and after each timestep to come, as planned.
  [[nodiscard]] discrete::Path path(AgentId robot) const;
  /// In which order robots come to vertices, as planned, from now on. Whoever obeys it collides
  /// with nobody, however late anybody is.
  [[nodiscard]] execution::Precedences order() const;
  /// Timesteps that are over.
  [[nodiscard]] Timestep now() const noexcept;
  /// Of the robot, those not done yet, the present one included.
  [[nodiscard]] std::size_t num_tasks(AgentId robot) const;

 private:
  class Parts;
  explicit GridDispatcher(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace quadrille::dispatch

QUADRILLE_API_END
