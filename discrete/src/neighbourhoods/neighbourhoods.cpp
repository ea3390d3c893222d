// SPDX-License-Identifier: MIT
#include "neighbourhoods/neighbourhoods.hpp"

#include <algorithm>

namespace quadrille::discrete {

Neighbourhoods::Neighbourhoods(const Instance& instance, const GoalDistances& distances,
                               const IdVector<AgentId, Path>& paths,
                               const Reservations& reservations, Random& random)
    : instance_(instance),
      distances_(distances),
      paths_(paths),
      reservations_(reservations),
      random_(random),
      chosen_(instance) {}

std::vector<AgentId> Neighbourhoods::choose(Rule rule, std::size_t size, AgentId seed) {
  size = std::clamp<std::size_t>(size, 1, instance_.num_agents());
  if (rule == Rule::delayed) {
    chosen_.take(seed);
    AgentId walker = seed;
    for (int attempt = 0; attempt < 10 && chosen_.size() < size; ++attempt) {
      walk(walker, size);
      walker = chosen_[static_cast<std::size_t>(random_.below(chosen_.size()))];
    }
  } else if (rule == Rule::place) {
    const Path& path = paths_[seed];
    const auto t = static_cast<Timestep>(random_.below(path.size()));
    chosen_.take_around(position(path, t), t, size, reservations_);
  } else {
    fill_up(size);
  }
  return chosen_.release();
}

/// A random walk that leaves the agent's path at a random time and could still make it arrive
/// earlier than now. Those who are met on it are taken.
void Neighbourhoods::walk(AgentId agent, std::size_t size) {
  const Path& path = paths_[agent];
  const Timestep arrival = static_cast<Timestep>(path.size()) - 1 + distances_.price(path.back());
  auto t = static_cast<Timestep>(random_.below(path.size()));
  VertexId at = position(path, t);
  std::vector<VertexId> ways;
  for (; chosen_.size() < size; ++t) {
    ways.clear();
    const auto add = [&](VertexId v) {
      if (t + 1 + distances_(agent, v) < arrival) ways.push_back(v);
    };
    for (const VertexId v : instance_.graph().neighbours(at)) add(v);
    add(at);
    if (ways.empty()) return;
    const VertexId to = ways[static_cast<std::size_t>(random_.below(ways.size()))];
    if (const Stay* met = reservations_.stay_at(to, t + 1)) chosen_.take(met->agent);
    const Stay* ahead = reservations_.stay_at(to, t);
    if (ahead != nullptr && ahead->end == t && ahead->next == at) chosen_.take(ahead->agent);
    at = to;
  }
}

void Neighbourhoods::fill_up(std::size_t size) {
  if (2 * size < instance_.num_agents()) {
    while (chosen_.size() < size)
      chosen_.take(AgentId(static_cast<std::size_t>(random_.below(instance_.num_agents()))));
    return;
  }
  std::vector<AgentId> agents;
  for (const AgentId agent : instance_.agent_ids()) agents.push_back(agent);
  random_.shuffle_front(agents, size);
  for (std::size_t k = 0; k < size; ++k) chosen_.take(agents[k]);
}

}  // namespace quadrille::discrete
