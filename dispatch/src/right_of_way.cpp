// SPDX-License-Identifier: MIT
#include "right_of_way.hpp"

#include <algorithm>
#include <utility>

#include "quadrille/execution/executor.hpp"
#include "quadrille/geometry/body_pair.hpp"

namespace quadrille::dispatch {
namespace {

using execution::MoveId;
using execution::Precedences;
using execution::TimedMove;

/// Until the origin, what is left to the robot: the lanes, as whole moves.
std::vector<TimedMove> lanes_until(const Course& course, Ticks clock, Ticks origin) {
  const Course rest = since(until(course, origin), clock);
  std::vector<TimedMove> lanes;
  for (std::size_t k = 0; k + 1 < rest.size(); ++k) {
    const Spot &a = rest[k].spot, &b = rest[k + 1].spot;
    const VertexId to = !a.is_vertex() ? a.to : b.is_vertex() ? b.from : b.to;
    lanes.push_back({a.from, to, rest[k].depart, rest[k + 1].arrive});
  }
  return lanes;
}

/// The robot's lanes become its first moves, and lead every move that could ever meet them.
void lead_with(const std::vector<TimedMove>& lanes, AgentId robot, const Instance& instance,
               Precedences& order) {
  if (lanes.empty()) return;
  const auto shift = static_cast<std::uint32_t>(lanes.size());
  for (execution::Precedence& p : order.list)
    for (MoveId* const id : {&p.leader, &p.follower})
      if (id->agent == robot) id->move += shift;
  std::vector<TimedMove>& own = order.moves[robot];
  own.insert(own.begin(), lanes.begin(), lanes.end());
  const auto motion = [&](const TimedMove& move) {
    return instance.roadmap().motion(move.from, move.to, std::max<Ticks>(1, move.end - move.begin));
  };
  for (const AgentId other : instance.agent_ids()) {
    if (other == robot) continue;
    const geometry::BodyPair bodies(instance.agent(robot).body, instance.agent(other).body);
    for (std::uint32_t m = 0; m < order.moves[other].size(); ++m) {
      const TimedMove& move = order.moves[other][m];
      if (move.begin < order.now) continue;  // lanes of its own, likewise
      for (std::uint32_t k = 0; k < shift; ++k)
        if (bodies.can_meet(motion(lanes[k]), motion(move)))
          order.list.push_back({{robot, k}, {other, m}, 0});
    }
  }
}

}  // namespace

std::optional<RightOfWay> find_right_of_way(const Traffic& traffic,
                                            std::span<const Course> courses) {
  const std::vector<Ticks>& clocks = traffic.clocks;
  const Ticks earliest = *std::min_element(clocks.begin(), clocks.end());
  const Ticks moment = std::max(traffic.origin, earliest);
  const auto snapshot =
      take_snapshot_of_ends(traffic.roadmap, traffic.resolution, traffic.agents, courses, moment);
  if (!snapshot) return std::nullopt;
  auto order = execution::precedences(snapshot->instance, snapshot->plan);
  if (!order) return std::nullopt;
  for (std::size_t i = 0; i < clocks.size(); ++i)
    if (clocks[i] < traffic.origin)
      lead_with(lanes_until(courses[i], clocks[i], traffic.origin), AgentId(i), snapshot->instance,
                *order);
  execution::Executor executor(*order);
  RightOfWay found{std::vector<Ticks>(clocks.size()), {}};
  executor.limits(clocks, found.limits);
  found.order = std::move(order).value();
  return found;
}

}  // namespace quadrille::dispatch
