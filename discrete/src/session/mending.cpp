// SPDX-License-Identifier: MIT
#include "session/mending.hpp"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <utility>

#include "neighbourhoods/plan_repair.hpp"
#include "quadrille/discrete/goal_distances.hpp"
#include "quadrille/discrete/verify.hpp"

namespace quadrille::discrete {
namespace {

/// Some tenths of a second.
constexpr std::int64_t kMostEffort = 10'000'000;

/// Of the cheapest paths the one whose vertices come first. Empty: there is none.
Path cheapest_path(const Instance& instance, const GoalDistances& distances, AgentId agent) {
  Path path{instance.agents()[agent].start};
  Timestep left = distances(agent, path.back());
  if (left == kUnreachable) return {};
  while (left > 0) {
    --left;
    const auto next = instance.graph().neighbours(path.back());
    path.push_back(*std::find_if(next.begin(), next.end(),
                                 [&](VertexId v) { return distances(agent, v) == left; }));
  }
  return path;
}

}  // namespace

std::optional<Plan> mend(const Instance& instance, IdVector<AgentId, Path> paths,
                         std::uint32_t seed, LimitMonitor& limits) {
  Plan plan{std::move(paths), instance.now()};
  const bool is_whole = std::none_of(plan.paths.begin(), plan.paths.end(),
                                     [](const Path& path) { return path.empty(); });
  if (is_whole && verify(instance, plan).valid()) return plan;
  if (!instance.is_plain()) return std::nullopt;
  const auto distances = GoalDistances::make(instance, limits);
  if (distances == nullptr) return std::nullopt;
  for (const AgentId i : instance.agent_ids()) {
    Path& path = plan.paths[i];
    if (path.empty()) path = cheapest_path(instance, *distances, i);
    if (path.empty()) return std::nullopt;
  }
  auto mended = PlanRepair(instance, distances, seed).repair(plan, kMostEffort, limits);
  if (!mended) return std::nullopt;
  mended->now = instance.now();
  if (!verify(instance, *mended).valid()) return std::nullopt;
  return mended;
}

}  // namespace quadrille::discrete
