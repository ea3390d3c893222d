// SPDX-License-Identifier: MIT
//
// Vertices where nobody may wait, and lanes that take one kind of agents another time than others:
// answers derived by hand, and random instances against two oracles.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "continuous/joint/tick_search.hpp"
#include "continuous/support/oracle_check.hpp"
#include "continuous/support/random_instance.hpp"
#include "continuous/support/roads.hpp"
#include "quadrille/continuous/second_opinion.hpp"
#include "quadrille/continuous/under_way.hpp"
#include "quadrille/continuous/verify.hpp"
#include "support/environment.hpp"

namespace quadrille::continuous::test {
namespace {

class NoWaiting : public testing::TestWithParam<Asked> {
 protected:
  [[nodiscard]] SolveOptions options() const {
    SolveOptions options;
    std::tie(options.objective, options.system) = GetParam();
    options.debug.audit = true;
    options.limits.cpu_s = 20;
    return options;
  }
  [[nodiscard]] bool is_sum() const { return std::get<0>(GetParam()) == Objective::sum_of_costs; }
  [[nodiscard]] std::uint32_t part() const {
    return 2 * static_cast<std::uint32_t>(!is_sum()) +
           static_cast<std::uint32_t>(std::get<1>(GetParam()) == System::smt_cbs);
  }
};

/// From 0 into a one-way ring 1, 2, 3, where nobody may wait, and out of it at 2 to 4. Each lane is
/// 1,000 units long and takes 10 ticks.
Instance ring(Ticks start_is_taken,
              std::vector<VertexId> no_waiting = {VertexId(1), VertexId(2), VertexId(3)}) {
  const auto lane = [](std::size_t from, std::size_t to) {
    return Edge{VertexId(from), VertexId(to), Ticks{10}};
  };
  auto map = Roadmap::make({{-1000, 0}, {0, 0}, {800, 600}, {800, -600}, {800, 1600}},
                           {lane(0, 1), lane(1, 2), lane(2, 3), lane(3, 1), lane(2, 4)}, {}, {},
                           std::move(no_waiting));
  // One is at the goal until 95, so that nobody may set out for it before 87. The other one comes
  // to the start, and it takes 2 ticks to get clear of it.
  const MovingObstacle at_goal{Disc{100}, {{{800, 1600}, 0, 95}}, true};
  const MovingObstacle at_start{Disc{100}, {{{-1000, 0}, start_is_taken, start_is_taken}}, false};
  return Instance::make(std::move(map).value(), {agent(0, 4, 100)}, {}, {}, {at_goal, at_start})
      .value();
}

TEST_P(NoWaiting, WhoMayNotWaitGoesRound) {
  const auto cost = [&](const Instance& instance) {
    const SolveOutcome outcome = solve(instance, options()).value();
    EXPECT_EQ(outcome.status, Status::optimal) << outcome.explanation;
    EXPECT_TRUE(verify(instance, *outcome.plan).valid());
    return *outcome.cost;
  };
  // At vertex 2 at 20 + d, 50 + d, 80 + d, ..., after setting out at d, which is 6 at the latest.
  EXPECT_EQ(cost(ring(8)), 120);
  EXPECT_EQ(cost(ring(9)), 97);      // 7 is late enough
  EXPECT_EQ(cost(ring(1000)), 97);   // no need for the ring
  EXPECT_EQ(cost(ring(8, {})), 97);  // waits at 2
  EXPECT_EQ(cost(ring(8, {VertexId(2)})), 97);
}

TEST_P(NoWaiting, GoesRoundAndRoundForNothing) {
  // The goal is taken for ever: whoever goes round in the ring never comes to an end.
  const Instance free = ring(8);
  std::vector<MovingObstacle> obstacles = free.obstacles();
  obstacles[0].leaves = false;
  const auto taken =
      Instance::make(free.shared_roadmap(), {free.agent(AgentId(0))}, {}, {}, std::move(obstacles));
  ASSERT_TRUE(taken) << taken.error().message;
  EXPECT_EQ(solve(*taken, options()).value().status, Status::infeasible);
}

TEST_P(NoWaiting, WhoLeavesMayDoSoThere) {
  auto map = Roadmap::make({{0, 0}, {1000, 0}, {2000, 0}},
                           {{VertexId(0), VertexId(1), {}}, {VertexId(1), VertexId(2), {}}}, {}, {},
                           {VertexId(1)})
                 .value();
  std::vector<Agent> agents{agent(0, 1, 100)};
  const auto refused = Instance::make(map, agents);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message, "agent 0 would stay at vertex 1, where nobody may wait");
  agents[0].leaves = true;
  const SolveOutcome outcome = solve(Instance::make(map, agents).value(), options()).value();
  EXPECT_EQ(outcome.cost, 1000);
  agents[0] = agent(1, 2, 100);
  EXPECT_EQ(Instance::make(map, agents).error().message,
            "agent 0 starts at vertex 1, where nobody may wait");
}

TEST_P(NoWaiting, KindsHaveTheirOwnPace) {
  const GroupId slow(1);
  Groups others;
  for (std::size_t g = 0; g < kMaxGroups; ++g)
    if (GroupId(g) != slow) others.insert(GroupId(g));
  Edge all{VertexId(0), VertexId(1), std::nullopt, others}, own = all;
  all.speed_limit = kUnitSpeed * 2;
  own.open_to = {slow};
  own.speed_limit = kUnitSpeed / 2;
  const auto map =
      std::make_shared<const Roadmap>(Roadmap::make({{0, 0}, {1000, 0}}, {all, own}).value());
  const auto cost = [&](Speed speed, GroupId group) {
    Agent one = agent(0, 1, 100, speed);
    one.group = group;
    return *solve(Instance::make(map, {one}).value(), options()).value().cost;
  };
  EXPECT_EQ(cost(kUnitSpeed, GroupId(0)), 1000);
  EXPECT_EQ(cost(kUnitSpeed * 4, GroupId(0)), 500);
  EXPECT_EQ(cost(kUnitSpeed * 4, slow), 2000);
  EXPECT_EQ(cost(kUnitSpeed / 4, slow), 4000);
}

constexpr std::size_t kMostStates = 5'000;

/// Few ticks: for the oracle that looks at each of them.
std::optional<Instance> draw(Draw& draw) {
  std::vector<Point> points;
  const auto num_vertices = static_cast<std::size_t>(draw.number(4, 7));
  for (std::size_t v = 0; v < num_vertices; ++v)
    points.push_back({draw.length(0, 7), draw.length(0, 7)});
  std::vector<Edge> edges;
  for (std::size_t v = 0; v < num_vertices; ++v)
    for (std::size_t w = 0; w < num_vertices; ++w) {
      if (v == w || points[v] == points[w] || !draw.chance(45)) continue;
      edges.push_back({VertexId(v), VertexId(w), std::nullopt});
      if (draw.chance(20)) edges.back().speed_limit = kUnitSpeed / draw.number(1, 3);
    }
  std::vector<Agent> agents;
  const auto vertex = [&] {
    return static_cast<std::size_t>(draw.number(0, static_cast<std::int64_t>(num_vertices) - 1));
  };
  for (std::int64_t k = draw.number(1, 3); k > 0; --k) {
    agents.push_back(agent(vertex(), vertex(), draw.length(1, 3)));
    if (draw.chance(15)) agents.back().release = draw.ticks(1, 6);
    if (draw.chance(15)) agents.back().deadline = draw.ticks(8, 30);
    agents.back().leaves = draw.chance(25);
  }
  std::vector<VertexId> no_waiting;
  for (const VertexId v : IdRange<VertexId>(num_vertices)) {
    bool is_needed = !draw.chance(75);
    for (const Agent& a : agents) is_needed |= a.start == v || (!a.leaves && a.goal() == v);
    if (!is_needed) no_waiting.push_back(v);
  }
  if (no_waiting.empty()) return std::nullopt;
  // Who has to leave its start early, and cannot be at its goal before long, has to spend the time
  // somewhere. Nobody vanishes at the moment at which an obstacle appears.
  std::vector<MovingObstacle> obstacles;
  const auto leaves = [](const Agent& a) { return a.leaves; };
  const bool may_appear = std::none_of(agents.begin(), agents.end(), leaves);
  for (const Agent& a : agents) {
    const Point &start = points[a.start.index()], &goal = points[a.goal().index()];
    if (draw.chance(60)) obstacles.push_back({Disc{1}, {{goal, 0, draw.ticks(5, 25)}}, true});
    const Ticks comes = draw.ticks(1, 6);
    if (may_appear && draw.chance(60))
      obstacles.push_back({Disc{1}, {{start, comes, comes + draw.ticks(5, 25)}}, true});
  }
  auto map = Roadmap::make(std::move(points), std::move(edges), {}, {}, std::move(no_waiting));
  if (!map) return std::nullopt;
  auto made =
      Instance::make(std::move(map).value(), std::move(agents), {}, {}, std::move(obstacles));
  if (!made) return std::nullopt;
  return std::move(made).value();
}

TEST_P(NoWaiting, AgreesWithTheOracleOfTicks) {
  int plans = 0, none = 0, open = 0, dearer = 0;
  std::uint32_t seed = 130'000'000 + 10'000'000 * part();
  for (std::size_t number = 0; number < support::scaled(1500);) {
    Draw random(++seed);
    const auto instance = draw(random);
    if (!instance) continue;
    ++number;
    SCOPED_TRACE("seed " + std::to_string(seed) + ": " + describe(*instance));
    SolveOptions asked = options();
    const TickSearch oracle = search_ticks(*instance, asked.objective, kMostStates);
    if (!oracle.is_complete) continue;
    asked.debug.audit = seed % 4 == 0;
    asked.limits.cpu_s.reset();
    asked.limits.conflicts = oracle.best ? 500 : 10;
    asked.limits.looks = oracle.best ? 5000 : 500;  // without plans there may be no conflicts
    const auto outcome = solve(*instance, asked);
    ASSERT_TRUE(outcome) << outcome.error().message;
    ASSERT_FALSE(outcome->internal_error) << outcome->internal_error->message;
    if (outcome->plan) {
      ASSERT_TRUE(verify(*instance, *outcome->plan).valid());
      ASSERT_EQ(find_contradiction(true, ask_fcl(*instance, *outcome->plan)), "");
    }
    if (outcome->status == Status::optimal) {
      ASSERT_TRUE(oracle.best);
      ASSERT_EQ(outcome->cost, oracle.best);
      ++plans;
      RoadmapParts parts(instance->roadmap());
      parts.no_waiting.clear();
      const auto easier = Instance::make(std::move(parts).make().value(),
                                         instance->agents().items(), {}, {}, instance->obstacles());
      const TickSearch free = search_ticks(*easier, asked.objective, kMostStates);
      dearer += free.best.value_or(*oracle.best) < *oracle.best ? 1 : 0;
    } else if (outcome->status == Status::infeasible) {
      ASSERT_FALSE(oracle.best) << outcome->explanation;
      ++none;
    } else {
      ASSERT_TRUE(!oracle.best || outcome->lower_bound <= *oracle.best);
      ++open;
    }
  }
  RecordProperty("plans", plans);
  RecordProperty("none", none);
  RecordProperty("open", open);
  RecordProperty("dearer", dearer);
  if (support::scaled(1500) < 1500) return;
  EXPECT_GE(plans, 600);
  EXPECT_GE(dearer, 8);
  EXPECT_LE(open, 300);
}

TEST_P(NoWaiting, AgreesWithTheOracleOfOrders) {
  const auto count = static_cast<std::uint32_t>(support::scaled(400));
  const std::uint32_t first = 170'000'000 + 1'000'000 * part();
  constexpr std::size_t max_moves = 4;
  Tally tally;
  int num_passed = 0;
  for (std::uint32_t seed = first; seed < first + count; ++seed) {
    RandomOptions random;
    random.num_agents = 2 + seed % 2;
    random.num_vertices = 5 + seed / 2 % 3;
    random.edge_percent = 25 + static_cast<int>(seed / 8 % 3) * 10;
    random.goal_sets_percent = seed % 7 == 0 ? 50 : 0;
    // Of more the places would need too small a unit of length.
    random.under_way_percent = seed % 10 == 0 ? 100 : 0;
    random.groups_percent = random.paces_percent = 50;
    random.leaves_percent = 30;
    random.no_waiting_percent = 100;
    const Instance instance = random_instance(seed, random);
    SCOPED_TRACE("seed " + std::to_string(seed) + ": " + describe(instance));
    SolveOptions asked = options();
    const OrderSearch oracle = search_orders(instance, asked.objective, max_moves);
    for (const Plan& plan : oracle.some_plans) {
      ASSERT_TRUE(verify(instance, plan).valid());
      ASSERT_EQ(find_contradiction(true, ask_fcl(instance, plan)), "");
    }
    asked.limits.conflicts = 3000;
    asked.limits.looks = oracle.best ? 30'000 : 500;
    asked.limits.cpu_s.reset();
    if (!oracle.some_plans.empty() && seed % 2 == 0)
      asked.debug.known_plan = oracle.some_plans[seed % oracle.some_plans.size()];
    if (!oracle.some_plans.empty() && seed % 3 == 0)
      asked.initial_plan = oracle.some_plans[seed / 3 % oracle.some_plans.size()];
    check_against(oracle, max_moves, instance, asked, tally);
    if (HasFatalFailure()) return;
    num_passed += instance.roadmap().no_waiting().empty() ? 0 : 1;
  }
  record(tally);
  RecordProperty("passed", num_passed);
  if (count < 300) return;  // scaled down, for slow builds: too few to count on chance
  EXPECT_GE(10 * num_passed, 5 * static_cast<int>(count));
  EXPECT_GE(3 * tally.solvable, static_cast<int>(count));
  EXPECT_GE(10 * tally.optimal, 6 * tally.solvable);
}

TEST_P(NoWaiting, AStopIsSeenByBothVerifiers) {
  const Instance instance = ring(1000);
  const SolveOutcome outcome = solve(instance, options()).value();
  Plan plan = *outcome.plan;
  Path& path = plan.paths[AgentId(0)];
  ASSERT_EQ(path.size(), 4U);
  // It waits at vertex 2, and not before.
  const Ticks early = path[0].depart;
  ASSERT_GT(early, Ticks(0));
  path[0].depart = 0;
  for (const std::size_t k : {1U, 2U}) path[k].arrive -= early;
  path[1].depart -= early;
  const VerifyReport report = verify(instance, plan);
  ASSERT_EQ(report.violations.size(), 1U);
  EXPECT_EQ(report.violations[0].kind, Violation::Kind::waits);
  EXPECT_NE(report.violations[0].message.find("waits at vertex 2, where nobody may"),
            std::string::npos);
  const SecondOpinion opinion = ask_fcl(instance, plan);
  EXPECT_EQ(opinion.verdict, SecondOpinion::Verdict::broken);
  EXPECT_EQ(opinion.broken.front(), "the path of agent 0 waits at vertex 2, where nobody may");
}

INSTANTIATE_TEST_SUITE_P(All, NoWaiting, all_asked(), name_of);

TEST(NoWaitingRoadmap, RefusesWhatMakesNoSense) {
  const std::vector<Point> points{{0, 0}, {1000, 0}};
  const auto message = [&](const std::vector<Edge>& edges, std::vector<VertexId> no_waiting) {
    const auto made = Roadmap::make(points, edges, {}, {}, std::move(no_waiting));
    return made ? std::string() : made.error().message;
  };
  Edge edge{VertexId(0), VertexId(1), {}};
  EXPECT_EQ(message({edge}, {VertexId(1)}), "");
  EXPECT_EQ(message({edge}, {VertexId(2)}),
            "nobody may wait at vertex 2, but there are 2 vertices");
  EXPECT_EQ(message({edge}, {VertexId(1), VertexId(1)}),
            "nobody may wait at vertex 1, but that is told twice");
  edge.speed_limit = Speed(0);
  EXPECT_EQ(message({edge}, {}), "edge 0 has a speed limit that is not supported");
  edge.speed_limit = kMaxSpeed + 1;
  EXPECT_EQ(message({edge}, {}), "edge 0 has a speed limit that is not supported");
  edge.speed_limit = kUnitSpeed;
  edge.duration = Ticks{5};
  EXPECT_EQ(message({edge}, {}), "edge 0 has a duration and a speed limit");
  RoadmapParts parts(Roadmap::make(points, {{VertexId(0), VertexId(1), {}}}).value());
  parts.no_waiting = {add_lane_place(parts, VertexId(0), VertexId(1), 1000, 300)};
  const auto on_lane = std::move(parts).make();
  ASSERT_FALSE(on_lane);
  EXPECT_EQ(on_lane.error().message,
            "nobody may wait at vertex 2, but it is in the middle of a move");
}

}  // namespace
}  // namespace quadrille::continuous::test
