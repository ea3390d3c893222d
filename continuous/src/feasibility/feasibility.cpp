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
  PartSearch(Scene& scene, std::int64_t work_per_size)
      : scene_(scene), work_per_size_(work_per_size) {}

  /// False once blocked agents or a plan for all were found.
  bool try_parts_of(std::size_t size) {
    work_ = work_per_size_;
    std::vector<AgentId> part;
    return extend(part, 0, size);
  }
  [[nodiscard]] Feasibility take() { return std::move(found_); }

 private:
  bool extend(std::vector<AgentId>& part, std::size_t next, std::size_t size) {
    if (part.size() == size) return try_part(part);
    for (std::size_t i = next; i + (size - part.size()) <= scene_.instance().num_agents(); ++i) {
      part.push_back(AgentId(i));
      if (!extend(part, i + 1, size)) return false;
      part.pop_back();
      if (is_over()) return true;
    }
    return true;
  }

  [[nodiscard]] bool is_over() { return work_ < 0 || scene_.limits().exhausted_now(); }

  bool try_part(const std::vector<AgentId>& part) {
    JointReport report = find_joint_plan(scene_, part, work_);
    if (report.end == JointReport::End::exhausted) {
      found_.blocked = part;
      return false;
    }
    if (report.end == JointReport::End::found && part.size() == scene_.instance().num_agents()) {
      found_.plan = released(Plan{IdVector<AgentId, Path>(std::move(report.paths))});
      return false;
    }
    return true;
  }

  /// The plan, put off until everybody is released. Nullopt if it breaks rules that the joint
  /// search does not know.
  [[nodiscard]] std::optional<Plan> released(Plan plan) const {
    const Instance& instance = scene_.instance();
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

  Scene& scene_;
  const std::int64_t work_per_size_;
  std::int64_t work_ = 0;
  Feasibility found_;
};

}  // namespace

Feasibility check_feasibility(Scene& scene, std::int64_t work) {
  if (joint_scope(scene.instance()) == JointScope::none) return {};
  const std::size_t num_agents = scene.instance().num_agents();
  PartSearch search(scene, work);
  // One agent alone reaches its goal: seen when the instance was made.
  if (num_agents >= 2 && !search.try_parts_of(2)) return search.take();
  if (num_agents == 4 && !search.try_parts_of(3)) return search.take();
  if (num_agents <= kMaxJointAgents && num_agents != 2)
    static_cast<void>(search.try_parts_of(num_agents));
  return search.take();
}

}  // namespace quadrille::continuous
