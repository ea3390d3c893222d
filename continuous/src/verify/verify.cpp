// SPDX-License-Identifier: MIT
//
// On purpose this uses nothing of geometry/ but its names for integers: an independent opinion.
#include "quadrille/continuous/verify.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <utility>

#include "quadrille/continuous/quantise.hpp"
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

/// A number in few digits.
std::string number(double value, int digits) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value,
                                 std::chars_format::general, digits);
  return {text.data(), end.ptr};
}

/// A time as the input of the instance counts.
std::string time_text(const Instance& instance, Ticks ticks) {
  return number(in_input_units(ticks, instance.resolution()), 15);
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
                  "ends at vertex " + std::to_string(path.back().vertex.index()) + " at time " +
                      time(path.back().arrive) + ", but its goal is vertex " +
                      std::to_string(agent.goal.index()));
    if (agent.deadline && path.back().arrive > *agent.deadline)
      good = fail(Kind::too_late, path.back().arrive,
                  "arrives at its goal at time " + time(path.back().arrive) +
                      ", after its deadline at time " + time(*agent.deadline));
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

  [[nodiscard]] std::string time(Ticks ticks) const { return time_text(instance_, ticks); }
  [[nodiscard]] std::string move(const Stop& a, const Stop& b) const {
    return "moves from vertex " + std::to_string(a.vertex.index()) + " to vertex " +
           std::to_string(b.vertex.index()) + " at time " + time(a.depart);
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
    if (path.front().arrive != 0) good = fail(Kind::bad_time, 0, "is nowhere at time 0");
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
      if (instance_.roadmap().edge(e).to != b.vertex) continue;
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

/// Pieces, one after the other, that collide; when they last; and those two that come nearest.
struct Collision {
  Piece a, b;
  Ticks begin, end;
  Clearance nearest;
};

std::string describe(const Instance& instance, AgentId i, AgentId j, const Collision& c) {
  const Resolution& resolution = instance.resolution();
  const double overlap = -c.nearest.gap;
  return "agents " + std::to_string(i.index()) + " and " + std::to_string(j.index()) +
         " collide between times " + time_text(instance, c.begin) + " and " +
         time_text(instance, c.end) + ": nearest at about " +
         number(c.nearest.tick * resolution.time, 6) + ", while agent " +
         std::to_string(i.index()) + " " + describe(c.a) + " and agent " +
         std::to_string(j.index()) + " " + describe(c.b) + ", " +
         (overlap < 1.5 ? "at most " + number(1.5 * resolution.length, 3)
                        : "about " + number(overlap * resolution.length, 3)) +
         " too close";
}

class PairCheck {
 public:
  PairCheck(const Body& a, const Body& b, Clearance& clearance)
      : pair_(a, b), clearance_(clearance) {
    clearance.gap = std::numeric_limits<double>::infinity();
  }

  /// All collisions, in order of time.
  std::vector<Collision> check(const std::vector<Piece>& a, const std::vector<Piece>& b) {
    std::vector<Collision> collisions;
    bool goes_on = false;
    for (std::size_t k = 0, l = 0; k < a.size() && l < b.size();) {
      const Ticks begin = std::max(a[k].begin, b[l].begin), end = std::min(a[k].end, b[l].end);
      const auto found = begin <= end ? look(a[k], b[l], begin, end) : std::nullopt;
      if (found && goes_on) {
        Collision& last = collisions.back();
        if (found->gap < last.nearest.gap) last = {a[k], b[l], last.begin, end, *found};
        last.end = end;
      } else if (found) {
        collisions.push_back({a[k], b[l], begin, end, *found});
      }
      goes_on = found && pair_.interiors_meet(exact_step(a[k], b[l], end, end));
      if (a[k].end < b[l].end)
        ++k;
      else if (b[l].end < a[k].end)
        ++l;
      else
        ++k, ++l;
    }
    return collisions;
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
    PairCheck pair(instance.agent(i).body, obstacle.body, clearance);
    for (const Collision& found : pair.check(trip, pieces(obstacle, horizon)))
      collisions.push_back({Kind::obstacle, i, std::nullopt, found.begin,
                            agent_name(i) + " collides with obstacle " + std::to_string(o) +
                                " between times " + time_text(instance, found.begin) + " and " +
                                time_text(instance, found.end) + ", while it " +
                                describe(found.a)});
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
      for (const Collision& found :
           PairCheck(instance.agent(i).body, instance.agent(j).body, clearance)
               .check(trips[i], trips[j]))
        collisions.push_back({Kind::collision, i, j, found.begin, describe(instance, i, j, found),
                              found.nearest.tick});
      report.clearances.push_back(clearance);
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
