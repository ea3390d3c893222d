// SPDX-License-Identifier: MIT
//
// Four agents on eleven vertices who have to wait for each other and to make way.
#include <gtest/gtest.h>

#include <initializer_list>
#include <ostream>
#include <sstream>
#include <string>

#include "continuous/support/oracle_check.hpp"
#include "continuous/support/random_instance.hpp"
#include "continuous/support/roads.hpp"
#include "joint/joint_search.hpp"
#include "quadrille/continuous/generator.hpp"
#include "quadrille/continuous/verify.hpp"
#include "support/environment.hpp"

namespace quadrille::continuous::test {
namespace {

using Map = std::shared_ptr<const Roadmap>;

/// Places "x,y ..." and roads "u-v ..." for both directions.
Map drawn(const char* places, const char* roads) {
  char separator = 0;
  std::vector<Point> points;
  std::istringstream in(places);
  for (std::int64_t x = 0, y = 0; in >> x >> separator >> y;)
    points.push_back({Length(x), Length(y)});
  Roads pairs;
  std::istringstream pairs_in(roads);
  for (std::pair<std::size_t, std::size_t> p; pairs_in >> p.first >> separator >> p.second;)
    pairs.push_back(p);
  return roadmap(points, pairs);
}

/// Two lines of five places with rungs between them, and one more place.
Map ladder() {
  return drawn(
      "0,0 1000,0 2000,0 3000,0 4000,0 0,1000 1000,1000 2000,1000 3000,1000 4000,1000 5000,0",
      "0-1 1-2 2-3 3-4 5-6 6-7 7-8 8-9 0-5 1-6 2-7 3-8 4-9 4-10");
}
/// Three by four without a corner.
Map board() {
  return drawn(
      "0,0 1000,0 2000,0 3000,0 0,1000 1000,1000 2000,1000 3000,1000 0,2000 1000,2000 2000,2000",
      "0-1 1-2 2-3 4-5 5-6 6-7 8-9 9-10 0-4 1-5 2-6 3-7 4-8 5-9 6-10");
}
/// A ring of ten places around one, number 10, with every second of which it is connected.
Map wheel() {
  return drawn(
      "3000,0 2427,1763 927,2853 -927,2853 -2427,1763 -3000,0 -2427,-1763 -927,-2853 927,-2853 "
      "2427,-1763 0,0",
      "0-1 1-2 2-3 3-4 4-5 5-6 6-7 7-8 8-9 9-0 10-0 10-2 10-4 10-6 10-8");
}
/// Ten places, each of which is connected to the one in the middle only.
Map star() {
  return drawn(
      "0,0 3000,0 2427,1763 927,2853 -927,2853 -2427,1763 -3000,0 -2427,-1763 -927,-2853 "
      "927,-2853 2427,-1763",
      "0-1 0-2 0-3 0-4 0-5 0-6 0-7 0-8 0-9 0-10");
}
/// A ring of four places, with roads outwards.
Map roundabout() {
  return drawn("1000,0 0,1000 -1000,0 0,-1000 2000,0 0,2000 -2000,0 0,-2000 3000,0 0,3000 -3000,0",
               "0-1 1-2 2-3 3-0 0-4 1-5 2-6 3-7 4-8 5-9 6-10");
}
/// A line with an alcove near each end.
Map alcoves() {
  return drawn("0,0 1000,0 2000,0 1000,800 3000,0 4000,0 5000,0 6000,0 7000,0 8000,0 7000,800",
               "0-1 1-2 1-3 2-4 4-5 5-6 6-7 7-8 8-9 8-10");
}
/// A line of seven with four sidings.
Map sidings() {
  return drawn(
      "0,0 1000,0 2000,0 3000,0 4000,0 5000,0 6000,0 1000,900 2000,-900 4000,900 5000,-900",
      "0-1 1-2 2-3 3-4 4-5 5-6 1-7 2-8 4-9 5-10");
}
/// A line that parts and comes together again, twice.
Map loops() {
  return drawn(
      "0,0 1000,0 2000,700 2000,-700 3000,0 4000,0 5000,0 6000,700 6000,-700 7000,0 8000,0",
      "0-1 1-2 1-3 2-4 3-4 4-5 5-6 6-7 6-8 7-9 8-9 9-10");
}
/// Four dead ends that meet: two of three places, two of two.
Map crossroads() {
  return drawn("0,0 1000,0 2000,0 3000,0 -1000,0 -2000,0 -3000,0 0,1000 0,2000 0,-1000 0,-2000",
               "0-1 1-2 2-3 0-4 4-5 5-6 0-7 7-8 0-9 9-10");
}
/// Two rooms of five places with one place between them.
Map rooms() {
  return drawn(
      "0,0 1000,0 0,1000 1000,1000 2000,500 3000,500 4000,500 5000,0 6000,0 5000,1000 6000,1000",
      "0-1 0-2 1-3 2-3 1-4 3-4 4-5 5-6 6-7 6-9 7-8 7-9 8-10 9-10");
}

using Tasks = std::vector<std::pair<std::size_t, std::size_t>>;

struct Case {
  const char* name;
  Map (*map)();
  Tasks tasks;
  Length radius = 300;
};

std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.name; }

/// Of the oracle's routes; enough for optimal plans, which the checks would notice otherwise.
constexpr std::size_t kMaxMoves = 6;

Instance instance_of(const Case& c) {
  std::vector<Agent> agents;
  for (const auto& [start, goal] : c.tasks) agents.push_back(agent(start, goal, c.radius));
  return Instance::make(c.map(), agents).value();
}

class Congestion : public testing::TestWithParam<std::tuple<Objective, Case>> {
 protected:
  /// What the solver says after so many conflicts; `route_work` as in SolveOptions.
  Tally answer(std::int64_t conflicts, std::initializer_list<std::int64_t> route_work) {
    const auto& [objective, entry] = GetParam();
    const Instance instance = instance_of(entry);
    const OrderSearch oracle = search_orders(instance, objective, kMaxMoves);
    Tally tally;
    EXPECT_TRUE(oracle.best && verify(instance, oracle.best_plan).valid());
    SolveOptions options;
    options.objective = objective;
    options.limits.conflicts = conflicts;
    options.joint_work = 0;
    for (const std::int64_t work : route_work) {
      options.route_work = work;
      check_against(oracle, kMaxMoves, instance, options, tally);
    }
    return tally;
  }
};

std::string name(const testing::TestParamInfo<Congestion::ParamType>& param) {
  const auto& [objective, entry] = param.param;
  return std::string(objective == Objective::makespan ? "Makespan" : "SumOfCosts") + entry.name;
}

using CongestionSolved = Congestion;

TEST_P(CongestionSolved, WithinAFewThousandConflicts) {
  // Measured: 0 to 700, LadderWide 4,800 and StarOneWay 10,200 for the makespan.
  EXPECT_EQ(answer(20'000, {0}).optimal, 1);
}

INSTANTIATE_TEST_SUITE_P(
    All, CongestionSolved,
    testing::Combine(
        testing::Values(Objective::sum_of_costs, Objective::makespan),
        testing::Values(Case{"Ladder", ladder, {{0, 4}, {4, 0}, {5, 9}, {9, 5}}},
                        Case{"LadderWide", ladder, {{0, 4}, {4, 0}, {5, 9}, {9, 5}}, 450},
                        Case{"Board", board, {{0, 10}, {10, 0}, {3, 8}, {8, 3}}, 450},
                        Case{"BoardAcross", board, {{1, 9}, {9, 1}, {4, 6}, {6, 4}}, 450},
                        Case{"Wheel", wheel, {{0, 5}, {5, 0}, {2, 7}, {7, 2}}},
                        Case{"WheelWide", wheel, {{0, 4}, {4, 0}, {2, 8}, {8, 2}}, 900},
                        Case{"Star", star, {{1, 6}, {2, 7}, {3, 8}, {8, 5}}},
                        Case{"Roundabout", roundabout, {{8, 10}, {10, 8}, {9, 7}, {7, 9}}},
                        Case{"RoundaboutRight", roundabout, {{8, 10}, {6, 4}, {9, 7}, {7, 5}}},
                        Case{"TwoAlcoves", alcoves, {{0, 2}, {2, 0}, {7, 9}, {9, 7}}},
                        Case{"AlcoveAndQueue", alcoves, {{0, 4}, {2, 0}, {5, 7}, {8, 9}}},
                        Case{"SidingsHalves", sidings, {{0, 3}, {3, 0}, {6, 4}, {4, 6}}},
                        Case{"Loops", loops, {{0, 5}, {1, 4}, {5, 1}, {10, 9}}})),
    name);

using CongestionHard = Congestion;

// Not solved within a second without the search of routes. What is claimed on the way has to be
// true.
TEST_P(CongestionHard, BoundsHoldWhereALimitEndsTheSearch) { answer(2'000, {0}); }

TEST_P(CongestionSolved, ByTheSearchOfRoutesAlone) {
  EXPECT_EQ(answer(1, {SolveOptions().route_work}).optimal, 1);
}

TEST_P(CongestionHard, BoundsHoldWhereTheSearchOfRoutesEnds) { answer(1, {10'000, 1'000'000}); }

TEST_P(CongestionHard, AllButOneAreSolvedByTheSearchOfRoutes) {
  const auto& [objective, entry] = GetParam();
  const std::string name = entry.name;
  const bool has_many_routes = objective == Objective::sum_of_costs && name == "RoomsQueue";
  EXPECT_EQ(answer(1, {SolveOptions().route_work}).optimal, has_many_routes ? 0 : 1);
}

TEST_P(CongestionSolved, ByTheJointSearchAlone) {
  const auto& [objective, entry] = GetParam();
  const Instance instance = instance_of(entry);
  LimitMonitor limits({});
  Scene scene(instance, limits);
  std::vector<AgentId> agents;
  for (const AgentId i : instance.agent_ids()) agents.push_back(i);
  std::int64_t work = 100'000'000;
  JointReport report = find_cheapest_joint_plan(scene, agents, objective, {}, work);
  ASSERT_EQ(report.end, JointReport::End::found);
  const Plan plan{IdVector<AgentId, Path>(std::move(report.paths))};
  EXPECT_TRUE(verify(instance, plan).valid());
  EXPECT_EQ(cost(plan, objective), report.lower_bound);
  EXPECT_EQ(search_orders(instance, objective, kMaxMoves).best, report.lower_bound);
}

INSTANTIATE_TEST_SUITE_P(
    All, CongestionHard,
    testing::Combine(
        testing::Values(Objective::sum_of_costs, Objective::makespan),
        testing::Values(Case{"CrossroadsStraight", crossroads, {{3, 6}, {8, 10}, {5, 1}, {9, 7}}},
                        Case{"CrossroadsTurn", crossroads, {{3, 6}, {8, 10}, {4, 2}, {1, 8}}},
                        Case{"CrossroadsSwap", crossroads, {{2, 5}, {5, 2}, {8, 7}, {10, 9}}},
                        Case{"StarSwaps", star, {{1, 6}, {6, 1}, {3, 8}, {8, 3}}},
                        Case{"SidingsPass", sidings, {{0, 6}, {7, 2}, {3, 1}, {10, 10}}},
                        Case{"SidingsMakeWay", sidings, {{0, 6}, {2, 2}, {3, 3}, {4, 4}}},
                        Case{"RoomsDoor", rooms, {{4, 6}, {6, 4}, {0, 3}, {10, 7}}},
                        Case{"RoomsQueue", rooms, {{4, 6}, {1, 7}, {8, 4}, {10, 9}}})),
    name);

TEST(CongestionRandom, AgreesWithTheOracle) {
  const auto count = static_cast<std::uint64_t>(support::scaled(60));
  Tally tally;
  for (std::uint64_t seed = 0; seed < count; ++seed) {
    RandomInstanceOptions random;
    random.num_vertices = 11;
    random.num_agents = 4;
    random.width = random.height = 4'500;
    random.radius = 300;
    random.mixed = true;
    const Instance instance = continuous::random_instance(random, seed).value();
    SCOPED_TRACE("seed " + std::to_string(seed) + ": " + describe(instance));
    const OrderSearch oracle = search_orders(instance, Objective::sum_of_costs, 5);
    SolveOptions options;
    options.limits.conflicts = 10'000;
    options.route_work = options.joint_work = 0;
    options.limits.cpu_s = 2;
    check_against(oracle, 5, instance, options, tally);
    if (HasFatalFailure()) return;
  }
  if (count < 60) return;  // scaled down, for slow builds: too few to count on chance
  EXPECT_GE(2 * tally.solvable, static_cast<int>(count));
  // Measured: 58 of 60.
  EXPECT_GE(10 * tally.optimal, 9 * tally.solvable);
}

}  // namespace
}  // namespace quadrille::continuous::test
