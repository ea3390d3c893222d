// SPDX-License-Identifier: MIT
// Agents that may end at any one of several goals, against an oracle that knows all routes, and
// against all choices of one goal each.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "continuous/support/oracle_check.hpp"
#include "continuous/support/random_instance.hpp"
#include "continuous/support/roads.hpp"
#include "quadrille/continuous/solver.hpp"
#include "quadrille/continuous/verify.hpp"
#include "support/environment.hpp"

namespace quadrille::continuous::test {
namespace {

RandomOptions with_sets(std::uint32_t seed) {
  RandomOptions random;
  random.num_agents = 2 + seed % 2;
  random.num_vertices = 4 + seed / 2 % 4;
  random.edge_percent = 30 + static_cast<int>(seed / 8 % 3) * 15;
  random.polygon_percent = 30;
  random.goal_sets_percent = 70;
  return random;
}

class GoalSets : public testing::TestWithParam<Asked> {};

TEST_P(GoalSets, AgreeWithTheOracle) {
  const auto [objective, system] = GetParam();
  const auto count = static_cast<std::uint32_t>(support::scaled(400));
  const std::uint32_t part = 2 * static_cast<std::uint32_t>(objective == Objective::makespan) +
                             static_cast<std::uint32_t>(system == System::smt_cbs);
  const std::uint32_t first = 20'000'000 + part * 1'000'000;
  constexpr std::size_t max_moves = 4;
  Tally tally;
  for (std::uint32_t seed = first; seed < first + count; ++seed) {
    const Instance instance = random_instance(seed, with_sets(seed));
    SCOPED_TRACE("seed " + std::to_string(seed) + ": " + describe(instance));
    const OrderSearch oracle = search_orders(instance, objective, max_moves);
    SolveOptions options;
    options.objective = objective;
    options.system = system;
    options.limits.conflicts = 3000;
    options.joint_work = seed % 4 == 0 ? SolveOptions().joint_work : 0;
    options.limits.cpu_s = oracle.best ? 2 : 0.1;
    options.debug.audit = true;
    options.explain = seed % 3 == 0;
    if (!oracle.some_plans.empty() && seed % 2 == 0)
      options.debug.known_plan = oracle.some_plans[seed % oracle.some_plans.size()];
    check_against(oracle, max_moves, instance, options, tally);
    if (HasFatalFailure()) return;
  }
  record(tally);
  if (count < 200) return;  // scaled down, for slow builds: too few to count on chance
  EXPECT_GE(2 * tally.solvable, static_cast<int>(count));
  EXPECT_GE(10 * tally.optimal, 8 * tally.solvable);
}

INSTANTIATE_TEST_SUITE_P(All, GoalSets, all_asked(), name_of);

/// The agents of an instance with one goal each; nullopt where that is no instance.
std::optional<Instance> with_goals(const Instance& instance, const std::vector<VertexId>& goals) {
  std::vector<Agent> agents;
  for (const AgentId i : instance.agent_ids()) {
    agents.push_back(instance.agent(i));
    agents.back().goals = goals[i.index()];
  }
  auto made = Instance::make(instance.shared_roadmap(), std::move(agents), instance.resolution(),
                             {}, instance.obstacles());
  if (!made) return std::nullopt;
  return std::move(made).value();
}

std::vector<std::vector<VertexId>> choices(const Instance& instance) {
  std::vector<std::vector<VertexId>> all{{}};
  for (const Agent& agent : instance.agents()) {
    std::vector<std::vector<VertexId>> longer;
    for (const auto& choice : all)
      for (const VertexId goal : agent.goals.vertices()) {
        longer.push_back(choice);
        longer.back().push_back(goal);
      }
    all = std::move(longer);
  }
  return all;
}

// With roads that are long, obstacles, and agents that begin in the middle of a move.
TEST(GoalSetsByChoice, CostAsMuchAsTheCheapestChoice) {
  const auto count = static_cast<std::uint32_t>(support::scaled(300));
  int num_compared = 0, num_infeasible = 0;
  for (std::uint32_t seed = 30'000'000; seed < 30'000'000 + count; ++seed) {
    RandomOptions random = with_sets(seed);
    random.num_vertices = 6 + seed % 5;
    random.num_agents = 2 + seed % 3;
    random.size = 60;
    random.under_way_percent = 30;
    random.no_waiting_percent = 0;  // choices without a plan would take long
    const Instance instance = random_instance(seed, random);
    SCOPED_TRACE("seed " + std::to_string(seed) + ": " + describe(instance));
    SolveOptions options;
    options.objective = seed % 2 == 0 ? Objective::sum_of_costs : Objective::makespan;
    options.limits.looks = 20'000;
    std::optional<Cost> least;
    bool is_known = true;
    for (const auto& goals : choices(instance)) {
      const auto one = with_goals(instance, goals);
      if (!one) continue;
      const SolveOutcome outcome = solve(*one, options).value();
      is_known =
          is_known && (outcome.status == Status::optimal || outcome.status == Status::infeasible);
      if (outcome.cost) least = std::min(least.value_or(*outcome.cost), *outcome.cost);
    }
    options.joint_work = seed % 4 < 2 ? 0 : options.joint_work;
    options.threads = seed % 5 == 0 ? 2 : 1;
    const SolveOutcome outcome = solve(instance, options).value();
    ASSERT_FALSE(outcome.internal_error) << outcome.internal_error->to_string();
    ASSERT_TRUE(!outcome.plan || verify(instance, *outcome.plan).valid());
    ASSERT_TRUE(outcome.status != Status::optimal || !least || *outcome.cost <= *least);
    if (!is_known) continue;
    if (outcome.status == Status::optimal) {
      ASSERT_EQ(outcome.cost, least);
      ++num_compared;
    } else if (outcome.status == Status::infeasible) {
      ASSERT_FALSE(least);
      ++num_infeasible;
    } else if (least) {
      ASSERT_LE(outcome.lower_bound, *least);
      ASSERT_TRUE(!outcome.cost || *outcome.cost >= *least);
    }
  }
  RecordProperty("compared", num_compared);
  RecordProperty("infeasible", num_infeasible);
  // Half of them, as a rule; two threads may come to fewer answers within their looks.
  EXPECT_GE(5 * num_compared, 2 * static_cast<int>(count));
}

/// A robot that may end at either of two docks, the last two of a row of four places 1000 apart.
Agent docker(std::size_t start) {
  Agent made = agent(start, start, 300);
  made.goals = Goals({VertexId(2), VertexId(3)});
  return made;
}
std::vector<Point> row() { return {{0, 0}, {1000, 0}, {2000, 0}, {3000, 0}}; }
const Roads kRow{{0, 1}, {1, 2}, {2, 3}};

// The nearer dock is nearer for both.
TEST(GoalSetsByHand, TwoRobotsShareTwoDocks) {
  const auto instance = Instance::make(roadmap(row(), kRow), {docker(0), docker(1)}).value();
  EXPECT_TRUE(instance.has_goal_sets());
  SolveOptions options;
  options.joint_work = 0;
  options.explain = true;
  const SolveOutcome outcome = solve(instance, options).value();
  ASSERT_EQ(outcome.status, Status::optimal);
  EXPECT_EQ(outcome.cost, 4000);
  EXPECT_EQ(outcome.plan->paths[AgentId(0)].back().vertex, VertexId(2));
  EXPECT_EQ(outcome.plan->paths[AgentId(1)].back().vertex, VertexId(3));
  // What they are in each other's way for is that dock, for ever.
  const Place dock{Place::Kind::goal, VertexId(2), VertexId(2)};
  const auto& sites = outcome.attribution->sites;
  const auto site = std::find_if(sites.begin(), sites.end(),
                                 [&](const CollisionSite& one) { return one.place == dock; });
  ASSERT_NE(site, sites.end());
  EXPECT_EQ(site->begin, 0);
  EXPECT_EQ(site->end, CollisionSite::kForever);
}

// Each has a dock of its own, and both are nearer to the one in the middle. Its price makes both
// docks as dear for both: a plan that leaves it over has to pay that.
TEST(GoalSetsByHand, ADockThatBothWouldPayForIsNotLeftOver) {
  // In each order of docks and of robots.
  for (const std::size_t other_dock : {2U, 4U})
    for (const bool is_left_first : {false, true}) {
      std::vector<Point> points{{2000, 0}, {4000, 0}, {0, 0}, {3000, 0}, {6000, 0}};
      std::swap(points[3], points[other_dock]);
      const auto at = [&](Length x) {
        const auto found = std::find(points.begin(), points.end(), Point{x, 0});
        return static_cast<std::size_t>(found - points.begin());
      };
      const Roads line{
          {at(0), at(2000)}, {at(2000), at(3000)}, {at(3000), at(4000)}, {at(4000), at(6000)}};
      std::vector<Agent> agents{agent(0, 0, 300), agent(1, 1, 300)};
      agents[0].goals = Goals({VertexId(at(0)), VertexId(at(3000))});
      agents[1].goals = Goals({VertexId(at(6000)), VertexId(at(3000))});
      if (!is_left_first) std::swap(agents[0], agents[1]);
      const auto instance = Instance::make(roadmap(points, line), agents).value();
      SolveOptions options;
      options.joint_work = 0;
      const SolveOutcome outcome = solve(instance, options).value();
      EXPECT_EQ(outcome.status, Status::optimal);
      EXPECT_EQ(outcome.cost, 3000);
    }
}

// Three docks, of which the last two are too near to each other. Nobody looks at all agents
// together, because they are too many, nor at the three of them. So it is clauses that say that no
// two end in one place: by how long they stay away there is no end.
TEST(GoalSetsByHand, ThreeRobotsFindNoRoomInTwoDocks) {
  std::vector<Point> points = row();
  points.push_back({3400, 0});
  Roads roads = kRow;
  roads.emplace_back(3, 4);
  std::vector<Agent> agents{docker(0), docker(1), docker(2)};
  for (Agent& agent : agents) agent.goals = Goals({VertexId(2), VertexId(3), VertexId(4)});
  for (std::int64_t k = 1; k <= 6; ++k) {
    agents.push_back(agent(points.size(), points.size(), 300));
    points.push_back({Length(10'000 * k), 0});
  }
  const auto instance =
      Instance::make(roadmap(std::move(points), roads), std::move(agents)).value();
  SolveOptions options;
  options.joint_work = 0;
  options.limits.conflicts = 1000;
  options.limits.looks = 100'000;
  options.debug.audit = true;
  const SolveOutcome outcome = solve(instance, options).value();
  EXPECT_FALSE(outcome.internal_error);
  EXPECT_EQ(outcome.status, Status::infeasible);
}

TEST(GoalSetsByHand, InfeasibleInTheUsersWords) {
  // More robots than docks, among others who are far away: too many to be searched together.
  std::vector<Point> points = row();
  std::vector<Agent> agents{docker(0), docker(1), docker(2)};
  for (std::int64_t k = 1; k <= 30; ++k) {
    agents.push_back(agent(points.size(), points.size(), 300));
    points.push_back({Length(10'000 * k), 0});
  }
  const auto crowd = Instance::make(roadmap(std::move(points), kRow), std::move(agents)).value();
  const SolveOutcome outcome = solve(crowd, {}).value();
  EXPECT_EQ(outcome.status, Status::infeasible);
  EXPECT_EQ(outcome.explanation, "agents 0, 1 and 2 can only end at 2 different goals");
  EXPECT_EQ(outcome.blocked, (std::vector{AgentId(0), AgentId(1), AgentId(2)}));
  // Two docks that are too near to each other for two.
  std::vector<Point> near = row();
  near[3].x = 2500;
  const auto tight = Instance::make(roadmap(near, kRow), {docker(0), docker(1)}).value();
  const SolveOutcome refused = solve(tight, {}).value();
  EXPECT_EQ(refused.status, Status::infeasible);
  EXPECT_EQ(refused.explanation,
            "agents 0 and 1 cannot both be at a goal: their bodies overlap at every two of their "
            "goals");
}

TEST(GoalSetsByHand, ErrorsOfInstances) {
  const auto roadmap =
      std::make_shared<const Roadmap>(Roadmap::make({{0, 0}, {1'000'000, 0}, {2'000'000, 0}},
                                                    {{VertexId(0), VertexId(1), std::nullopt}})
                                          .value());
  const auto error = [&](Goals goals) {
    return Instance::make(roadmap, {{VertexId(0), std::move(goals), Disc{100'000}}}).error();
  };
  EXPECT_EQ(error(Goals(std::vector<VertexId>{})).code, ErrorCode::invalid_instance);
  EXPECT_EQ(error(Goals({VertexId(1), VertexId(9)})).code, ErrorCode::invalid_instance);
  const Goals unreachable({VertexId(2)});
  EXPECT_EQ(error(unreachable).message,
            "agent 0 cannot reach its goal: there is no way from vertex 0 to vertex 2");
  // One of two is enough.
  EXPECT_TRUE(
      Instance::make(roadmap, {{VertexId(0), Goals({VertexId(1), VertexId(2)}), Disc{100'000}}}));
}

}  // namespace
}  // namespace quadrille::continuous::test
