// SPDX-License-Identifier: MIT
#include "lazy/path_search.hpp"

namespace quadrille::discrete {

PathSearch::PathSearch(const LazyModel& model, const PathIndex& paths, LimitMonitor& limits)
    : model_(model),
      paths_(paths),
      map_(model.instance().graph().num_vertices()),
      finder_(model.instance().graph().num_vertices(), &limits),
      explainer_(model.instance().graph().num_vertices()) {}

void PathSearch::load(AgentId agent, std::span<const ObstacleId> obstacles) {
  ++num_searches_;
  loaded_.assign(obstacles.begin(), obstacles.end());
  map_.load(model_.obstacles(), loaded_, model_.distances(agent));
}

PathSearch::Cheapest PathSearch::find_cheapest(AgentId agent, std::span<const ObstacleId> obstacles,
                                               Timestep max_cost) {
  load(agent, obstacles);
  const bool is_found =
      finder_.find_cheapest({agent, model_.distances(agent), map_, max_cost, &paths_}, path_);
  return {*this, agent, is_found};
}

std::vector<ObstacleId> PathSearch::blame(AgentId agent, Timestep bound) {
  std::vector<std::size_t> slots;
  explainer_.explain(model_.distances(agent), map_, finder_.first_hits(), bound, slots);
  std::vector<ObstacleId> blamed;
  for (const std::size_t slot : slots) blamed.push_back(loaded_[slot]);
  return blamed;
}

const Path* PathSearch::find_quieter(AgentId agent, std::span<const ObstacleId> obstacles,
                                     Timestep max_cost) {
  const int now = paths_.num_collisions(agent);
  if (now == 0) return nullptr;
  load(agent, obstacles);
  // On open maps a search without success would look at everything within the cap.
  constexpr std::int64_t kStatesPerStep = 10;
  const auto max_effort = kStatesPerStep * static_cast<std::int64_t>(paths_.path(agent).size());
  const bool is_found = finder_.find_quietest(
      {agent, model_.distances(agent), map_, max_cost, &paths_, max_effort}, now, path_);
  return is_found ? &path_ : nullptr;
}

}  // namespace quadrille::discrete
