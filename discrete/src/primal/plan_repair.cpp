// SPDX-License-Identifier: MIT
#include "primal/plan_repair.hpp"

#include <utility>
#include <vector>

namespace quadrille::discrete {

PlanRepair::PlanRepair(const Instance& instance, std::shared_ptr<const GoalDistances> distances,
                       std::uint32_t seed)
    : instance_(instance),
      distances_(std::move(distances)),
      random_(seed),
      reservations_(instance.graph().num_vertices()),
      planner_(instance_, *distances_, random_) {}

std::optional<Plan> PlanRepair::repair(const Plan& draft, LimitMonitor& limits) {
  constexpr std::int64_t kEffortPerTimestep = 100;  // for who has to go out of everybody's way
  Plan plan = draft;
  trim(plan);
  std::vector<AgentId> agents, kept, rest;
  for (const AgentId agent : instance_.agents()) agents.push_back(agent);
  random_.shuffle_front(agents, agents.size());
  for (const AgentId agent : agents) {
    const bool is_kept = is_free(plan.paths[agent]);
    if (is_kept) reservations_.add(agent, plan.paths[agent]);
    (is_kept ? kept : rest).push_back(agent);
  }
  bool works = true;
  for (const AgentId agent : rest) {
    const auto effort = kEffortPerTimestep * static_cast<std::int64_t>(plan.paths[agent].size());
    auto path = planner_.find(agent, reservations_, kForever - 1, effort, limits);
    works = path.has_value();
    if (!works) break;
    plan.paths[agent] = std::move(*path);
    reservations_.add(agent, plan.paths[agent]);
    kept.push_back(agent);
  }
  for (const AgentId agent : kept) reservations_.remove(plan.paths[agent]);
  if (!works) return std::nullopt;
  return plan;
}

bool PlanRepair::is_free(const Path& path) const {
  const auto arrival = static_cast<Timestep>(path.size()) - 1;
  for (Timestep t = 0; t <= arrival; ++t) {
    const VertexId v = path[static_cast<std::size_t>(t)];
    if (reservations_.stay_at(v, t) != nullptr) return false;
    if (t == arrival) break;
    const VertexId w = path[static_cast<std::size_t>(t) + 1];
    const Stay* ahead = reservations_.stay_at(w, t);
    if (ahead != nullptr && ahead->end == t && ahead->next == v) return false;
  }
  const auto stays = reservations_.stays(path.back());
  return stays.empty() || stays.back().end < arrival;
}

}  // namespace quadrille::discrete
