// SPDX-License-Identifier: MIT
//
// Tiny roadmaps with few ticks against the search of all joint states, tick by tick.
#include "joint/joint_search.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "continuous/joint/tick_search.hpp"
#include "continuous/support/random_instance.hpp"
#include "continuous/support/roads.hpp"
#include "quadrille/continuous/solver.hpp"
#include "quadrille/continuous/under_way.hpp"
#include "quadrille/continuous/verify.hpp"
#include "support/environment.hpp"

namespace quadrille::continuous::test {
namespace {

constexpr std::int64_t kWork = 1'000'000'000;

/// Up to three stops, at vertices or near them.
MovingObstacle tiny_obstacle(Draw& draw, const Roadmap& roadmap) {
  MovingObstacle obstacle{Disc{draw.length(1, 2)}, {}, draw.chance(60)};
  Ticks now = draw.chance(50) ? Ticks{0} : draw.ticks(1, 8);
  for (std::int64_t k = draw.number(1, 3); k > 0; --k) {
    const auto v = draw.number(0, static_cast<std::int64_t>(roadmap.num_vertices()) - 1);
    Point at = roadmap.position(VertexId(static_cast<std::size_t>(v)));
    if (draw.chance(40)) at.x += draw.length(-3, 3);
    MovingObstacle::Stop stop{at, now, now};
    if (draw.chance(50)) stop.depart += draw.ticks(1, 8);
    now = stop.depart + draw.ticks(1, 9);
    obstacle.path.push_back(stop);
  }
  if (obstacle.path.front().arrive == obstacle.path.back().depart) obstacle.leaves = false;
  return obstacle;
}

/// An agent begins in the middle of a move, and goes on at once or may wait.
void put_under_way(Draw& draw, RoadmapParts& parts, std::size_t num_edges, Agent& agent) {
  if (num_edges == 0) return;
  const Edge edge = parts.edges[static_cast<std::size_t>(
      draw.number(0, static_cast<std::int64_t>(num_edges) - 1))];
  const Ticks whole = draw.ticks(2, 6);
  const double fraction = static_cast<double>(draw.number(0, 9)) / 10;
  agent.start = add_lane_place(parts, edge.from, edge.to, whole, ticks_behind(fraction, whole));
  agent.under_way = draw.chance(60);
  agent.release = 0;
}

enum class Clock { none, all };

/// Two to four agents, `max_vertices` at most, mixed radii and speeds, one-way edges, moves of a
/// few ticks, some of other durations than their lengths say; with releases, deadlines, agents that
/// leave or are under way, and moving obstacles, if the clock is to matter.
Instance tiny_instance(std::uint32_t seed, std::int64_t max_vertices, std::int64_t max_agents,
                       Clock clock = Clock::none) {
  Draw draw(seed), more(seed + 77), last(seed + 777);
  while (true) {
    const bool has_groups = more.chance(25);
    const auto group = [&] { return GroupId(static_cast<std::size_t>(more.number(0, 1))); };
    const Length size = draw.length(3, 9);
    const bool is_grid = draw.chance(30);
    const int density = static_cast<int>(draw.number(25, 60));
    const int one_way = draw.chance(50) ? 10 : 40;
    std::vector<Point> points;
    const auto num_vertices = draw.number(3, max_vertices);
    for (std::int64_t v = 0; v < num_vertices; ++v)
      points.push_back(is_grid ? Point{3 * draw.length(0, 3), 3 * draw.length(0, 3)}
                               : Point{draw.length(0, size), draw.length(0, size)});
    std::vector<Edge> edges;
    for (std::size_t u = 0; u < points.size(); ++u)
      for (std::size_t v = u + 1; v < points.size(); ++v) {
        if (!draw.chance(density)) continue;
        const auto duration = [&] {
          return draw.chance(30) ? std::optional<Ticks>(draw.number(1, 6)) : std::nullopt;
        };
        if (!draw.chance(one_way / 2)) edges.push_back({VertexId(u), VertexId(v), duration()});
        if (!draw.chance(one_way)) edges.push_back({VertexId(v), VertexId(u), duration()});
      }
    if (has_groups)
      for (Edge& edge : edges)
        if (more.chance(20)) edge.open_to = {group()};
    std::vector<Agent> agents;
    const auto num_agents = draw.number(2, max_agents);
    const auto vertex = [&] { return static_cast<std::size_t>(draw.number(0, num_vertices - 1)); };
    for (std::int64_t k = 0; k < num_agents; ++k) {
      const std::size_t start = vertex(), goal = draw.chance(25) ? start : vertex();
      agents.push_back(agent(start, goal, draw.length(1, 2),
                             draw.chance(60) ? kUnitSpeed : kUnitSpeed * draw.number(1, 6) / 3));
    }
    if (has_groups)
      for (Agent& a : agents) a.group = group();
    std::vector<MovingObstacle> obstacles;
    RoadmapParts parts;
    parts.vertices = points;
    parts.edges = edges;
    if (clock == Clock::all) {
      for (Agent& a : agents) {
        if (last.chance(25)) a.release = last.ticks(1, 9);
        if (last.chance(25)) a.deadline = a.release + last.ticks(3, 25);
        a.leaves = last.chance(15);
        if (last.chance(20)) put_under_way(last, parts, edges.size(), a);
      }
    }
    auto roadmap = std::move(parts).make();
    if (!roadmap) continue;
    if (clock == Clock::all && last.chance(60))
      for (std::int64_t k = last.number(1, 2); k > 0; --k)
        obstacles.push_back(tiny_obstacle(last, *roadmap));
    auto instance =
        Instance::make(std::move(roadmap).value(), std::move(agents), {}, {}, std::move(obstacles));
    if (instance) return std::move(instance).value();
  }
}

struct Answers {
  int plans = 0, none = 0, unknown = 0;
};

void check_cheapest(const Instance& instance, Objective objective, Answers& answers) {
  const TickSearch oracle = search_ticks(instance, objective, 20'000);
  LimitMonitor limits({});
  Scene scene(instance, limits);
  std::vector<AgentId> agents;
  for (const AgentId i : instance.agent_ids()) agents.push_back(i);
  std::int64_t work = kWork;
  const JointReport some = find_joint_plan(scene, agents, JointRules::all, work);
  ASSERT_NE(some.end, JointReport::End::stopped);
  const JointReport best = find_cheapest_joint_plan(scene, agents, objective, {}, work);
  ASSERT_EQ(best.end, some.end);
  if (some.end == JointReport::End::exhausted) {
    ++answers.none;
    ASSERT_FALSE(oracle.best);
    return;
  }
  ++answers.plans;
  for (const JointReport& report : {some, best}) {
    const Plan plan{IdVector<AgentId, Path>(report.paths)};
    ASSERT_TRUE(verify(instance, plan).valid());
    ASSERT_GE(cost(plan, objective), best.lower_bound);
  }
  const Cost least = cost(Plan{IdVector<AgentId, Path>(best.paths)}, objective);
  ASSERT_EQ(least, best.lower_bound);
  if (!oracle.is_complete) {
    ++answers.unknown;
    return;
  }
  ASSERT_TRUE(oracle.best);
  ASSERT_EQ(least, *oracle.best);
  // Nothing is below the least, and bounds hold wherever the work ends.
  work = kWork;
  ASSERT_EQ(find_cheapest_joint_plan(scene, agents, objective, least, work).end,
            JointReport::End::exhausted);
  for (work = 100; work < 1'000'000;) {
    std::int64_t left = work;
    const JointReport report = find_cheapest_joint_plan(scene, agents, objective, {}, left);
    ASSERT_LE(report.lower_bound, least);
    if (report.end != JointReport::End::stopped) break;
    work *= 4;
  }
}

class JointRandom : public testing::TestWithParam<std::tuple<Objective, Clock, std::uint32_t>> {};

TEST_P(JointRandom, AgreesWithTheTicks) {
  const auto [objective, clock, shard] = GetParam();
  const auto count = static_cast<std::uint32_t>(support::scaled(500));
  Answers answers;
  for (std::uint32_t n = 0; n < count; ++n) {
    const std::uint32_t seed = shard * 1'000'000 + n;
    const Instance instance = tiny_instance(seed, 6, 3, clock);
    SCOPED_TRACE("seed " + std::to_string(seed) + ": " + describe(instance));
    check_cheapest(instance, objective, answers);
    if (HasFatalFailure()) return;
  }
  RecordProperty("plans", answers.plans);
  RecordProperty("none", answers.none);
  RecordProperty("unknown", answers.unknown);
  if (count < 500) return;  // scaled down, for slow builds: too few to count on chance
  EXPECT_GT(10 * answers.plans, static_cast<int>(count));
  EXPECT_GT(10 * answers.none, static_cast<int>(count));
  EXPECT_LT(10 * answers.unknown, static_cast<int>(count));
}

std::string name_of(Objective objective, Clock clock) {
  return std::string(objective == Objective::makespan ? "Makespan" : "SumOfCosts") +
         (clock == Clock::all ? "Clock" : "");
}
std::string name_of_shard(const testing::TestParamInfo<JointRandom::ParamType>& param) {
  const auto [objective, clock, shard] = param.param;
  return name_of(objective, clock) + std::to_string(shard);
}

INSTANTIATE_TEST_SUITE_P(
    All, JointRandom,
    testing::Combine(testing::Values(Objective::sum_of_costs, Objective::makespan),
                     testing::Values(Clock::none, Clock::all), testing::Values(1U, 2U)),
    name_of_shard);

// What is asked of the program as a whole: a proof or a refutation, each time.
class TinyRandom : public testing::TestWithParam<std::tuple<Objective, Clock, System>> {};

TEST_P(TinyRandom, IsSolvedOrRefuted) {
  const auto count = static_cast<std::uint32_t>(support::scaled(1000));
  const auto [objective, clock, system] = GetParam();
  const std::uint32_t first = objective == Objective::makespan ? 30'000'000 : 40'000'000;
  Answers answers;
  for (std::uint32_t seed = first; seed < first + count; ++seed) {
    const Instance instance = tiny_instance(seed, 9, 4, clock);
    SCOPED_TRACE("seed " + std::to_string(seed) + ": " + describe(instance));
    SolveOptions options;
    options.objective = objective;
    options.system = system;
    options.limits.cpu_s = 20;  // Measured: 1.6 at most.
    const SolveOutcome outcome = solve(instance, options).value();
    ASSERT_FALSE(outcome.internal_error) << outcome.internal_error->message;
    ASSERT_TRUE(outcome.status == Status::optimal || outcome.status == Status::infeasible)
        << to_string(outcome.status);
    ++(outcome.plan ? answers.plans : answers.none);
  }
  if (count < 1000) return;
  EXPECT_GT(10 * answers.plans, static_cast<int>(count));
  EXPECT_GT(10 * answers.none, static_cast<int>(count));
}

std::string name_of_system(const testing::TestParamInfo<TinyRandom::ParamType>& param) {
  const auto [objective, clock, system] = param.param;
  return name_of(objective, clock) + (system == System::dpll ? "Dpll" : "SmtCbs");
}

INSTANTIATE_TEST_SUITE_P(
    All, TinyRandom,
    testing::Values(std::tuple(Objective::sum_of_costs, Clock::none, System::dpll),
                    std::tuple(Objective::makespan, Clock::none, System::smt_cbs),
                    std::tuple(Objective::sum_of_costs, Clock::all, System::smt_cbs),
                    std::tuple(Objective::makespan, Clock::all, System::dpll)),
    name_of_system);

/// So many copies of the instance, far from each other, and somebody who stands beside them.
Instance copies_of(const Instance& instance, std::size_t count) {
  constexpr std::int64_t apart = 1000;
  RoadmapParts parts;
  std::vector<Agent> agents;
  std::vector<MovingObstacle> obstacles;
  for (std::size_t copy = 0; copy < count; ++copy) {
    const std::size_t first = parts.vertices.size();
    const Length by(apart * static_cast<std::int64_t>(copy));
    const auto moved = [&](VertexId v) { return VertexId(first + v.index()); };
    for (Point point : instance.roadmap().positions()) {
      point.x += by;
      parts.vertices.push_back(point);
    }
    const std::vector<ShapeId>& shapes = instance.roadmap().shapes();
    parts.shapes.insert(parts.shapes.end(), shapes.begin(), shapes.end());
    for (Edge edge : instance.roadmap().edges()) {
      edge.from = moved(edge.from);
      edge.to = moved(edge.to);
      parts.edges.push_back(edge);
    }
    for (const LanePlace& place : instance.roadmap().lane_places())
      parts.lane_places.push_back(
          {moved(place.vertex), moved(place.from), moved(place.to), place.behind, place.whole});
    for (Agent agent : instance.agents()) {
      agent.start = moved(agent.start);
      agent.goals = moved(agent.goal());
      agents.push_back(agent);
    }
    for (MovingObstacle obstacle : instance.obstacles()) {
      for (MovingObstacle::Stop& stop : obstacle.path) stop.at.x += by;
      obstacles.push_back(obstacle);
    }
  }
  const std::size_t beside = parts.vertices.size();
  parts.vertices.push_back({Length(-apart), 0});
  if (!parts.shapes.empty()) parts.shapes.emplace_back();
  agents.insert(agents.begin(), agent(beside, beside, 1));
  return Instance::make(std::move(parts).make().value(), std::move(agents), {}, {},
                        std::move(obstacles))
      .value();
}

// Each alone is decided, and so all together, in as many times the time.
TEST(TinyCopies, AreSolvedOneByOne) {
  const auto count = static_cast<std::uint32_t>(support::scaled(150));
  Answers answers;
  for (std::uint32_t seed = 0; seed < count; ++seed) {
    const Instance one =
        tiny_instance(60'000'000 + seed, 9, 4, seed % 2 == 0 ? Clock::none : Clock::all);
    SCOPED_TRACE("seed " + std::to_string(seed) + ": " + describe(one));
    const std::size_t copies = 2 + seed % 2;
    const Instance all = copies_of(one, copies);
    SolveOptions options;
    options.objective = seed / 2 % 2 == 0 ? Objective::sum_of_costs : Objective::makespan;
    options.limits.cpu_s = 20;
    const SolveOutcome of_one = solve(one, options).value(), of_all = solve(all, options).value();
    ASSERT_EQ(of_all.status, of_one.status);
    ++(of_one.plan ? answers.plans : answers.none);
    if (!of_one.plan) continue;
    ASSERT_EQ(of_one.status, Status::optimal);
    const bool is_sum = options.objective == Objective::sum_of_costs;
    ASSERT_EQ(*of_all.cost, *of_one.cost * static_cast<Cost>(is_sum ? copies : 1));
  }
  EXPECT_GT(answers.plans, 0);
  EXPECT_GT(answers.none, 0);
}

}  // namespace
}  // namespace quadrille::continuous::test
