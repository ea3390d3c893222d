// SPDX-License-Identifier: MIT
//
// On purpose this uses nothing of geometry/ but its names for integers: an independent opinion.
#include "quadrille/continuous/verify.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>

#include "verify/replay.hpp"

namespace quadrille::continuous {
namespace {

using Kind = Violation::Kind;

class PathCheck {
 public:
  PathCheck(const Instance& instance, AgentId i, std::vector<Violation>& violations)
      : instance_(instance), i_(i), violations_(violations) {}

  /// Whether the path can be laid out in space and time.
  bool check(const Path& path) {
    if (path.empty()) return fail(Kind::empty_path, 0, "has no stops");
    if (!check_stops(path)) return false;
    const Agent& agent = instance_.agent(i_);
    bool good = true;
    if (path.front().vertex != agent.start)
      good = fail(Kind::wrong_start, 0,
                  "begins at vertex " + std::to_string(path.front().vertex.index()) +
                      ", but its start is vertex " + std::to_string(agent.start.index()));
    if (!agent.goals.contains(path.back().vertex))
      good = fail(Kind::wrong_goal, path.back().arrive,
                  "ends at vertex " + std::to_string(path.back().vertex.index()) + " at time " +
                      time(path.back().arrive) +
                      (agent.goals.is_single()
                           ? ", but its goal is vertex " + std::to_string(agent.goal().index())
                           : ", which is none of its goals"));
    if (agent.deadline && path.back().arrive > *agent.deadline)
      good = fail(Kind::too_late, path.back().arrive,
                  "arrives at its goal at time " + time(path.back().arrive) +
                      ", after its deadline at time " + time(*agent.deadline));
    if (agent.under_way && path.front().depart > instance_.now())
      good = fail(Kind::waits, path.front().arrive,
                  "stops at vertex " + std::to_string(path.front().vertex.index()) +
                      ", where it is in the middle of a move");
    for (const Stop& stop : path)
      if (stop.depart > stop.arrive && forbids_waiting(stop.vertex))
        good = fail(Kind::waits, stop.arrive,
                    "waits at vertex " + std::to_string(stop.vertex.index()) +
                        ", where nobody may, from time " + time(stop.arrive) + " to time " +
                        time(stop.depart));
    for (std::size_t k = 0; k + 1 < path.size(); ++k) good &= check_move(path[k], path[k + 1]);
    return good;
  }

 private:
  bool fail(Kind kind, Ticks tick, const std::string& what) {
    violations_.push_back({kind, i_, std::nullopt, tick, agent_name(i_) + " " + what});
    return false;
  }

  [[nodiscard]] std::string time(Ticks ticks) const { return time_text(instance_, ticks); }
  [[nodiscard]] std::string move(const Stop& a, const Stop& b) const {
    return "moves from vertex " + std::to_string(a.vertex.index()) + " to vertex " +
           std::to_string(b.vertex.index()) + " at time " + time(a.depart);
  }

  [[nodiscard]] bool forbids_waiting(VertexId v) const {
    const std::vector<VertexId>& all = instance_.roadmap().no_waiting();
    return std::binary_search(all.begin(), all.end(), v);
  }

  bool check_stops(const Path& path) {
    bool good = true;
    Ticks now = 0;
    for (const Stop& stop : path) {
      if (stop.vertex.index() >= instance_.roadmap().num_vertices())
        good = fail(Kind::bad_vertex, stop.arrive,
                    "names vertex " + std::to_string(stop.vertex.index()) + ", which is none");
      if (stop.arrive < now || stop.depart < stop.arrive || stop.depart > kMaxTick)
        good = fail(Kind::bad_time, stop.arrive,
                    "arrives at vertex " + std::to_string(stop.vertex.index()) + " at time " +
                        time(stop.arrive) + " and departs at time " + time(stop.depart) +
                        ": that goes back in time, or on for too long");
      now = stop.depart;
    }
    if (path.front().arrive != instance_.now())
      good = fail(Kind::bad_time, instance_.now(), "is nowhere at time " + time(instance_.now()));
    if (path.back().depart != path.back().arrive)
      good = fail(Kind::bad_time, path.back().depart, "departs from its last stop");
    return good;
  }

  bool check_move(const Stop& a, const Stop& b) {
    if (a.depart < instance_.agent(i_).release)
      return fail(Kind::too_early, a.depart,
                  move(a, b) + ", before its release at time " + time(instance_.agent(i_).release));
    bool is_adjacent = false, is_open = false;
    Ticks takes = 0;
    const ClassId c = instance_.class_of(i_);
    for (const EdgeId e : instance_.roadmap().out_edges(a.vertex)) {
      if (instance_.roadmap().to(e) != b.vertex) continue;
      is_adjacent = true;
      if (!instance_.roadmap().edge(e).open_to.contains(instance_.agent(i_).group)) continue;
      is_open = true;
      takes = instance_.duration(c, e);
      if (takes == b.arrive - a.depart) return true;
    }
    const std::string name = move(a, b);
    if (!is_adjacent) return fail(Kind::not_adjacent, a.depart, name + ", but there is no edge");
    if (!is_open)
      return fail(Kind::closed_edge, a.depart, name + ", but that edge is not open to it");
    return fail(
        Kind::duration, a.depart,
        name + " and takes " + time(b.arrive - a.depart) + ", but the edge takes " + time(takes));
  }

  const Instance& instance_;
  const AgentId i_;
  std::vector<Violation>& violations_;
};

}  // namespace

std::string_view to_string(Violation::Kind kind) noexcept {
  switch (kind) {
    case Kind::path_count:
      return "path-count";
    case Kind::empty_path:
      return "empty-path";
    case Kind::bad_vertex:
      return "bad-vertex";
    case Kind::bad_time:
      return "bad-time";
    case Kind::wrong_start:
      return "wrong-start";
    case Kind::wrong_goal:
      return "wrong-goal";
    case Kind::not_adjacent:
      return "not-adjacent";
    case Kind::too_early:
      return "too-early";
    case Kind::too_late:
      return "too-late";
    case Kind::closed_edge:
      return "closed-edge";
    case Kind::waits:
      return "waits";
    case Kind::duration:
      return "duration";
    case Kind::collision:
      return "collision";
    case Kind::obstacle:
      return "obstacle";
    case Kind::whole_moves:
      return "whole-moves";
  }
  return "";
}

VerifyReport verify(const Instance& instance, const Plan& plan, std::size_t num_clearances) {
  VerifyReport report;
  if (plan.paths.size() != instance.num_agents()) {
    report.violations.push_back({Kind::path_count, AgentId(0), std::nullopt, 0,
                                 "the plan has " + std::to_string(plan.paths.size()) +
                                     " paths for " + std::to_string(instance.num_agents()) +
                                     " agents"});
    return report;
  }
  IdVector<AgentId, bool> sound(plan.paths.size(), false);
  for (const AgentId i : instance.agent_ids())
    sound[i] = PathCheck(instance, i, report.violations).check(plan.paths[i]);
  Happenings found = replay(instance, plan, sound, num_clearances);
  std::move(found.collisions.begin(), found.collisions.end(),
            std::back_inserter(report.violations));
  report.clearances = std::move(found.clearances);
  report.sum_of_costs = cost(plan, Objective::sum_of_costs);
  report.makespan = cost(plan, Objective::makespan);
  if (report.sum_of_costs == std::numeric_limits<Cost>::max())
    report.violations.push_back({Kind::bad_time, AgentId(0), std::nullopt,
                                 as_ticks(report.makespan),
                                 "the costs of all agents sum up to more than is supported"});
  return report;
}

}  // namespace quadrille::continuous
