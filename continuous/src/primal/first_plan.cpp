// SPDX-License-Identifier: MIT
#include "primal/first_plan.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "primal/plan_improver.hpp"
#include "quadrille/continuous/verify.hpp"
#include "quadrille/core/random.hpp"

namespace quadrille::continuous {
namespace {

constexpr int kMaxOrders = 60;
/// Orders tried after a plan is known.
constexpr int kMaxImprovements = 2;

class OneByOne {
 public:
  explicit OneByOne(Scene& scene)
      : scene_(scene),
        finder_(scene.instance(), &scene.limits()),
        bans_(scene.instance().roadmap()) {}

  /// The agent that found no path, if one did not. Throws LimitReached.
  std::optional<std::size_t> try_order(const std::vector<AgentId>& order) {
    std::vector<std::vector<Step>> steps;
    paths_.assign(order.size(), {});
    for (std::size_t k = 0; k < order.size(); ++k) {
      const AgentId i = order[k];
      bans_.clear();
      for (std::size_t before = 0; before < k; ++before) {
        scene_.limits().check();
        keep_clear(i, order[before], steps[before]);
      }
      TimedPath path;
      if (!finder_.find(scene_.task(i), bans_, kForever, &path)) return k;
      steps.emplace_back();
      list_steps(scene_.instance(), i, path, steps.back());
      paths_[i.index()] = with_stops(scene_.instance(), i, path);
    }
    return std::nullopt;
  }
  [[nodiscard]] Plan plan() const {
    Plan plan;
    for (const Path& path : paths_) plan.paths.push_back(path);
    return plan;
  }

 private:
  void keep_clear(AgentId i, AgentId other, const std::vector<Step>& steps) {
    const Instance& instance = scene_.instance();
    bans_.add(bans_around(scene_, instance.class_of(i), instance.class_of(other), steps));
  }

  Scene& scene_;
  PathFinder finder_;
  BanTable bans_;
  std::vector<Path> paths_;
};

void try_orders(Scene& scene, Objective objective, std::optional<Plan>& best) {
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
  int improvements = 0;
  for (int round = 0; round < kMaxOrders && improvements <= kMaxImprovements; ++round) {
    if (scene.limits().exhausted_now()) break;
    if (best) ++improvements;
    if (const auto failed = planner.try_order(order)) {
      // Who found no path goes first; now and then another agent goes before it.
      const auto at = order.begin() + static_cast<std::ptrdiff_t>(*failed);
      std::rotate(order.begin(), at, at + 1);
      if (round % 8 == 7) std::swap(someone(), order[0]);
      continue;
    }
    Plan plan = planner.plan();
    const bool is_better = !best || cost(plan, objective) < cost(*best, objective);
    if (is_better && verify(instance, plan).valid()) best = std::move(plan);
    AgentId& first = someone();
    std::swap(first, someone());
  }
}

}  // namespace

std::optional<Plan> find_first_plan(Scene& scene, Objective objective) {
  if (scene.instance().num_agents() == 0) return Plan{};
  std::optional<Plan> best;
  try {
    try_orders(scene, objective, best);
  } catch (const LimitReached&) {  // the best plan so far will do
  }
  return best;
}

}  // namespace quadrille::continuous
