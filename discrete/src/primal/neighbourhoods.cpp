// SPDX-License-Identifier: MIT
#include "primal/neighbourhoods.hpp"

#include <algorithm>
#include <utility>

namespace quadrille::discrete {

Neighbourhoods::Neighbourhoods(const Instance& instance, const GoalDistances& distances,
                               const IdVector<AgentId, Path>& paths,
                               const Reservations& reservations, Random& random)
    : instance_(instance),
      distances_(distances),
      paths_(paths),
      reservations_(reservations),
      random_(random),
      is_chosen_(instance.num_agents(), 0),
      is_queued_(instance.graph().num_vertices(), 0) {}

std::vector<AgentId> Neighbourhoods::choose(Rule rule, std::size_t size, AgentId seed) {
  size = std::clamp<std::size_t>(size, 1, instance_.num_agents());
  if (rule == Rule::delayed) {
    take(seed);
    AgentId walker = seed;
    for (int attempt = 0; attempt < 10 && chosen_.size() < size; ++attempt) {
      walk(walker, size);
      walker = chosen_[static_cast<std::size_t>(random_.below(chosen_.size()))];
    }
  } else if (rule == Rule::place) {
    gather_around(random_vertex_of(seed), size);
  } else {
    fill_up(size);
  }
  for (const AgentId agent : chosen_) is_chosen_[agent.index()] = 0;
  return std::exchange(chosen_, {});
}

void Neighbourhoods::take(AgentId agent) {
  if (is_chosen_[agent.index()] != 0) return;
  is_chosen_[agent.index()] = 1;
  chosen_.push_back(agent);
}

VertexId Neighbourhoods::random_vertex_of(AgentId agent) {
  const Path& path = paths_[agent];
  return path[static_cast<std::size_t>(random_.below(path.size()))];
}

/// A random walk that leaves the agent's path at a random time and could still make it arrive
/// earlier than now. Those who are met on it are taken.
void Neighbourhoods::walk(AgentId agent, std::size_t size) {
  const Path& path = paths_[agent];
  const auto arrival = static_cast<Timestep>(path.size()) - 1;
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
    if (const Stay* met = reservations_.stay_at(to, t + 1)) take(met->agent);
    const Stay* ahead = reservations_.stay_at(to, t);
    if (ahead != nullptr && ahead->end == t && ahead->next == at) take(ahead->agent);
    at = to;
  }
}

/// The agents that pass the vertices around a place, nearest vertices first.
void Neighbourhoods::gather_around(VertexId centre, std::size_t size) {
  queue_.assign(1, centre);
  is_queued_[centre] = 1;
  for (std::size_t head = 0; head < queue_.size() && chosen_.size() < size; ++head) {
    const VertexId v = queue_[head];
    const auto stays = reservations_.stays(v);
    const std::size_t count = stays.size();
    const std::size_t shift = count == 0 ? 0 : static_cast<std::size_t>(random_.below(count));
    for (std::size_t k = 0; k < count && chosen_.size() < size; ++k)
      take(stays[(k + shift) % count].agent);
    for (const VertexId w : instance_.graph().neighbours(v)) {
      if (is_queued_[w] != 0) continue;
      is_queued_[w] = 1;
      queue_.push_back(w);
    }
  }
  for (const VertexId v : queue_) is_queued_[v] = 0;
}

void Neighbourhoods::fill_up(std::size_t size) {
  if (2 * size < instance_.num_agents()) {
    while (chosen_.size() < size)
      take(AgentId(static_cast<std::size_t>(random_.below(instance_.num_agents()))));
    return;
  }
  std::vector<AgentId> agents;
  for (const AgentId agent : instance_.agents()) agents.push_back(agent);
  random_.shuffle_front(agents, size);
  for (std::size_t k = 0; k < size; ++k) take(agents[k]);
}

}  // namespace quadrille::discrete
