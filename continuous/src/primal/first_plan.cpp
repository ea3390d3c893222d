// SPDX-License-Identifier: MIT
#include "primal/first_plan.hpp"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "paths/traffic.hpp"
#include "quadrille/continuous/verify.hpp"
#include "quadrille/core/random.hpp"

namespace quadrille::continuous {
namespace {

constexpr int kMaxOrders = 60;

class OneByOne {
 public:
  explicit OneByOne(Scene& scene)
      : scene_(scene), finder_(scene.instance(), &scene.limits()), traffic_(Traffic::make(scene)) {}

  /// The agent that found no path, if one did not. Throws LimitReached.
  std::optional<std::size_t> try_order(const std::vector<AgentId>& order) {
    const Instance& instance = scene_.instance();
    std::vector<Step> steps;
    traffic_->clear();
    paths_.assign(order.size(), {});
    for (std::size_t k = 0; k < order.size(); ++k) {
      const AgentId i = order[k];
      const ClassId c = instance.class_of(i);
      TimedPath path;
      if (!finder_.find(scene_.task(i), traffic_->bans(c), kForever, &path)) return k;
      list_steps(instance, i, path, steps);
      static_cast<void>(traffic_->put(c, steps));
      paths_[i.index()] = with_stops(instance, i, path);
    }
    return std::nullopt;
  }
  [[nodiscard]] Plan plan() const {
    Plan plan;
    for (const Path& path : paths_) plan.paths.push_back(path);
    return plan;
  }

 private:
  Scene& scene_;
  PathFinder finder_;
  std::unique_ptr<Traffic> traffic_;
  std::vector<Path> paths_;
};

std::optional<Plan> try_orders(Scene& scene) {
  const Instance& instance = scene.instance();
  std::vector<AgentId> order;
  for (const AgentId i : instance.agent_ids()) order.push_back(i);
  std::stable_sort(order.begin(), order.end(),
                   [&](AgentId a, AgentId b) { return scene.free_cost(a) > scene.free_cost(b); });
  OneByOne planner(scene);
  Random random(1);
  const auto someone = [&]() -> AgentId& {
    return order[static_cast<std::size_t>(random.below(order.size()))];
  };
  for (int round = 0; round < kMaxOrders && !scene.limits().exhausted_now(); ++round) {
    if (const auto failed = planner.try_order(order)) {
      // Who found no path goes first; now and then another agent goes before it.
      const auto at = order.begin() + static_cast<std::ptrdiff_t>(*failed);
      std::rotate(order.begin(), at, at + 1);
      if (round % 8 == 7) std::swap(someone(), order[0]);
      continue;
    }
    Plan plan = planner.plan();
    if (verify(instance, plan).valid()) return plan;
    AgentId& first = someone();
    std::swap(first, someone());
  }
  return std::nullopt;
}

}  // namespace

std::optional<Plan> find_first_plan(Scene& scene) {
  if (scene.instance().num_agents() == 0) return Plan{};
  try {
    return try_orders(scene);
  } catch (const LimitReached&) {
    return std::nullopt;
  }
}

}  // namespace quadrille::continuous
