// SPDX-License-Identifier: MIT
#include "solve/small_instances.hpp"

#include <algorithm>
#include <utility>

#include "feasibility/feasibility.hpp"
#include "joint/joint_search.hpp"

namespace quadrille::continuous {
namespace {

/// Of one group.
constexpr std::size_t kMaxAgents = 4, kMaxVertices = 10, kMaxEdges = 100;
/// Of all: so that looking for groups takes no time.
constexpr std::size_t kMaxAllAgents = 16, kMaxAllVertices = 100, kMaxAllEdges = 400;
/// Of obstacles.
constexpr std::size_t kMaxStops = 40;
/// Nothing else proves that there is no plan. Measured: 1 in 1,000 random instances needs more than
/// a tenth of it.
constexpr std::int64_t kFeasibilityWork = 300'000'000;

bool may_be_small(const Instance& instance) {
  std::size_t num_stops = 0;
  for (const MovingObstacle& obstacle : instance.obstacles()) num_stops += obstacle.path.size();
  // The joint search lets agents wait anywhere.
  return instance.roadmap().no_waiting().empty() && num_stops <= kMaxStops &&
         instance.num_agents() <= kMaxAllAgents &&
         instance.roadmap().num_vertices() <= kMaxAllVertices &&
         instance.roadmap().num_edges() <= kMaxAllEdges;
}

/// Of one group.
struct GroupReport {
  std::vector<AgentId> blocked;
  Cost lower_bound = 0;
  std::optional<std::vector<Path>> paths;
};

GroupReport search_group(Scene& scene, const std::vector<AgentId>& agents, Objective objective,
                         std::int64_t& work) {
  GroupFeasibility feasibility = check_group(scene, agents, kFeasibilityWork);
  GroupReport report{std::move(feasibility.blocked), 0, std::move(feasibility.paths)};
  if (!report.blocked.empty()) return report;
  std::optional<Cost> known;
  if (report.paths) known = cost(Plan{IdVector<AgentId, Path>(*report.paths)}, objective);
  JointReport joint = find_cheapest_joint_plan(scene, agents, objective, known, work);
  report.lower_bound = joint.lower_bound;
  if (joint.end == JointReport::End::found)
    report.paths = std::move(joint.paths);
  else if (joint.end == JointReport::End::exhausted && !known)
    report.blocked = agents;
  return report;
}

}  // namespace

std::vector<JointGroup> small_groups(Scene& scene) {
  if (!may_be_small(scene.instance())) return {};
  std::vector<JointGroup> groups = independent_groups(scene);
  const bool are_small = std::all_of(groups.begin(), groups.end(), [](const JointGroup& group) {
    return group.agents.size() <= kMaxAgents && group.num_vertices <= kMaxVertices &&
           group.num_edges <= kMaxEdges;
  });
  if (!are_small) groups.clear();
  return groups;
}

SmallReport search_small_groups(Scene& scene, const std::vector<JointGroup>& groups,
                                Objective objective, std::int64_t work) {
  SmallReport report;
  IdVector<AgentId, Path> paths(scene.instance().num_agents());
  bool has_all = true;
  for (const JointGroup& group : groups) {
    GroupReport found = search_group(scene, group.agents, objective, work);
    if (!found.blocked.empty()) {
      report.blocked = std::move(found.blocked);
      return report;
    }
    report.lower_bound = objective == Objective::sum_of_costs
                             ? report.lower_bound + found.lower_bound
                             : std::max(report.lower_bound, found.lower_bound);
    has_all = has_all && found.paths;
    for (std::size_t k = 0; has_all && k < group.agents.size(); ++k)
      paths[group.agents[k]] = std::move((*found.paths)[k]);
  }
  if (has_all) report.plan = Plan{std::move(paths)};
  return report;
}

}  // namespace quadrille::continuous
