// SPDX-License-Identifier: MIT
#include "work.hpp"

#include <algorithm>
#include <utility>

#include "quadrille/geometry/body_index.hpp"

namespace quadrille::dispatch {
namespace {

/// The one that it comes to next.
VertexId next_vertex(const Course& course, Ticks now) {
  const Course rest = since(course, now);
  return rest[std::min<std::size_t>(1, rest.size() - 1)].spot.to;
}

Goals without(const Goals& goals, VertexId vertex) {
  std::vector<VertexId> left(goals.vertices().begin(), goals.vertices().end());
  std::erase(left, vertex);
  return left.size() < 2 ? goals : Goals(std::move(left));
}

}  // namespace
Work next_work(std::span<const Robot> robots, const continuous::Roadmap& roadmap,
               const Roads& roads, std::int64_t call, Ticks now) {
  Work work;
  std::vector<std::size_t> waiting;
  std::vector<AgentId> held;
  geometry::BodyIndex taken;
  for (std::size_t i = 0; i < robots.size(); ++i) {
    const Robot& robot = robots[i];
    const VertexId here = spot_at(robot.course, now).to;  // where it stands, or its lane ends
    // Who need not go anywhere gets out of the way of others, and so may end where these began.
    work.goals.push_back(
        roads.near(robot.agent, robot.is_barred ? here : robot.course.back().spot.from));
    if (robot.is_barred) {
      const auto barrier = roads.barrier(robot.course, robot.limit);
      // Else it should be in that lane by now, and is planned for where it is not.
      if (!barrier || *barrier >= now) work.order.emplace_back(i);
      // Not where it has been waiting to go.
      if (!barrier && robot.course.size() > 1)
        work.goals.back() = without(work.goals.back(), next_vertex(robot.course, now));
      continue;
    }
    if (robot.wants_path()) waiting.push_back(i);
    const bool keeps = robot.is_bound || robot.busy_until;
    if (robot.is_held && !keeps && !robot.wants_path()) {
      held.emplace_back(i);
      // It need not go anywhere.
      if (here != robot.course.back().spot.from)
        work.goals.back() = Goals({robot.course.back().spot.from, here});
    }
    if (!keeps) continue;
    taken.add(i, robot.agent.body, roadmap.place(robot.course.back().spot.from));
    if (!robot.is_bound || robot.busy_until) continue;
    if (robot.is_held) held.emplace_back(i);
    work.goals.back() = robot.tasks.front().task.goals;
  }
  std::stable_sort(waiting.begin(), waiting.end(), [&](std::size_t a, std::size_t b) {
    return is_more_urgent(robots[a], robots[b]);
  });
  for (const std::size_t i : waiting) {
    const Robot& robot = robots[i];
    std::vector<VertexId> free;
    for (const VertexId v : robot.tasks.front().task.goals.vertices())
      if (!taken.first_overlap(robot.agent.body, roadmap.place(v))) free.push_back(v);
    if (free.empty()) continue;
    const VertexId here = spot_at(robot.course, now).to;
    if (!roads.are_open() && !roads.lead(robot.agent, here, Goals(free))) continue;
    if (free.size() == 1) taken.add(i, robot.agent.body, roadmap.place(free.front()));
    work.goals[i] = Goals(std::move(free));
    if (robot.next_try > call) continue;
    work.order.push_back(AgentId(i));
  }
  work.order.insert(work.order.end(), held.begin(), held.end());
  return work;
}

}  // namespace quadrille::dispatch
