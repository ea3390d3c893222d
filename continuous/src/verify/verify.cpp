// SPDX-License-Identifier: MIT
//
// On purpose this uses nothing of geometry/ but its names for integers: an independent opinion.
#include "quadrille/continuous/verify.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "verify/footprints.hpp"

namespace quadrille::continuous {
namespace {

using Kind = Violation::Kind;

/// A stretch of a path along which the agent goes straight, or stands (from == to).
struct Piece {
  Ticks begin, end;
  Point from, to;
  VertexId start, goal;
};

std::string agent_name(AgentId i) { return "agent " + std::to_string(i.index()); }

std::string move_name(VertexId v, VertexId w, Ticks tick) {
  return "moves from vertex " + std::to_string(v.index()) + " to vertex " +
         std::to_string(w.index()) + " at tick " + std::to_string(tick.count());
}

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
    if (path.back().vertex != agent.goal)
      good = fail(Kind::wrong_goal, path.back().arrive,
                  "ends at vertex " + std::to_string(path.back().vertex.index()) + " at tick " +
                      std::to_string(path.back().arrive.count()) + ", but its goal is vertex " +
                      std::to_string(agent.goal.index()));
    if (agent.deadline && path.back().arrive > *agent.deadline)
      good = fail(Kind::too_late, path.back().arrive,
                  "arrives at its goal at tick " + std::to_string(path.back().arrive.count()) +
                      ", after its deadline at tick " + std::to_string(agent.deadline->count()));
    if (agent.under_way && path.front().depart > 0)
      good = fail(Kind::waits, path.front().arrive,
                  "stops at vertex " + std::to_string(path.front().vertex.index()) +
                      ", where it is in the middle of a move");
    for (std::size_t k = 0; k + 1 < path.size(); ++k) good &= check_move(path[k], path[k + 1]);
    return good;
  }

 private:
  bool fail(Kind kind, Ticks tick, const std::string& what) {
    violations_.push_back({kind, i_, std::nullopt, tick, agent_name(i_) + " " + what});
    return false;
  }

  bool check_stops(const Path& path) {
    Ticks now = 0;
    for (const Stop& stop : path) {
      if (stop.vertex.index() >= instance_.roadmap().num_vertices())
        return fail(Kind::bad_vertex, stop.arrive,
                    "names vertex " + std::to_string(stop.vertex.index()) + ", which is none");
      if (stop.arrive < now || stop.depart < stop.arrive || stop.depart > kMaxTick)
        return fail(Kind::bad_time, stop.arrive,
                    "arrives at vertex " + std::to_string(stop.vertex.index()) + " at tick " +
                        std::to_string(stop.arrive.count()) + " and departs at tick " +
                        std::to_string(stop.depart.count()) +
                        ": that goes back in time, or on for too long");
      now = stop.depart;
    }
    if (path.front().arrive != 0) return fail(Kind::bad_time, 0, "is nowhere at tick 0");
    if (path.back().depart != path.back().arrive)
      return fail(Kind::bad_time, path.back().depart, "departs from its last stop");
    return true;
  }

  bool check_move(const Stop& a, const Stop& b) {
    if (a.depart < instance_.agent(i_).release)
      return fail(Kind::too_early, a.depart,
                  move_name(a.vertex, b.vertex, a.depart) + ", before its release at tick " +
                      std::to_string(instance_.agent(i_).release.count()));
    bool is_adjacent = false, is_open = false;
    Ticks takes = 0;
    const ClassId c = instance_.class_of(i_);
    for (const EdgeId e : instance_.roadmap().out_edges(a.vertex)) {
      if (instance_.roadmap().edge(e).to != b.vertex) continue;
      is_adjacent = true;
      if (!instance_.roadmap().edge(e).open_to.contains(instance_.agent(i_).group)) continue;
      is_open = true;
      takes = instance_.duration(c, e);
      if (takes == b.arrive - a.depart) return true;
    }
    const std::string name = move_name(a.vertex, b.vertex, a.depart);
    if (!is_adjacent) return fail(Kind::not_adjacent, a.depart, name + ", but there is no edge");
    if (!is_open)
      return fail(Kind::closed_edge, a.depart, name + ", but that edge is not open to it");
    return fail(Kind::duration, a.depart,
                name + " and takes " + std::to_string((b.arrive - a.depart).count()) +
                    " ticks, but the edge takes " + std::to_string(takes.count()));
  }

  const Instance& instance_;
  const AgentId i_;
  std::vector<Violation>& violations_;
};

/// The path as pieces without gaps; the last one ends at `horizon`, which is after every arrival,
/// or with the path if the agent leaves.
std::vector<Piece> pieces(const Roadmap& roadmap, const Path& path, bool leaves, Ticks horizon) {
  std::vector<Piece> result;
  for (std::size_t k = 0; k < path.size(); ++k) {
    const Point at = roadmap.position(path[k].vertex);
    const bool is_last = k + 1 == path.size();
    const Ticks depart = is_last && !leaves ? horizon : path[k].depart;
    if (depart > path[k].arrive)
      result.push_back({path[k].arrive, depart, at, at, path[k].vertex, path[k].vertex});
    if (!is_last)
      result.push_back({path[k].depart, path[k + 1].arrive, at,
                        roadmap.position(path[k + 1].vertex), path[k].vertex, path[k + 1].vertex});
  }
  return result;
}

/// Where b is as seen from a, at `begin` and at `end`, in floating point.
RealStep real_step(const Piece& a, const Piece& b, Ticks begin, Ticks end) {
  const auto at = [](const Piece& p, Ticks tick, Length Point::*axis) {
    return static_cast<long double>((p.from.*axis).count()) +
           static_cast<long double>((p.to.*axis - p.from.*axis).count()) *
               static_cast<long double>((tick - p.begin).count()) /
               static_cast<long double>((p.end - p.begin).count());
  };
  const auto apart = [&](Ticks tick) {
    return RealPoint{at(b, tick, &Point::x) - at(a, tick, &Point::x),
                     at(b, tick, &Point::y) - at(a, tick, &Point::y),
                     at(b, tick, &Point::z) - at(a, tick, &Point::z)};
  };
  return {apart(begin), apart(end)};
}

/// The same, exactly: multiplied by both durations, positions are integers.
ExactStep exact_step(const Piece& a, const Piece& b, Ticks begin, Ticks end) {
  const Integer duration_a = (a.end - a.begin).count(), duration_b = (b.end - b.begin).count();
  const auto at = [](const Piece& p, Ticks tick, Length Point::*axis) -> Integer {
    return Integer((p.from.*axis).count()) * (p.end - p.begin).count() +
           Integer((p.to.*axis - p.from.*axis).count()) * (tick - p.begin).count();
  };
  const auto apart = [&](Ticks tick, Length Point::*axis) -> Integer {
    return at(b, tick, axis) * duration_a - at(a, tick, axis) * duration_b;
  };
  const auto place = [&](Ticks tick) -> ExactPoint {
    return {apart(tick, &Point::x), apart(tick, &Point::y), apart(tick, &Point::z)};
  };
  return {place(begin), place(end), duration_a * duration_b};
}

std::string describe(const Piece& piece) {
  const std::string from = "vertex " + std::to_string(piece.start.index());
  if (piece.start == piece.goal) return "stands at " + from;
  return "moves from " + from + " to vertex " + std::to_string(piece.goal.index());
}

/// Two pieces that collide, and when both last.
struct Collision {
  Piece a, b;
  Ticks begin, end;
  Clearance nearest;
};

std::string describe(AgentId i, AgentId j, const Collision& c) {
  const auto number = [](double value) {
    return std::to_string(static_cast<std::int64_t>(std::llround(value)));
  };
  const double overlap = -c.nearest.gap;
  return "agents " + std::to_string(i.index()) + " and " + std::to_string(j.index()) +
         " collide between ticks " + std::to_string(c.begin.count()) + " and " +
         std::to_string(c.end.count()) + ", while agent " + std::to_string(i.index()) + " " +
         describe(c.a) + " and agent " + std::to_string(j.index()) + " " + describe(c.b) +
         ": nearest at about tick " + number(c.nearest.tick) + ", " +
         (overlap < 1.5 ? "one length unit or less"
                        : "about " + number(overlap) + " length units") +
         " too close";
}

class PairCheck {
 public:
  PairCheck(const Body& a, const Body& b, Clearance& clearance)
      : pair_(a, b), clearance_(clearance) {
    clearance.gap = std::numeric_limits<double>::infinity();
  }

  /// The first two pieces that collide, if any do.
  std::optional<Collision> check(const std::vector<Piece>& a, const std::vector<Piece>& b) {
    std::optional<Collision> collision;
    for (std::size_t k = 0, l = 0; k < a.size() && l < b.size();) {
      const Ticks begin = std::max(a[k].begin, b[l].begin), end = std::min(a[k].end, b[l].end);
      const auto found = begin <= end ? look(a[k], b[l], begin, end) : std::nullopt;
      if (found && !collision) collision = Collision{a[k], b[l], begin, end, *found};
      if (a[k].end < b[l].end)
        ++k;
      else if (b[l].end < a[k].end)
        ++l;
      else
        ++k, ++l;
    }
    return collision;
  }

 private:
  /// How near they come, if they collide.
  std::optional<Clearance> look(const Piece& a, const Piece& b, Ticks begin, Ticks end) {
    const RealStep step = real_step(a, b, begin, end);
    const long double least = pair_.least_gap(step);
    if (least >= 1 && static_cast<double>(least) >= clearance_.gap) return std::nullopt;
    const FootprintPair::Nearest near = pair_.nearest(step);
    Clearance here = clearance_;
    here.gap = static_cast<double>(near.gap);
    here.tick = static_cast<double>(static_cast<long double>(begin.count()) +
                                    near.share * static_cast<long double>((end - begin).count()));
    if (here.gap < clearance_.gap) clearance_ = here;
    // Coordinates are below 2^42 and the rounding error of `nearest`, even where long double is
    // double, below 2^-5: those that are a whole unit apart need no exact look.
    if (near.gap >= 1 || !pair_.interiors_meet(exact_step(a, b, begin, end))) return std::nullopt;
    return here;
  }

  const FootprintPair pair_;
  Clearance& clearance_;
};

/// As pieces() of a path.
std::vector<Piece> pieces(const MovingObstacle& obstacle, Ticks horizon) {
  std::vector<Piece> result;
  for (std::size_t k = 0; k < obstacle.path.size(); ++k) {
    const MovingObstacle::Stop& stop = obstacle.path[k];
    const bool is_last = k + 1 == obstacle.path.size();
    const Ticks depart = is_last && !obstacle.leaves ? horizon : stop.depart;
    if (depart > stop.arrive)
      result.push_back({stop.arrive, depart, stop.at, stop.at, VertexId(), VertexId()});
    if (!is_last)
      result.push_back({stop.depart, obstacle.path[k + 1].arrive, stop.at, obstacle.path[k + 1].at,
                        VertexId(), VertexId()});
  }
  return result;
}

/// Collisions of agent i, whose path has these pieces, with obstacles.
void check_obstacles(const Instance& instance, AgentId i, const std::vector<Piece>& trip,
                     Ticks horizon, std::vector<Violation>& collisions) {
  for (std::size_t o = 0; o < instance.obstacles().size(); ++o) {
    const MovingObstacle& obstacle = instance.obstacles()[o];
    Clearance clearance{i, i};
    const auto found = PairCheck(instance.agent(i).body, obstacle.body, clearance)
                           .check(trip, pieces(obstacle, horizon));
    if (!found) continue;
    collisions.push_back({Kind::obstacle, i, std::nullopt, found->begin,
                          agent_name(i) + " collides with obstacle " + std::to_string(o) +
                              " between ticks " + std::to_string(found->begin.count()) + " and " +
                              std::to_string(found->end.count()) + ", while it " +
                              describe(found->a)});
  }
}

void check_pairs(const Instance& instance, const Plan& plan, const IdVector<AgentId, bool>& sound,
                 VerifyReport& report) {
  Ticks horizon = 1;
  for (const MovingObstacle& obstacle : instance.obstacles())
    horizon = std::max(horizon, obstacle.path.back().depart + 1);
  for (const AgentId i : instance.agent_ids())
    if (sound[i]) horizon = std::max(horizon, plan.paths[i].back().arrive + 1);
  IdVector<AgentId, std::vector<Piece>> trips(plan.paths.size());
  for (const AgentId i : instance.agent_ids())
    if (sound[i])
      trips[i] = pieces(instance.roadmap(), plan.paths[i], instance.agent(i).leaves, horizon);
  std::vector<Violation> collisions;
  for (const AgentId i : instance.agent_ids()) {
    check_obstacles(instance, i, trips[i], horizon, collisions);
    for (const AgentId j : instance.agent_ids()) {
      if (!(i < j && sound[i] && sound[j]) || trips[i].empty() || trips[j].empty()) continue;
      Clearance clearance{i, j};
      const auto found = PairCheck(instance.agent(i).body, instance.agent(j).body, clearance)
                             .check(trips[i], trips[j]);
      report.clearances.push_back(clearance);
      if (found)
        collisions.push_back({Kind::collision, i, j, found->begin, describe(i, j, *found)});
    }
  }
  std::stable_sort(collisions.begin(), collisions.end(),
                   [](const Violation& a, const Violation& b) { return a.tick < b.tick; });
  report.violations.insert(report.violations.end(), collisions.begin(), collisions.end());
}

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
  }
  return "";
}

VerifyReport verify(const Instance& instance, const Plan& plan) {
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
  check_pairs(instance, plan, sound, report);
  report.sum_of_costs = cost(plan, Objective::sum_of_costs);
  report.makespan = cost(plan, Objective::makespan);
  if (report.sum_of_costs == std::numeric_limits<Cost>::max())
    report.violations.push_back({Kind::bad_time, AgentId(0), std::nullopt,
                                 as_ticks(report.makespan),
                                 "the costs of all agents sum up to more than is supported"});
  return report;
}

}  // namespace quadrille::continuous
