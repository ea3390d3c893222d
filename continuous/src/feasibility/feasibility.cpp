// SPDX-License-Identifier: MIT
#include "feasibility/feasibility.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>

#include "joint/joint_search.hpp"
#include "quadrille/continuous/verify.hpp"

namespace quadrille::continuous {
namespace {

class PartSearch {
 public:
  PartSearch(Scene& scene, std::vector<AgentId> agents, JointRules rules,
             std::int64_t work_per_size)
      : scene_(scene), agents_(std::move(agents)), rules_(rules), work_per_size_(work_per_size) {}

  /// Every two, then every three of four, then all.
  GroupFeasibility run() {
    // One agent alone reaches its goal: seen when the instance was made.
    if (agents_.size() >= 2 && !try_parts_of(2)) return std::move(found_);
    if (agents_.size() == 4 && !try_parts_of(3)) return std::move(found_);
    if (agents_.size() <= kMaxJointAgents && agents_.size() != 2)
      static_cast<void>(try_parts_of(agents_.size()));
    return std::move(found_);
  }

 private:
  /// False once blocked agents or a plan for all were found.
  bool try_parts_of(std::size_t size) {
    work_ = work_per_size_;
    std::vector<AgentId> part;
    return extend(part, 0, size);
  }

  bool extend(std::vector<AgentId>& part, std::size_t next, std::size_t size) {
    if (part.size() == size) return try_part(part);
    for (std::size_t k = next; k + (size - part.size()) <= agents_.size(); ++k) {
      part.push_back(agents_[k]);
      if (!extend(part, k + 1, size)) return false;
      part.pop_back();
      if (is_over()) return true;
    }
    return true;
  }

  [[nodiscard]] bool is_over() { return work_ < 0 || scene_.limits().exhausted_now(); }

  bool try_part(const std::vector<AgentId>& part) {
    JointReport report = find_joint_plan(scene_, part, rules_, work_);
    if (report.end == JointReport::End::exhausted) {
      found_.blocked = part;
      return false;
    }
    if (report.end == JointReport::End::found && part.size() == agents_.size()) {
      found_.paths = std::move(report.paths);
      return false;
    }
    return true;
  }

  Scene& scene_;
  const std::vector<AgentId> agents_;
  const JointRules rules_;
  const std::int64_t work_per_size_;
  std::int64_t work_ = 0;
  GroupFeasibility found_;
};

/// The plan, put off until everybody is released. Nullopt if it breaks rules that the joint search
/// did not know.
std::optional<Plan> released(const Instance& instance, Plan plan) {
  if (joint_scope(instance) == JointScope::exact) return plan;
  Ticks release = 0;
  for (const Agent& agent : instance.agents()) release = std::max(release, agent.release);
  for (Path& path : plan.paths) {
    if (path.size() == 1) continue;  // it stays
    for (Stop& stop : path) {
      if (&stop != &path.front()) stop.arrive += release;
      stop.depart += release;
    }
  }
  if (verify(instance, plan).valid()) return plan;
  return std::nullopt;
}

}  // namespace

Feasibility check_feasibility(Scene& scene, std::int64_t work) {
  if (joint_scope(scene.instance()) == JointScope::none) return {};
  std::vector<AgentId> agents;
  for (const AgentId i : scene.instance().agent_ids()) agents.push_back(i);
  GroupFeasibility found = PartSearch(scene, std::move(agents), JointRules::timeless, work).run();
  Feasibility feasibility{std::move(found.blocked), std::nullopt};
  if (found.paths)
    feasibility.plan =
        released(scene.instance(), Plan{IdVector<AgentId, Path>(*std::move(found.paths))});
  return feasibility;
}

GroupFeasibility check_group(Scene& scene, const std::vector<AgentId>& agents, std::int64_t work) {
  return PartSearch(scene, agents, JointRules::all, work).run();
}

}  // namespace quadrille::continuous
