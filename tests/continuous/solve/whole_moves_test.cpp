// SPDX-License-Identifier: MIT
//
// Plans for systems that release whole moves: answers derived by hand, and random instances against
// two oracles with a geometry of their own.
#include <gtest/gtest.h>

#include <cstdint>
#include <optional>
#include <sstream>
#include <string>
#include <tuple>
#include <vector>

#include "continuous/joint/tick_search.hpp"
#include "continuous/support/meeting.hpp"
#include "continuous/support/oracle_check.hpp"
#include "continuous/support/random_instance.hpp"
#include "continuous/support/roads.hpp"
#include "quadrille/continuous/instance_json.hpp"
#include "quadrille/continuous/session.hpp"
#include "quadrille/continuous/under_way.hpp"
#include "quadrille/continuous/verify.hpp"
#include "quadrille/geometry/body_pair.hpp"
#include "support/environment.hpp"

namespace quadrille::continuous::test {
namespace {

class WholeMoves : public testing::TestWithParam<Asked> {
 protected:
  [[nodiscard]] SolveOptions options() const {
    SolveOptions options;
    std::tie(options.objective, options.system) = GetParam();
    options.debug.audit = true;
    options.limits.cpu_s = 20;
    return options;
  }
  [[nodiscard]] std::uint32_t part() const {
    return 2 * static_cast<std::uint32_t>(std::get<0>(GetParam()) == Objective::makespan) +
           static_cast<std::uint32_t>(std::get<1>(GetParam()) == System::smt_cbs);
  }
  [[nodiscard]] Cost cost_of(const Instance& instance) const {
    const SolveOutcome outcome = solve(instance, options()).value();
    EXPECT_EQ(outcome.status, Status::optimal) << outcome.explanation;
    EXPECT_TRUE(verify(instance, *outcome.plan).valid());
    return outcome.cost.value_or(-1);
  }
  [[nodiscard]] bool is_sum() const { return std::get<0>(GetParam()) == Objective::sum_of_costs; }
};

/// A road of lanes of 1,000 that two of radius 100 go along, one behind the other.
Instance column() {
  return Instance::make(Roadmap::make({{0, 0}, {1000, 0}, {2000, 0}, {3000, 0}},
                                      {{VertexId(0), VertexId(1), {}},
                                       {VertexId(1), VertexId(2), {}},
                                       {VertexId(2), VertexId(3), {}}})
                            .value(),
                        {agent(0, 2, 100), agent(1, 3, 100)})
      .value();
}

TEST_P(WholeMoves, WhoFollowsWaitsForTheEndOfTheMove) {
  const Instance gradual = column(), whole = gradual.with_whole_moves();
  EXPECT_FALSE(gradual.has_whole_moves());
  EXPECT_EQ(cost_of(gradual), is_sum() ? 4000 : 2000);
  EXPECT_EQ(cost_of(whole), is_sum() ? 5000 : 3000);
  EXPECT_EQ(cost_of(whole.with_whole_moves(false)), is_sum() ? 4000 : 2000);
  EXPECT_TRUE(whole.with_agents(whole.agents().items())->has_whole_moves());

  const Plan plan = *solve(gradual, options()).value().plan;
  EXPECT_TRUE(verify(gradual, plan).valid());
  const VerifyReport report = verify(whole, plan);
  ASSERT_FALSE(report.violations.empty());
  EXPECT_EQ(report.violations[0].kind, Violation::Kind::whole_moves);
  EXPECT_EQ(to_string(report.violations[0].kind), "whole-moves");
  EXPECT_EQ(report.violations[0].other, AgentId(1));
  EXPECT_NE(report.violations[0].message.find(
                "agent 0 moves from vertex 0 to vertex 1 and agent 1 moves from vertex 1 to vertex "
                "2: bodies could collide there, and moves are released as a whole"),
            std::string::npos)
      << report.violations[0].message;
  SolveOptions asked = options();
  asked.initial_plan = plan;
  EXPECT_EQ(solve(whole, asked).error().code, ErrorCode::invalid_plan);
}

TEST_P(WholeMoves, ARingCannotTurn) {
  // Three on a ring of three lanes, each of which wants to go on by one: nobody may begin.
  const Instance gradual = Instance::make(Roadmap::make({{0, 0}, {1000, 0}, {500, 866}},
                                                        {{VertexId(0), VertexId(1), Ticks(10)},
                                                         {VertexId(1), VertexId(2), Ticks(10)},
                                                         {VertexId(2), VertexId(0), Ticks(10)}})
                                              .value(),
                                          {agent(0, 1, 100), agent(1, 2, 100), agent(2, 0, 100)})
                               .value();
  EXPECT_EQ(cost_of(gradual), is_sum() ? 30 : 10);
  EXPECT_EQ(solve(gradual.with_whole_moves(), options()).value().status, Status::infeasible);
}

TEST_P(WholeMoves, AMoveInProgressCountsAsAWholeOne) {
  // One has the crossing behind it already, but not the end of its move.
  RoadmapParts parts(Roadmap::make({{0, 0}, {1000, 0}, {200, -500}, {200, 500}},
                                   {{VertexId(0), VertexId(1), {}}, {VertexId(2), VertexId(3), {}}})
                         .value());
  const VertexId place = add_lane_place(parts, VertexId(0), VertexId(1), 1000, 600);
  std::vector<Agent> agents{agent(place.index(), 1, 100), agent(2, 3, 100)};
  agents[0].under_way = true;
  const Instance gradual = Instance::make(std::move(parts).make().value(), agents).value();
  EXPECT_EQ(cost_of(gradual), is_sum() ? 1400 : 1000);
  EXPECT_EQ(cost_of(gradual.with_whole_moves()), is_sum() ? 1800 : 1400);
}

TEST_P(WholeMoves, SessionsKeepToIt) {
  const Instance gradual = column();
  Session session(gradual.shared_roadmap(), {}, {}, 0, true);
  for (const Agent& member : gradual.agents()) ASSERT_TRUE(session.add(member));
  EXPECT_TRUE(session.instance()->has_whole_moves());
  for (int round = 0; round < 2; ++round)
    EXPECT_EQ(session.solve(options()).value().cost, is_sum() ? 5000 : 3000);
}

/// By looking at all pairs of moves.
bool obeys(const Instance& whole, const Plan& plan) {
  const Roadmap& roadmap = whole.roadmap();
  std::vector<std::tuple<AgentId, Element, Body>> moves;
  for (const AgentId i : whole.agent_ids())
    for (std::size_t k = 0; k + 1 < plan.paths[i].size(); ++k) {
      const Stop &from = plan.paths[i][k], &to = plan.paths[i][k + 1];
      moves.push_back(
          {i,
           {roadmap.position(from.vertex), roadmap.position(to.vertex), from.depart, to.arrive},
           whole.body(whole.class_of(i), roadmap.shape(from.vertex, to.vertex))});
    }
  for (const auto& [i, a, body_a] : moves)
    for (const auto& [j, b, body_b] : moves)
      if (i < j && a.begin < b.end && b.begin < a.end && sweeps_meet(a, body_a, b, body_b))
        return false;
  return true;
}

Instance draw(std::uint32_t seed) {
  RandomOptions random;
  random.num_agents = 2 + seed % 2;
  random.num_vertices = 5 + seed / 2 % 3;
  random.edge_percent = 25 + static_cast<int>(seed / 8 % 3) * 10;
  random.goal_sets_percent = seed % 7 == 0 ? 50 : 0;
  random.max_radius = Length(3 + 3 * static_cast<std::int64_t>(seed % 3));
  return random_instance(seed, random);
}

TEST_P(WholeMoves, AgreesWithTheOracleOfOrders) {
  const auto count = static_cast<std::uint32_t>(support::scaled(300));
  const std::uint32_t first = 410'000'000 + 1'000'000 * part();
  constexpr std::size_t max_moves = 4;
  Tally tally;
  int num_dearer = 0, num_refused = 0, num_obeyed = 0;
  for (std::uint32_t seed = first; seed < first + count; ++seed) {
    const Instance gradual = draw(seed);
    const Instance instance = gradual.with_whole_moves();
    SCOPED_TRACE("seed " + std::to_string(seed) + ": " + describe(instance));
    SolveOptions asked = options();
    const OrderSearch oracle = search_orders(instance, asked.objective, max_moves);
    for (const Plan& plan : oracle.some_plans) ASSERT_TRUE(verify(instance, plan).valid());
    const OrderSearch easier = search_orders(gradual, asked.objective, max_moves);
    for (const Plan& plan : easier.some_plans) {
      ASSERT_EQ(verify(instance, plan).valid(), obeys(instance, plan));
      ++(obeys(instance, plan) ? num_obeyed : num_refused);
    }
    ASSERT_TRUE(!oracle.best || easier.best.value() <= *oracle.best);
    num_dearer += oracle.best && *easier.best < *oracle.best ? 1 : 0;
    asked.limits.conflicts = 3000;
    asked.limits.looks = oracle.best ? 30'000 : 500;
    asked.limits.cpu_s.reset();
    if (!oracle.some_plans.empty() && seed % 2 == 0)
      asked.debug.known_plan = oracle.some_plans[seed % oracle.some_plans.size()];
    if (seed % 4 == 1) asked.joint_work = asked.route_work = 0;  // clauses alone
    check_against(oracle, max_moves, instance, asked, tally);
    if (HasFatalFailure()) return;
  }
  record(tally);
  RecordProperty("dearer", num_dearer);
  RecordProperty("refused", num_refused);
  RecordProperty("obeyed", num_obeyed);
  if (count < 300) return;
  EXPECT_GE(3 * tally.solvable, static_cast<int>(count));
  EXPECT_GE(10 * tally.optimal, 7 * tally.solvable);
  EXPECT_GE(num_dearer, 10);
  EXPECT_GE(num_refused, 50);
}

TEST_P(WholeMoves, AgreesWithTheOracleOfTicks) {
  const auto count = static_cast<std::uint32_t>(support::scaled(300));
  const std::uint32_t first = 420'000'000 + 1'000'000 * part();
  int solvable = 0, plans = 0, none = 0;
  for (std::uint32_t seed = first; seed < first + count; ++seed) {
    RandomOptions random;
    random.num_agents = 2 + seed % 2;
    random.num_vertices = 4 + seed / 2 % 3;
    random.size = 8;
    random.max_radius = 2;
    random.space_percent = random.polygon_percent = random.shapes_percent = 0;
    const Instance instance = random_instance(seed, random).with_whole_moves();
    SCOPED_TRACE("seed " + std::to_string(seed) + ": " + describe(instance));
    SolveOptions asked = options();
    const TickSearch oracle = search_ticks(instance, asked.objective, 5'000);
    if (!oracle.is_complete) continue;
    solvable += oracle.best ? 1 : 0;
    asked.limits.cpu_s.reset();
    asked.limits.conflicts = oracle.best ? 3000 : 10;
    asked.limits.looks = oracle.best ? 30'000 : 500;
    if (seed % 4 == 1) asked.joint_work = asked.route_work = 0;
    const auto outcome = solve(instance, asked);
    ASSERT_TRUE(outcome) << outcome.error().message;
    ASSERT_FALSE(outcome->internal_error) << outcome->internal_error->message;
    if (outcome->plan) {
      ASSERT_TRUE(verify(instance, *outcome->plan).valid());
    }
    if (outcome->status == Status::optimal) {
      ASSERT_EQ(outcome->cost, oracle.best);
      ++plans;
    } else if (outcome->status == Status::infeasible) {
      ASSERT_FALSE(oracle.best) << outcome->explanation;
      ++none;
    } else {
      ASSERT_TRUE(!oracle.best || outcome->lower_bound <= *oracle.best);
    }
  }
  RecordProperty("plans", plans);
  RecordProperty("none", none);
  if (count < 300) return;
  EXPECT_GE(solvable, 100);
  EXPECT_GE(10 * plans, 8 * solvable);
}

INSTANTIATE_TEST_SUITE_P(All, WholeMoves, all_asked(), name_of);

TEST(WholeMovesSweeps, AreFoundAlike) {
  // The judgement of the oracle and the library's, touching included.
  Draw random(430'000'000);
  int num_meeting = 0;
  const auto body = [&](bool is_disc) -> Body {
    if (is_disc) return Disc{random.length(1, 4)};
    for (;;) {
      std::vector<Point> corners;
      for (int k = 0; k < 4; ++k) corners.push_back({random.length(-4, 4), random.length(-4, 4)});
      if (auto polygon = ConvexPolygon::make(corners)) return std::move(polygon).value();
    }
  };
  for (std::size_t number = 0; number < support::scaled(20'000); ++number) {
    const bool in_space = random.chance(30);
    const auto point = [&] {
      return Point{random.length(0, 12), random.length(0, 12),
                   in_space ? random.length(0, 12) : Length(0)};
    };
    const Body a = body(in_space || random.chance(50)), b = body(in_space || random.chance(50));
    const Element p{point(), point(), 0, random.ticks(1, 9)};
    const Element q{point(), point(), 0, random.ticks(1, 9)};
    const bool meet = sweeps_meet(p, a, q, b);
    ASSERT_EQ(meet, geometry::BodyPair(a, b).can_meet({p.from, p.to, p.end}, {q.from, q.to, q.end}))
        << number;
    num_meeting += meet ? 1 : 0;
  }
  EXPECT_GT(num_meeting, 0);
}

TEST(WholeMovesFiles, CarryIt) {
  const Instance whole = column().with_whole_moves();
  std::ostringstream out;
  ASSERT_FALSE(write_instance_json(out, "", whole));
  EXPECT_NE(out.str().find("\"whole_moves\": true"), std::string::npos);
  std::istringstream in(out.str());
  EXPECT_TRUE(read_instance_json(in, "file")->has_whole_moves());
  std::ostringstream gradual;
  ASSERT_FALSE(write_instance_json(gradual, "", column()));
  EXPECT_EQ(gradual.str().find("whole"), std::string::npos);
}

TEST(WholeMovesProof, IsRefusedInWords) {
  SolveOptions asked;
  asked.proof = true;
  EXPECT_EQ(solve(column().with_whole_moves(), asked).error().message,
            "certificates have no rule yet for moves that are released as a whole");
}

}  // namespace
}  // namespace quadrille::continuous::test
