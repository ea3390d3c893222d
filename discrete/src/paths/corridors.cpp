// SPDX-License-Identifier: MIT
#include "paths/corridors.hpp"

#include <algorithm>

namespace quadrille::discrete {

Corridors::Corridors(const Graph& graph)
    : graph_(graph), corridor_of_(graph.num_vertices(), kNone) {
  if (graph.is_directed()) return;
  for (const VertexId v : IdRange<VertexId>(graph.num_vertices()))
    if (graph.neighbours(v).size() == 2 && corridor_of_[v] == kNone) add_corridor(v);
}

void Corridors::add_corridor(VertexId seed) {
  Corridor corridor;
  for (const std::size_t side : {std::size_t{0}, std::size_t{1}}) {
    VertexId before = seed, at = graph_.neighbours(seed)[side];
    std::vector<VertexId> chain;
    while (graph_.neighbours(at).size() == 2 && at != seed) {
      chain.push_back(at);
      const auto next = graph_.neighbours(at);
      const VertexId onward = next[0] == before ? next[1] : next[0];
      before = std::exchange(at, onward);
    }
    if (at == seed) return;  // a cycle without ends
    corridor.ends[side] = at;
    if (side == 0) {
      corridor.inner.assign(chain.rbegin(), chain.rend());
      corridor.inner.push_back(seed);
    } else {
      corridor.inner.insert(corridor.inner.end(), chain.begin(), chain.end());
    }
  }
  if (corridor.ends[0] == corridor.ends[1]) return;  // a loop leads back to where it began
  for (const VertexId v : corridor.inner) corridor_of_[v] = corridors_.size();
  corridors_.push_back(std::move(corridor));
}

std::optional<Corridors::Passage> Corridors::find_passage(const Path& path, std::size_t corridor,
                                                          Timestep inside) const {
  if (static_cast<std::size_t>(inside) >= path.size()) return std::nullopt;
  auto entry = static_cast<std::size_t>(inside), exit = entry;
  while (corridor_of_[path[entry]] == corridor) {
    if (entry == 0) return std::nullopt;
    --entry;
  }
  while (corridor_of_[path[exit]] == corridor)
    if (++exit == path.size()) return std::nullopt;
  if (path[entry] == path[exit]) return std::nullopt;
  const std::size_t end = path[exit] == corridors_[corridor].ends[0] ? 0 : 1;
  return Passage{end, static_cast<Timestep>(exit)};
}

Timestep Corridors::detour(AgentId agent, const AgentDistances& distances, std::size_t corridor,
                           std::size_t end) {
  const auto key = std::make_pair(agent, corridor);
  if (const auto known = detours_.find(key); known != detours_.end()) return known->second[end];
  const VertexId cut = corridors_[corridor].inner[corridors_[corridor].inner.size() / 2];
  IdVector<VertexId, Timestep> distance(graph_.num_vertices(), kUnreachable);
  std::vector<VertexId> queue{distances.start()};
  distance[distances.start()] = 0;
  for (std::size_t head = 0; head < queue.size(); ++head)
    for (const VertexId w : graph_.neighbours(queue[head]))
      if (w != cut && distance[w] == kUnreachable) {
        distance[w] = distance[queue[head]] + 1;
        queue.push_back(w);
      }
  const auto& ends = corridors_[corridor].ends;
  return (detours_[key] = {distance[ends[0]], distance[ends[1]]})[end];
}

// Let i leave the corridor of length k (steps from end to end) by its exit at the earliest at t_i,
// and reach it without the corridor at the earliest at t_i'. If i is at its exit by t_i' - 1, it
// has passed the whole corridor by then; if j is at its own exit, where i came in, by t_j' - 1, so
// has it. They went in opposite directions, so one after the other: if i was first, j entered after
// t_i and is at its exit after t_i + k.
std::optional<std::pair<Corridors::Exit, Corridors::Exit>> Corridors::find(
    const AgentDistances& first, const AgentDistances& second, const PathIndex& paths,
    const Encounter& conflict) {
  const bool is_swap = conflict.kind == Encounter::Kind::swap;
  std::size_t corridor = corridor_of_[conflict.vertex];
  Timestep inside_first = conflict.timestep, inside_second = conflict.timestep;
  if (is_swap && corridor != kNone) {
    ++inside_second;
  } else if (is_swap) {
    corridor = corridor_of_[conflict.to];
    ++inside_first;
  }
  if (corridor == kNone) return std::nullopt;
  if (corridor_of_[first.start()] == corridor || corridor_of_[second.start()] == corridor)
    return std::nullopt;
  const auto a = find_passage(paths.path(conflict.first), corridor, inside_first);
  const auto b = find_passage(paths.path(conflict.second), corridor, inside_second);
  if (!a || !b || a->exit == b->exit) return std::nullopt;
  const Corridor& c = corridors_[corridor];
  const auto length = static_cast<Timestep>(c.inner.size()) + 1;
  Exit exit_a{conflict.first, c.ends[a->exit], first.from_start(c.ends[a->exit]), 0};
  Exit exit_b{conflict.second, c.ends[b->exit], second.from_start(c.ends[b->exit]), 0};
  exit_a.last =
      std::min(detour(conflict.first, first, corridor, a->exit) - 1, exit_b.first + length);
  exit_b.last =
      std::min(detour(conflict.second, second, corridor, b->exit) - 1, exit_a.first + length);
  if (a->arrival > exit_a.last || b->arrival > exit_b.last) return std::nullopt;
  return std::make_pair(exit_a, exit_b);
}

}  // namespace quadrille::discrete
