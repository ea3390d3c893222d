// SPDX-License-Identifier: MIT
#include "theory/path_search.hpp"

namespace quadrille::continuous {

PathSearch::PathSearch(Model& model)
    : model_(model),
      finder_(model.instance(), &model.limits()),
      bans_(model.instance().roadmap()),
      explainer_(finder_) {}

PathSearch::Cheapest PathSearch::find(AgentId agent, std::span<const ObstacleId> obstacles,
                                      Cost bound) {
  ++num_searches_;
  loaded_.assign(obstacles.begin(), obstacles.end());
  bans_.clear(model_.standing_bans(agent));
  for (const ObstacleId id : obstacles) bans_.add(model_.obstacles()[id].bans);
  const auto arrival = finder_.find(model_.task(agent), bans_, as_ticks(bound), &path_);
  return {*this, agent, arrival.has_value()};
}

std::vector<ObstacleId> PathSearch::blame(AgentId agent, Cost bound) {
  std::vector<std::size_t> slots;
  explainer_.explain(model_.task(agent), bans_, as_ticks(bound), slots);
  std::vector<ObstacleId> blamed;
  for (const std::size_t slot : slots) blamed.push_back(loaded_[slot]);
  return blamed;
}

}  // namespace quadrille::continuous
