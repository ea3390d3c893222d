// SPDX-License-Identifier: MIT
#include "model/since_now.hpp"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "model/obstacle_leg.hpp"

namespace quadrille::continuous {
namespace {

/// nullopt if it is nowhere from `now` on.
std::optional<MovingObstacle> since(const MovingObstacle& obstacle, Ticks now) {
  MovingObstacle rest{obstacle.body, {}, obstacle.leaves};
  const auto leg = leg_at(obstacle, now);
  if (!leg && obstacle.path.front().arrive <= now) return std::nullopt;
  for (std::size_t k = leg ? leg->stop : 0; k < obstacle.path.size(); ++k) {
    const MovingObstacle::Stop& stop = obstacle.path[k];
    rest.path.push_back({stop.at, stop.arrive - now, stop.depart - now});
  }
  MovingObstacle::Stop& begin = rest.path.front();
  begin.arrive = leg && leg->is_moving ? begin.depart : std::max(begin.arrive, Ticks{0});
  begin.depart = std::max(begin.depart, begin.arrive);  // where it stays for ever
  return rest;
}

}  // namespace

Instance since_now(const Instance& instance) {
  Instance same = instance;
  same.now_ = 0;
  for (Agent& agent : same.agents_) {
    agent.release = std::max(Ticks{0}, agent.release - instance.now());
    if (agent.deadline) *agent.deadline -= instance.now();
  }
  same.obstacles_.clear();
  for (const MovingObstacle& obstacle : instance.obstacles())
    if (auto rest = since(obstacle, instance.now())) same.obstacles_.push_back(*std::move(rest));
  return same;
}

void shift(Plan& plan, Ticks by) {
  for (Path& path : plan.paths)
    for (Stop& stop : path) {
      stop.arrive += by;
      stop.depart += by;
    }
}

}  // namespace quadrille::continuous
