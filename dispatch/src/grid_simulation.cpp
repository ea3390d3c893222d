// SPDX-License-Identifier: MIT
#include "quadrille/dispatch/grid_simulation.hpp"

#include <algorithm>
#include <utility>

#include "quadrille/core/contract.hpp"

namespace quadrille::dispatch {

GridSimulation::GridSimulation(GridDispatcher& dispatcher,
                               std::shared_ptr<const discrete::Graph> graph,
                               const GridSimulationOptions& options)
    : dispatcher_(dispatcher),
      graph_(std::move(graph)),
      options_(options),
      random_(options.seed),
      paused_until_(dispatcher.num_robots(), 0),
      still_since_(dispatcher.num_robots(), dispatcher.now()),
      since_(dispatcher.num_robots()) {
  QUADRILLE_REQUIRE(options.longest_pause >= 1, "at least one timestep");
  for (std::size_t i = 0; i < since_.size(); ++i)
    since_[i].resize(dispatcher.num_tasks(AgentId(i)), dispatcher.now());
}

void GridSimulation::draw_tasks() {
  const Ticks service(std::int64_t{options_.service});
  for (std::size_t i = 0; i < since_.size(); ++i) {
    // A vertex that it cannot reach is refused, and another one drawn.
    for (int tries = 0; tries < 100 && dispatcher_.num_tasks(AgentId(i)) == 0; ++tries) {
      const VertexId goal(static_cast<std::size_t>(random_.below(graph_->num_vertices())));
      if (dispatcher_.assign(AgentId(i), Task{goal, service, {}})) continue;
      since_[i].push_back(dispatcher_.now());
    }
  }
}

void GridSimulation::draw_pauses() {
  held_.clear();
  for (std::size_t i = 0; i < since_.size(); ++i) {
    const Timestep now = dispatcher_.now();
    if (now >= paused_until_[i] && random_.chance(options_.pause_chance))
      paused_until_[i] =
          now + 1 +
          static_cast<Timestep>(random_.below(static_cast<std::uint64_t>(options_.longest_pause)));
    if (now < paused_until_[i]) held_.emplace_back(i);
  }
}

News GridSimulation::step(const Limits& limits) {
  if (options_.has_random_tasks) draw_tasks();
  draw_pauses();
  std::vector<VertexId> before;
  for (std::size_t i = 0; i < since_.size(); ++i) before.push_back(dispatcher_.place(AgentId(i)));
  const Timestep now = dispatcher_.now();
  News news = dispatcher_.tick(held_, limits);
  for (const AgentId robot : news.served) {
    std::vector<Timestep>& since = since_[robot.index()];
    service_times_.push_back(now - since.front());
    since.erase(since.begin());
    still_since_[robot.index()] = dispatcher_.now();
  }
  look(before);
  return news;
}

void GridSimulation::look(const std::vector<VertexId>& before) {
  constexpr std::size_t kNobody = SIZE_MAX;
  std::vector<std::size_t> who(graph_->num_vertices(), kNobody), who_was(who);
  for (std::size_t i = 0; i < before.size(); ++i) who_was[before[i].index()] = i;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const VertexId here = dispatcher_.place(AgentId(i));
    if (who[here.index()] != kNobody) ++num_contacts_;
    who[here.index()] = i;
    if (here == before[i]) continue;
    still_since_[i] = dispatcher_.now();
    if (!graph_->adjacent(before[i], here)) ++num_contacts_;
    const std::size_t other = who_was[here.index()];
    if (other != kNobody && dispatcher_.place(AgentId(other)) == before[i]) ++num_contacts_;
  }
  for (const AgentId robot : held_) {
    if (dispatcher_.place(robot) != before[robot.index()]) ++num_contacts_;
    still_since_[robot.index()] = dispatcher_.now();
  }
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (dispatcher_.num_tasks(AgentId(i)) == 0) still_since_[i] = dispatcher_.now();
    longest_stay_ = std::max(longest_stay_, dispatcher_.now() - still_since_[i]);
  }
}

}  // namespace quadrille::dispatch
