// SPDX-License-Identifier: MIT
#include "quadrille/dispatch/task_feed.hpp"

#include <utility>

#include "quadrille/core/contract.hpp"

namespace quadrille::dispatch {

TaskFeed::TaskFeed(const SimulationOptions& options, std::size_t num_robots,
                   std::size_t num_vertices, Assign assign, Count num_tasks, Ticks now)
    : next_tasks_(options.next_tasks),
      is_random_(options.has_random_tasks),
      service_(options.service),
      num_vertices_(num_vertices),
      assign_(std::move(assign)),
      num_tasks_(std::move(num_tasks)),
      since_(num_robots) {
  for (std::size_t i = 0; i < num_robots; ++i) since_[i].resize(num_tasks_(AgentId(i)), now);
}

void TaskFeed::feed(Ticks now, Random& random) {
  for (std::size_t i = 0; i < since_.size(); ++i) {
    if (next_tasks_)
      ask(AgentId(i), now);
    else if (is_random_)
      draw(AgentId(i), now, random);
  }
}

void TaskFeed::ask(AgentId robot, Ticks now) {
  if (num_tasks_(robot) > 0) return;
  for (const Task& task : next_tasks_(robot)) {
    QUADRILLE_REQUIRE(!assign_(robot, task), "a task that can be done");
    since_[robot.index()].push_back(now);
  }
}

void TaskFeed::draw(AgentId robot, Ticks now, Random& random) {
  // A vertex that it cannot reach is refused, and another one drawn.
  for (int tries = 0; tries < 100 && num_tasks_(robot) == 0; ++tries) {
    const VertexId goal(static_cast<std::size_t>(random.below(num_vertices_)));
    if (!assign_(robot, {goal, service_, {}})) since_[robot.index()].push_back(now);
  }
}

void TaskFeed::finish(std::span<const AgentId> served, Ticks now) {
  for (const AgentId robot : served) {
    std::vector<Ticks>& since = since_[robot.index()];
    service_times_.push_back(now - since.front());
    since.erase(since.begin());
  }
}

}  // namespace quadrille::dispatch
