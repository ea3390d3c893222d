// SPDX-License-Identifier: MIT
#include "quadrille/dispatch/grid_simulation.hpp"

#include <algorithm>
#include <utility>

#include "quadrille/core/contract.hpp"

namespace quadrille::dispatch {

GridSimulation::GridSimulation(GridDispatcher& dispatcher,
                               std::shared_ptr<const discrete::Graph> graph,
                               const SimulationOptions& options)
    : dispatcher_(dispatcher),
      graph_(std::move(graph)),
      options_(options),
      random_(options.seed),
      feed_(
          options, dispatcher.num_robots(), graph_->num_vertices(),
          [&dispatcher](AgentId robot, const Task& task) { return dispatcher.assign(robot, task); },
          [&dispatcher](AgentId robot) { return dispatcher.num_tasks(robot); }, time()),
      paused_until_(dispatcher.num_robots(), 0),
      still_since_(dispatcher.num_robots(), dispatcher.now()) {
  QUADRILLE_REQUIRE(options.step == 1 && options.longest_pause >= 1, "whole timesteps");
  show();
}

void GridSimulation::draw_pauses() {
  held_.clear();
  for (std::size_t i = 0; i < dispatcher_.num_robots(); ++i) {
    const Timestep now = dispatcher_.now();
    if (now >= paused_until_[i] && random_.chance(options_.pause_chance))
      paused_until_[i] =
          now + 1 + static_cast<Timestep>(drawn(random_, options_.longest_pause).value());
    if (now < paused_until_[i]) held_.emplace_back(i);
  }
}

News GridSimulation::step(const Limits& limits) {
  feed_.feed(time(), random_);
  draw_pauses();
  std::vector<VertexId> before;
  for (std::size_t i = 0; i < dispatcher_.num_robots(); ++i)
    before.push_back(dispatcher_.place(AgentId(i)));
  const Ticks now = time();
  News news = dispatcher_.tick(held_, limits);
  feed_.finish(news.served, now);
  for (const AgentId robot : news.served) still_since_[robot.index()] = dispatcher_.now();
  look(before);
  show();
  return news;
}

void GridSimulation::show() const {
  if (!options_.watch || !graph_->layout()) return;
  std::vector<Place> places;
  for (std::size_t i = 0; i < dispatcher_.num_robots(); ++i) {
    const discrete::Cell cell = graph_->layout()->cell_of(dispatcher_.place(AgentId(i)));
    places.push_back({static_cast<double>(cell.x), static_cast<double>(cell.y), 0});
  }
  options_.watch(time(), places);
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
