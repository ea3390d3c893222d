// SPDX-License-Identifier: MIT
#include "solve/small_instances.hpp"

#include <utility>

#include "feasibility/feasibility.hpp"
#include "joint/joint_search.hpp"

namespace quadrille::continuous {
namespace {

constexpr std::size_t kMaxAgents = 4, kMaxVertices = 10, kMaxEdges = 100;
/// Nothing else proves that there is no plan. Measured: 1 in 1,000 random instances needs more than
/// a tenth of it.
constexpr std::int64_t kFeasibilityWork = 300'000'000;

}  // namespace

bool is_small(const Instance& instance) {
  return joint_scope(instance) == JointScope::exact && instance.num_agents() <= kMaxAgents &&
         instance.roadmap().num_vertices() <= kMaxVertices &&
         instance.roadmap().num_edges() <= kMaxEdges;
}

SmallReport search_small_instance(Scene& scene, Objective objective, std::int64_t work) {
  Feasibility feasibility = check_feasibility(scene, kFeasibilityWork);
  SmallReport report{std::move(feasibility.blocked), 0, std::move(feasibility.plan)};
  if (!report.blocked.empty()) return report;
  std::optional<Cost> known;
  if (report.plan) known = cost(*report.plan, objective);
  JointReport joint = find_cheapest_joint_plan(scene, objective, known, work);
  report.lower_bound = joint.lower_bound;
  if (joint.end == JointReport::End::found)
    report.plan = Plan{IdVector<AgentId, Path>(std::move(joint.paths))};
  else if (joint.end == JointReport::End::exhausted && !known)
    for (const AgentId i : scene.instance().agent_ids()) report.blocked.push_back(i);
  return report;
}

}  // namespace quadrille::continuous
