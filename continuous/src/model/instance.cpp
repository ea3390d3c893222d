// SPDX-License-Identifier: MIT
#include "quadrille/continuous/instance.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include "model/body_numbers.hpp"
#include "model/obstacle_leg.hpp"
#include "model/place_of_rest.hpp"
#include "model/reachability.hpp"
#include "model/shapes.hpp"
#include "quadrille/continuous/free_cost.hpp"
#include "quadrille/continuous/quantise.hpp"
#include "quadrille/core/decimal.hpp"
#include "quadrille/geometry/body_index.hpp"
#include "quadrille/geometry/body_pair.hpp"

namespace quadrille::continuous {
namespace {

std::string name(std::size_t agent) { return "agent " + std::to_string(agent); }

Error invalid(const std::string& message) { return {ErrorCode::invalid_instance, message, {}}; }
Error no_plan(const std::string& message) { return {ErrorCode::no_plan, message, {}}; }

bool are_flat(const Roadmap& roadmap, const std::vector<MovingObstacle>& obstacles) {
  const auto is_flat = [](const MovingObstacle::Stop& stop) { return stop.at.z == 0; };
  return roadmap.is_flat() &&
         std::all_of(obstacles.begin(), obstacles.end(), [&](const MovingObstacle& obstacle) {
           return std::all_of(obstacle.path.begin(), obstacle.path.end(), is_flat);
         });
}

/// Polygons stay in the plane.
std::optional<Error> check_flat(const Body& body, const std::string& who) {
  if (std::holds_alternative<Disc>(body)) return std::nullopt;
  return invalid(who + " is a polygon, but there are places with a height: in space bodies are " +
                 "spheres");
}

std::optional<Error> check(const Roadmap& roadmap, const std::vector<Agent>& agents,
                           std::size_t index) {
  const Agent& agent = agents[index];
  const auto check_vertex = [&](VertexId v) -> std::optional<Error> {
    if (v.index() < roadmap.num_vertices()) return std::nullopt;
    return invalid(name(index) + " names vertex " + std::to_string(v.index()) + ", but there are " +
                   std::to_string(roadmap.num_vertices()) + " vertices");
  };
  if (auto error = check_vertex(agent.start)) return error;
  if (agent.goals.size() == 0) return invalid(name(index) + " has no goal");
  for (const VertexId v : agent.goals.vertices())
    if (auto error = check_vertex(v)) return error;
  if (!roadmap.may_wait(agent.start))
    return invalid(name(index) + " starts at vertex " + std::to_string(agent.start.index()) +
                   ", where nobody may wait");
  for (const VertexId v : agent.goals.vertices())
    if (!agent.leaves && !roadmap.may_wait(v))
      return invalid(name(index) + " would stay at vertex " + std::to_string(v.index()) +
                     ", where nobody may wait");
  const Length reach = reach_of(agent);
  if (reach < 1 || reach > geometry::kMaxLength)
    return Error{ErrorCode::out_of_range,
                 name(index) + " has a radius of " + std::to_string(reach.value()) +
                     " length units, not 1 .. " + std::to_string(geometry::kMaxLength.value()),
                 {}};
  if (auto wrong = find_wrong_shape(roadmap, agent)) return invalid(name(index) + *wrong);
  if (agent.speed < 1 || agent.speed > kMaxSpeed)
    return Error{
        ErrorCode::out_of_range,
        name(index) + " has a speed outside (0, " + std::to_string(kMaxSpeed / kUnitSpeed) + "]",
        {}};
  if (agent.group.index() >= kMaxGroups)
    return Error{ErrorCode::out_of_range,
                 name(index) + " is of group " + std::to_string(agent.group.index()) +
                     ", not 0 .. " + std::to_string(kMaxGroups - 1),
                 {}};
  const auto out_of_range = [&](const std::string& what, Ticks tick) {
    return Error{ErrorCode::out_of_range,
                 name(index) + what + std::to_string(tick.value()) + ", not 0 .. " +
                     std::to_string(geometry::kMaxDuration.value()),
                 {}};
  };
  const auto is_good = [](Ticks tick) { return 0 <= tick && tick <= geometry::kMaxDuration; };
  if (!is_good(agent.release)) return out_of_range(" is released at tick ", agent.release);
  if (agent.deadline && !is_good(*agent.deadline))
    return out_of_range(" has its deadline at tick ", *agent.deadline);
  return std::nullopt;
}

/// Nobody else may be where an agent is in the middle of a move, and it goes on one way.
std::optional<Error> check_under_way(const Roadmap& roadmap, const Agent& agent, std::size_t index,
                                     Ticks now) {
  if (!agent.under_way) return std::nullopt;
  const auto out = roadmap.out_edges(agent.start);
  if (!roadmap.in_edges(agent.start).empty() || out.size() != 1 ||
      !roadmap.edge(out.front()).open_to.contains(agent.group) || agent.goals.contains(agent.start))
    return invalid(name(index) + " is under way at vertex " + std::to_string(agent.start.index()) +
                   ", to which no edge may lead, and from which one has to lead on");
  if (agent.release > now)
    return invalid(name(index) + " is under way, and cannot be released later");
  if (agent.overlaps_at_start)
    return invalid(name(index) + " is under way, and cannot overlap with others at its start");
  return std::nullopt;
}

/// An agent that overlaps an earlier one when each is where it has to be. `place_of(agent)`: null
/// if it need not be anywhere. `may_overlap(agent)`: with others that may.
template <class PlaceOf, class MayOverlap>
std::optional<Error> check_apart(const Roadmap& roadmap, const std::vector<Agent>& agents,
                                 const PlaceOf& place_of, const MayOverlap& may_overlap,
                                 const std::string& what, std::size_t& at) {
  geometry::BodyIndex strict, lenient;
  for (std::size_t j = 0; j < agents.size(); ++j) {
    const VertexId* const place = place_of(agents[j]);
    if (place == nullptr) continue;
    const geometry::Place here = roadmap.place(*place);
    const Body& body = body_at(roadmap, agents[j], *place);
    auto i = strict.first_overlap(body, here);
    if (!i && !may_overlap(agents[j])) i = lenient.first_overlap(body, here);
    if (i) {
      at = j;
      return no_plan("the " + what + " of agents " + std::to_string(*i) + " and " +
                     std::to_string(j) + " overlap");
    }
    (may_overlap(agents[j]) ? lenient : strict).add(j, body, here);
  }
  return std::nullopt;
}

/// See Instance::parked_pairs. Quadratic in the number of agents that may overlap.
std::vector<std::pair<AgentId, AgentId>> find_parked_pairs(const Roadmap& roadmap,
                                                           const std::vector<Agent>& agents) {
  std::vector<std::size_t> lenient;
  for (std::size_t i = 0; i < agents.size(); ++i)
    if (agents[i].overlaps_at_start) lenient.push_back(i);
  std::vector<std::pair<AgentId, AgentId>> pairs;
  for (std::size_t k = 0; k < lenient.size(); ++k)
    for (std::size_t l = k + 1; l < lenient.size(); ++l) {
      const Agent &a = agents[lenient[k]], &b = agents[lenient[l]];
      if (geometry::bodies_overlap(body_at(roadmap, a, a.start), roadmap.place(a.start),
                                   body_at(roadmap, b, b.start), roadmap.place(b.start)))
        pairs.emplace_back(AgentId(lenient[k]), AgentId(lenient[l]));
    }
  return pairs;
}

std::optional<Error> check_reachable(const Roadmap& roadmap, const std::vector<Agent>& agents,
                                     std::size_t& at) {
  std::map<GroupId, Reachability> by_group;
  for (at = 0; at < agents.size(); ++at) {
    const Agent& agent = agents[at];
    const auto found = by_group.try_emplace(agent.group, roadmap, agent.group).first;
    const auto goals = agent.goals.vertices();
    const bool leads = std::any_of(goals.begin(), goals.end(), [&](VertexId goal) {
      return found->second.leads(agent.start, goal);
    });
    if (leads) continue;
    const std::string from = "there is no way from vertex " + std::to_string(agent.start.index());
    return no_plan(agent.goals.is_single()
                       ? name(at) + " cannot reach its goal: " + from + " to vertex " +
                             std::to_string(agent.goal().index())
                       : name(at) + " can reach none of its goals: " + from + " to them");
  }
  return std::nullopt;
}

std::optional<Error> check_obstacle(const MovingObstacle& obstacle, std::size_t index) {
  const std::string who = "obstacle " + std::to_string(index);
  const Length reach = geometry::enclosing_radius(obstacle.body);
  if (reach < 1 || reach > geometry::kMaxLength)
    return Error{ErrorCode::out_of_range, who + " has a radius that is not supported", {}};
  if (obstacle.path.empty()) return invalid(who + " has no stops");
  Ticks now = 0;
  for (const MovingObstacle::Stop& stop : obstacle.path) {
    if (!geometry::in_range(stop.at) || stop.arrive < 0 || stop.depart > geometry::kMaxDuration)
      return Error{ErrorCode::out_of_range, who + " has a place or a time out of range", {}};
    const bool is_first = &stop == &obstacle.path.front();
    const Ticks least = is_first ? Ticks{0} : now + 1;
    if (stop.depart < stop.arrive || stop.arrive < least)
      return invalid(who + " has times that do not increase");
    now = stop.depart;
  }
  if (obstacle.leaves && obstacle.path.front().arrive == now)
    return invalid(who + " vanishes at the moment at which it appears");
  return std::nullopt;
}

/// The first agent at whose start an obstacle is at `now`.
std::optional<std::size_t> find_blocked(const Roadmap& roadmap, const std::vector<Agent>& agents,
                                        const geometry::BodyIndex& starts,
                                        const MovingObstacle& obstacle, Ticks now) {
  const auto leg = leg_at(obstacle, now);
  if (!leg) return std::nullopt;
  if (!leg->is_moving) return starts.first_overlap(obstacle.body, obstacle.path[leg->stop].at);
  for (std::size_t i = 0; i < agents.size(); ++i)
    if (is_in_the_way(obstacle, now, body_at(roadmap, agents[i], agents[i].start),
                      roadmap.place(agents[i].start)))
      return i;
  return std::nullopt;
}

/// `is_new`: each obstacle is to be looked at alone, too.
std::optional<Error> check_obstacles(const Roadmap& roadmap, const std::vector<Agent>& agents,
                                     const std::vector<MovingObstacle>& obstacles, bool is_flat,
                                     Ticks now, bool is_new) {
  geometry::BodyIndex starts;
  for (std::size_t i = 0; !obstacles.empty() && i < agents.size(); ++i)
    starts.add(i, body_at(roadmap, agents[i], agents[i].start), roadmap.place(agents[i].start));
  for (std::size_t o = 0; o < obstacles.size(); ++o) {
    if (is_new)
      if (auto error = check_obstacle(obstacles[o], o)) return error;
    if (!is_flat)
      if (auto error = check_flat(obstacles[o].body, "obstacle " + std::to_string(o))) return error;
    if (const auto i = find_blocked(roadmap, agents, starts, obstacles[o], now))
      return no_plan("obstacle " + std::to_string(o) + " is at the start of " + name(*i));
  }
  return std::nullopt;
}

std::optional<Error> refuse_now(Ticks now) {
  if (0 <= now && now <= geometry::kMaxDuration) return std::nullopt;
  return Error{ErrorCode::out_of_range,
               "the instance begins at tick " + std::to_string(now.value()) + ", not 0 .. " +
                   std::to_string(geometry::kMaxDuration.value()),
               {}};
}

/// What is wrong with the agents; then `at` is the one to blame.
std::optional<Error> check_all(const Roadmap& roadmap, const std::vector<Agent>& agents,
                               bool is_flat, Ticks now, std::size_t& at) {
  for (at = 0; at < agents.size(); ++at) {
    if (auto error = check(roadmap, agents, at)) return error;
    if (!is_flat)
      for (const Body& body : bodies_of(agents[at]))
        if (auto error = check_flat(body, name(at))) return error;
    if (auto error = check_under_way(roadmap, agents[at], at, now)) return error;
  }
  const auto start = [](const Agent& agent) { return &agent.start; };
  const auto parks = [](const Agent& agent) { return agent.overlaps_at_start; };
  const auto never = [](const Agent&) { return false; };
  if (auto error = check_apart(roadmap, agents, start, parks, "starts", at)) return error;
  if (auto error = check_apart(roadmap, agents, place_of_rest, never, "goals", at)) return error;
  return check_reachable(roadmap, agents, at);
}

/// An agent with a deadline that is too early, however free its way is.
std::optional<Error> check_deadlines(const Instance& instance, std::size_t& at) {
  for (const AgentId i : instance.agent_ids()) {
    const Agent& agent = instance.agent(i);
    if (!agent.deadline) continue;
    const Ticks arrival = instance.now() + free_cost(instance, i).value();
    if (arrival <= *agent.deadline) continue;
    at = i.index();
    const auto when = [&](Ticks time) {
      return decimal(in_input_units(time, instance.resolution()));
    };
    return no_plan(name(at) + " cannot arrive before " + when(arrival) + ", and its deadline is " +
                   when(*agent.deadline));
  }
  return std::nullopt;
}

bool is_all_open(const Roadmap& roadmap, GroupId group) {
  return std::all_of(roadmap.edges().begin(), roadmap.edges().end(),
                     [&](const Edge& edge) { return edge.open_to.contains(group); });
}

/// `agent`: somebody of this speed.
Result<std::vector<Ticks>> durations_at(const Roadmap& roadmap, Speed speed, std::size_t agent) {
  std::vector<Ticks> durations;
  durations.reserve(roadmap.num_edges());
  for (std::size_t e = 0; e < roadmap.num_edges(); ++e) {
    const Edge& edge = roadmap.edge(EdgeId(e));
    const auto ticks = travel_time(roadmap, edge, speed);
    if (!ticks)
      return Error{ErrorCode::out_of_range,
                   "edge " + std::to_string(e) + " takes less than one tick, or more than " +
                       std::to_string(geometry::kMaxDuration.value()) + ", at the speed of agent " +
                       std::to_string(agent) + "; choose another resolution",
                   {}};
    durations.push_back(*ticks);
  }
  return durations;
}

/// From the begin of an edge to a place in its middle, along an axis, at most.
Length longest_way_behind(const Roadmap& roadmap) {
  Length most = 0;
  for (const LanePlace& lane : roadmap.lane_places()) {
    const Point &from = roadmap.position(lane.from), &at = roadmap.position(lane.vertex);
    for (Length Point::*axis : {&Point::x, &Point::y, &Point::z})
      most = std::max(most, std::max(at.*axis - from.*axis, from.*axis - at.*axis) + 1);
  }
  return most;
}

}  // namespace

Result<Instance> Instance::make(std::shared_ptr<const Roadmap> roadmap, std::vector<Agent> agents,
                                Resolution resolution, std::span<const SourcePlace> places,
                                std::vector<MovingObstacle> obstacles, Ticks now) {
  return build(std::move(roadmap), std::move(agents), resolution, places, std::move(obstacles), now,
               true);
}

Result<Instance> Instance::make(Roadmap roadmap, std::vector<Agent> agents, Resolution resolution,
                                std::span<const SourcePlace> places,
                                std::vector<MovingObstacle> obstacles, Ticks now) {
  return make(std::make_shared<const Roadmap>(std::move(roadmap)), std::move(agents), resolution,
              places, std::move(obstacles), now);
}

Result<Instance> Instance::with_agents(std::vector<Agent> agents) const {
  auto made = build(roadmap_, std::move(agents), resolution_, {}, obstacles_, now_, false);
  if (made && has_whole_moves_) return made->with_whole_moves();
  return made;
}

Instance Instance::with_whole_moves(bool whole) const {
  Instance same = *this;
  same.has_whole_moves_ = whole;
  const Length behind = whole ? longest_way_behind(*roadmap_) : Length(0);
  for (Class& c : same.classes_) c.reach = c.body_reach + behind;
  return same;
}

Result<Instance> Instance::build(std::shared_ptr<const Roadmap> roadmap, std::vector<Agent> agents,
                                 Resolution resolution, std::span<const SourcePlace> places,
                                 std::vector<MovingObstacle> obstacles, Ticks now,
                                 bool has_new_obstacles) {
  QUADRILLE_REQUIRE(roadmap != nullptr, "an instance has a roadmap");
  QUADRILLE_REQUIRE(places.empty() || places.size() == agents.size(), "one place per agent");
  if (!resolution.is_valid())
    return Error{ErrorCode::out_of_range, "the resolution has to be positive and finite", {}};
  if (auto error = refuse_now(now)) return *error;
  const bool is_flat = are_flat(*roadmap, obstacles);
  std::size_t at = 0;
  if (auto error = check_all(*roadmap, agents, is_flat, now, at)) {
    if (!places.empty()) error->where = places[at];
    return *error;
  }

  if (auto error = check_obstacles(*roadmap, agents, obstacles, is_flat, now, has_new_obstacles))
    return *error;

  Instance instance;
  instance.now_ = now;
  instance.is_flat_ = is_flat;
  const Length rounding = roadmap->lane_places().empty() ? Length(0) : Length(1);
  std::map<Speed, std::size_t> speeds;
  std::map<std::tuple<std::vector<Length>, Speed, std::size_t>, ClassId> classes;
  std::map<GroupId, std::shared_ptr<const Ways>> ways;  // null: all edges
  for (std::size_t i = 0; i < agents.size(); ++i) {
    const Agent& agent = agents[i];
    const auto [speed, is_new] = speeds.try_emplace(agent.speed, instance.durations_.size());
    if (is_new) {
      auto durations = durations_at(*roadmap, agent.speed, i);
      if (!durations) {
        Error error = durations.error();
        if (!places.empty()) error.where = places[i];
        return error;
      }
      instance.durations_.push_back(std::move(durations).value());
    }
    const auto [open, is_new_group] = ways.try_emplace(agent.group);
    if (is_new_group && !is_all_open(*roadmap, agent.group))
      open->second = std::make_shared<const Ways>(
          Ways{EdgeLists(roadmap->num_vertices(), roadmap->edges(), &Edge::from, agent.group),
               EdgeLists(roadmap->num_vertices(), roadmap->edges(), &Edge::to, agent.group)});
    // All to whom every edge is open are alike.
    const std::size_t group = open->second == nullptr ? kMaxGroups : agent.group.index();
    const auto key = std::make_tuple(numbers_of(agent), agent.speed, group);
    const auto [known, is_new_class] = classes.try_emplace(key, instance.classes_.next_id());
    if (is_new_class)
      instance.classes_.push_back({bodies_of(agent), reach_of(agent) + rounding,
                                   reach_of(agent) + rounding, agent.speed, speed->second,
                                   agent.group, open->second});
    instance.has_shapes_ = instance.has_shapes_ || !agent.shapes.empty();
    instance.class_of_.push_back(known->second);
  }
  instance.parked_pairs_ = find_parked_pairs(*roadmap, agents);
  instance.roadmap_ = std::move(roadmap);
  instance.has_goal_sets_ = std::any_of(
      agents.begin(), agents.end(), [](const Agent& agent) { return !agent.goals.is_single(); });
  instance.agents_ = IdVector<AgentId, Agent>(std::move(agents));
  instance.resolution_ = resolution;
  instance.obstacles_ = std::move(obstacles);
  if (auto error = check_deadlines(instance, at)) {
    if (!places.empty()) error->where = places[at];
    return *error;
  }
  return instance;
}

}  // namespace quadrille::continuous
