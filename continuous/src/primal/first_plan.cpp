// SPDX-License-Identifier: MIT
#include "primal/first_plan.hpp"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "quadrille/continuous/verify.hpp"
#include "quadrille/core/random.hpp"
#include "traffic/traffic.hpp"

namespace quadrille::continuous {
namespace {

constexpr int kMaxOrders = 60;
/// Of a plan that is completed: what is not mended soon is made anew.
constexpr int kMaxOrdersOfDraft = 10;

/// Whether the steps of a path break none of the bans.
bool obeys(BanTable& bans, const std::vector<Step>& steps) {
  return std::all_of(steps.begin(), steps.end(), [&](const Step& step) {
    if (step.is_move) {
      const std::uint32_t place = bans.starts_of(step.edge, step.begin);
      if (place == BanTable::kFree) return true;
      const auto& forbidden = bans.forbidden_starts(place);
      return std::none_of(forbidden.begin(), forbidden.end(), [&](const TickInterval& when) {
        return when.begin <= step.begin && step.begin < when.end;
      });
    }
    const std::uint32_t place = bans.stays_of(step.vertex);
    if (place == BanTable::kFree) return true;
    const auto& stays = bans.safe_stays(place);
    return std::any_of(stays.begin(), stays.end(), [&](const BanTable::SafeStay& stay) {
      return stay.from <= step.begin && step.end <= stay.until;
    });
  });
}

class OneByOne {
 public:
  /// `wanted`: paths that are taken if nobody before is in the way; empty: any.
  OneByOne(Scene& scene, const IdVector<AgentId, Path>& wanted)
      : scene_(scene),
        wanted_(wanted),
        finder_(scene.instance(), &scene.limits()),
        traffic_(Traffic::make(scene)) {}

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
      if (!take_wanted(i, path, steps)) {
        if (!finder_.find(scene_.task(i), traffic_->bans(c), kForever, &path)) return k;
        list_steps(instance, i, path, steps);
      }
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
  bool take_wanted(AgentId i, TimedPath& path, std::vector<Step>& steps) {
    if (wanted_.empty() || wanted_[i].empty()) return false;
    path = without_stops(scene_.instance(), i, wanted_[i]);
    list_steps(scene_.instance(), i, path, steps);
    return obeys(traffic_->bans(scene_.instance().class_of(i)), steps);
  }

  Scene& scene_;
  const IdVector<AgentId, Path>& wanted_;
  PathFinder finder_;
  std::unique_ptr<Traffic> traffic_;
  std::vector<Path> paths_;
};

std::optional<Plan> try_orders(Scene& scene, const IdVector<AgentId, Path>& wanted,
                               int max_orders) {
  const Instance& instance = scene.instance();
  std::vector<AgentId> order;
  for (const AgentId i : instance.agent_ids()) order.push_back(i);
  std::stable_sort(order.begin(), order.end(),
                   [&](AgentId a, AgentId b) { return scene.free_cost(a) > scene.free_cost(b); });
  std::stable_partition(order.begin(), order.end(),
                        [&](AgentId i) { return !wanted.empty() && !wanted[i].empty(); });
  OneByOne planner(scene, wanted);
  Random random(1);
  const auto someone = [&]() -> AgentId& {
    return order[static_cast<std::size_t>(random.below(order.size()))];
  };
  for (int round = 0; round < max_orders && !scene.limits().exhausted_now(); ++round) {
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
    return try_orders(scene, {}, kMaxOrders);
  } catch (const LimitReached&) {
    return std::nullopt;
  }
}

std::optional<Plan> complete_plan(Scene& scene, const IdVector<AgentId, Path>& wanted) {
  try {
    return try_orders(scene, wanted, kMaxOrdersOfDraft);
  } catch (const LimitReached&) {
    return std::nullopt;
  }
}

}  // namespace quadrille::continuous
