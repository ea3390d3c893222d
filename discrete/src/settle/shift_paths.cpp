// SPDX-License-Identifier: MIT
#include "settle/shift_paths.hpp"

#include <vector>

#include "quadrille/pebbles/shorten.hpp"

namespace quadrille::discrete {

using pebbles::Board;
using pebbles::Shift;

bool write_paths(std::span<const Shift> shifts, std::span<const Local> starts,
                 std::span<const AgentId> agents, std::span<const VertexId> vertices, Plan& plan,
                 LimitMonitor& limits) {
  const std::vector<Timestep> times =
      pebbles::earliest_times(shifts, starts.size(), vertices.size());
  std::vector<Timestep> arrivals(starts.size(), 0);
  for (std::size_t k = 0; k < shifts.size(); ++k) arrivals[shifts[k].agent] = times[k];
  std::size_t size = 0;
  for (const Timestep arrival : arrivals) size += static_cast<std::size_t>(arrival) + 1;
  if (!limits.has_room_for(size * sizeof(VertexId))) return false;
  for (Local agent = 0; agent < starts.size(); ++agent) {
    Path& path = plan.paths[agents[agent]];
    path.reserve(static_cast<std::size_t>(arrivals[agent]) + 1);
    path.assign(1, vertices[starts[agent]]);
  }
  for (std::size_t k = 0; k < shifts.size(); ++k) {
    Path& path = plan.paths[agents[shifts[k].agent]];
    path.resize(static_cast<std::size_t>(times[k]), path.back());
    path.push_back(vertices[shifts[k].to]);
  }
  return true;
}

std::optional<Plan> tightened(const Instance& instance, const Plan& plan, LimitMonitor& limits) {
  constexpr int kRounds = 5;
  std::vector<Local> starts, next;
  std::vector<AgentId> agents;
  std::vector<VertexId> vertices;
  for (const AgentId i : instance.agent_ids()) {
    agents.push_back(i);
    starts.push_back(static_cast<Local>(instance.agents()[i].start.index()));
  }
  const std::size_t num_vertices = instance.graph().num_vertices();
  for (const VertexId v : IdRange<VertexId>(num_vertices)) vertices.push_back(v);
  Board board(static_cast<Local>(num_vertices), starts);
  next.resize(starts.size());
  const Cost makespan = plan.cost(Objective::makespan);
  for (Timestep t = 1; t <= makespan; ++t) {
    for (const AgentId i : instance.agent_ids())
      next[i.index()] = static_cast<Local>(position(plan.paths[i], t).index());
    board.step(next);
  }
  const std::vector<Shift> shifts =
      pebbles::without_loops(board.shifts(), starts, num_vertices, kRounds);
  Plan tight;
  tight.paths.resize(starts.size());
  if (!write_paths(shifts, starts, agents, vertices, tight, limits)) return std::nullopt;
  return tight;
}

}  // namespace quadrille::discrete
