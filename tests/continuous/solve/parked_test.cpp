// SPDX-License-Identifier: MIT
//
// Agents that overlap at their starts: answers derived by hand, and random instances against the
// oracle, which knows the rule and nothing of private places.
#include <gtest/gtest.h>

#include <cstdint>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "continuous/joint/tick_search.hpp"
#include "continuous/support/oracle_check.hpp"
#include "continuous/support/random_instance.hpp"
#include "continuous/support/roads.hpp"
#include "quadrille/continuous/instance_json.hpp"
#include "quadrille/continuous/second_opinion.hpp"
#include "quadrille/continuous/verify.hpp"
#include "support/environment.hpp"

namespace quadrille::continuous::test {
namespace {

Agent parked(std::size_t start, std::size_t goal, Length radius) {
  Agent made = agent(start, goal, radius);
  made.overlaps_at_start = true;
  return made;
}

/// Two places 150 apart, in which discs of diameter 200 are parked, each with a road of its own.
std::shared_ptr<const Roadmap> two_bays() {
  return roadmap({{0, 0}, {150, 0}, {0, 1000}, {150, -1000}, {150, -60}},
                 {{0, 2}, {1, 3}, {1, 4}, {4, 3}});
}

class Parked : public testing::TestWithParam<Asked> {
 protected:
  [[nodiscard]] SolveOptions options() const {
    SolveOptions options;
    std::tie(options.objective, options.system) = GetParam();
    options.debug.audit = true;
    options.limits.cpu_s = 20;
    return options;
  }
  [[nodiscard]] bool is_sum() const { return std::get<0>(GetParam()) == Objective::sum_of_costs; }
};

TEST_P(Parked, OneGoesFirst) {
  std::vector<Agent> agents{parked(0, 2, 100), parked(1, 3, 100)};
  const Instance instance = Instance::make(two_bays(), agents).value();
  ASSERT_EQ(instance.parked_pairs(), (std::vector{std::pair(AgentId(0), AgentId(1))}));
  const SolveOutcome outcome = solve(instance, options()).value();
  ASSERT_EQ(outcome.status, Status::optimal) << outcome.explanation;
  // The other one leaves when it is clear: sqrt(200^2 - 150^2) = 132.3 away.
  EXPECT_EQ(outcome.cost, is_sum() ? 2133 : 1133);
  EXPECT_TRUE(verify(instance, *outcome.plan).valid());
  EXPECT_EQ(ask_fcl(instance, *outcome.plan).verdict, SecondOpinion::Verdict::clear);
  for (const Path& path : outcome.plan->paths)
    for (const Stop& stop : path) EXPECT_LT(stop.vertex.index(), 5U);
  // Neither may if one of them does not say that it overlaps.
  agents[1].overlaps_at_start = false;
  EXPECT_EQ(Instance::make(two_bays(), agents).error().code, ErrorCode::no_plan);
}

TEST_P(Parked, OneStays) {
  const std::vector<Agent> agents{parked(0, 2, 100), parked(1, 1, 100)};
  const Instance instance = Instance::make(two_bays(), agents).value();
  const SolveOutcome outcome = solve(instance, options()).value();
  ASSERT_EQ(outcome.status, Status::optimal) << outcome.explanation;
  EXPECT_EQ(outcome.cost, 1000);
  // Not where it has left: it has to come back before the other one is there, and cannot.
  const std::vector<Agent> others{parked(2, 0, 100), parked(1, 1, 100)};
  EXPECT_EQ(Instance::make(two_bays(), others).error().code, ErrorCode::no_plan);
}

TEST_P(Parked, TheyAreApartAfterTheFirstMove) {
  // From vertex 4, 60 away, the two overlap still.
  const Instance instance =
      Instance::make(two_bays(), {parked(0, 0, 100), parked(1, 3, 100)}).value();
  const auto kinds = [&](std::vector<Stop> path) {
    std::size_t found = 0;
    const Plan plan{IdVector<AgentId, Path>(
        std::vector<Path>{{{VertexId(0), 0, 0}}, Path(path.begin(), path.end())})};
    for (const Violation& violation : verify(instance, plan).violations)
      found += violation.kind == Violation::Kind::collision ? 1 : 100;
    return found;
  };
  EXPECT_EQ(kinds({{VertexId(1), 0, 7}, {VertexId(3), 1007, 1007}}), 0U);
  EXPECT_EQ(kinds({{VertexId(1), 0, 7}, {VertexId(4), 67, 67}, {VertexId(3), 1007, 1007}}), 1U);
}

TEST_P(Parked, TheyDoNotSetOutAtOnce) {
  const Instance instance =
      Instance::make(two_bays(), {parked(0, 2, 100), parked(1, 3, 100)}).value();
  const auto is_plan = [&](Ticks second) {
    const Plan plan{IdVector<AgentId, Path>(std::vector<Path>{
        {{VertexId(0), 0, 0}, {VertexId(2), 1000, 1000}},
        {{VertexId(1), 0, second}, {VertexId(3), second + 1000, second + 1000}}})};
    const bool is_valid = verify(instance, plan).valid();
    EXPECT_EQ(ask_fcl(instance, plan).verdict == SecondOpinion::Verdict::collision, !is_valid);
    return is_valid;
  };
  // Although they part from each other.
  EXPECT_FALSE(is_plan(0));
  EXPECT_FALSE(is_plan(100));
  EXPECT_FALSE(is_plan(132));
  EXPECT_TRUE(is_plan(133));
}

TEST_P(Parked, ComingBackIsACollision) {
  // A road to and fro: whoever has left its bay finds it too near to the other one.
  const auto map = roadmap({{0, 0}, {150, 0}, {0, 1000}}, {{0, 2}, {2, 0}});
  const Instance instance = Instance::make(map, {parked(0, 2, 100), parked(1, 1, 100)}).value();
  Plan plan{IdVector<AgentId, Path>(std::vector<Path>{{{VertexId(0), 0, 0},
                                                       {VertexId(2), 1000, 1000},
                                                       {VertexId(0), 2000, 2000},
                                                       {VertexId(2), 3000, 3000}},
                                                      {{VertexId(1), 0, 0}}})};
  const VerifyReport report = verify(instance, plan);
  ASSERT_EQ(report.violations.size(), 1U);
  EXPECT_EQ(report.violations[0].kind, Violation::Kind::collision);
  EXPECT_EQ(ask_fcl(instance, plan).verdict, SecondOpinion::Verdict::collision);
  EXPECT_EQ(solve(instance, options())->cost, 1000);
}

TEST_P(Parked, ATurnOnTheSpotIsAMove) {
  // After it nobody is elsewhere: the two overlap still.
  std::vector<Edge> edges{{VertexId(0), VertexId(2), Ticks{10}}, {VertexId(2), VertexId(3), {}}};
  const auto map = std::make_shared<const Roadmap>(
      Roadmap::make({{0, 0}, {150, 0}, {0, 0}, {0, 1000}}, std::move(edges)).value());
  const Instance instance = Instance::make(map, {parked(0, 3, 100), parked(1, 1, 100)}).value();
  const Plan plan{IdVector<AgentId, Path>(
      std::vector<Path>{{{VertexId(0), 0, 5}, {VertexId(2), 15, 15}, {VertexId(3), 1015, 1015}},
                        {{VertexId(1), 0, 0}}})};
  const VerifyReport report = verify(instance, plan);
  ASSERT_FALSE(report.valid());
  EXPECT_EQ(report.violations[0].kind, Violation::Kind::collision);
  EXPECT_EQ(ask_fcl(instance, plan).verdict, SecondOpinion::Verdict::collision);
}

TEST(ParkedFiles, AreReadAndWritten) {
  const Instance instance =
      Instance::make(two_bays(), {parked(0, 2, 100), parked(1, 3, 100)}).value();
  std::stringstream text;
  ASSERT_FALSE(write_instance_json(text, "", instance));
  const auto again = read_instance_json(text, "");
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(again->agents(), instance.agents());
}

/// Small numbers, so that bodies that are drawn at random overlap most of the time.
std::optional<Instance> draw(Draw& draw) {
  std::vector<Point> points;
  const auto num_vertices = static_cast<std::size_t>(draw.number(4, 6));
  for (std::size_t v = 0; v < num_vertices; ++v)
    points.push_back({draw.length(0, 7), draw.length(0, 7)});
  std::vector<Edge> edges;
  for (std::size_t v = 0; v < num_vertices; ++v)
    for (std::size_t w = 0; w < num_vertices; ++w)
      if (v != w && points[v] != points[w] && draw.chance(45))
        edges.push_back({VertexId(v), VertexId(w), std::nullopt});
  std::vector<Agent> agents;
  const auto vertex = [&] {
    return static_cast<std::size_t>(draw.number(0, static_cast<std::int64_t>(num_vertices) - 1));
  };
  for (std::int64_t k = draw.number(2, 3); k > 0; --k) {
    agents.push_back(agent(vertex(), vertex(), draw.length(1, 3)));
    agents.back().overlaps_at_start = draw.chance(90);
    if (draw.chance(15)) agents.back().release = draw.ticks(1, 6);
    if (draw.chance(15)) agents.back().deadline = draw.ticks(8, 30);
    agents.back().leaves = draw.chance(25);
  }
  auto map = Roadmap::make(std::move(points), std::move(edges));
  if (!map) return std::nullopt;
  auto made = Instance::make(std::move(map).value(), std::move(agents), {});
  if (!made || made->parked_pairs().empty()) return std::nullopt;
  return std::move(made).value();
}

TEST_P(Parked, AgreeWithTheOracle) {
  int plans = 0, none = 0, open = 0;
  std::uint32_t seed = 91'000'000 + (is_sum() ? 0 : 1'000'000);
  for (std::size_t number = 0; number < support::scaled(300);) {
    Draw random(++seed);
    const auto instance = draw(random);
    if (!instance) continue;
    ++number;
    SCOPED_TRACE("seed " + std::to_string(seed) + ": " + describe(*instance));
    SolveOptions asked = options();
    const TickSearch oracle = search_ticks(*instance, asked.objective, 10'000);
    if (!oracle.is_complete) continue;
    asked.debug.audit = seed % 8 == 0;
    asked.limits.cpu_s.reset();
    asked.limits.conflicts = oracle.best ? 500 : 10;
    // Without plans the search for the least cost has no end.
    if (seed % 3 != 0 && oracle.best) asked.joint_work = 0;
    if (seed % 4 == 0) asked.route_work = 0;
    const auto outcome = solve(*instance, asked);
    ASSERT_TRUE(outcome) << outcome.error().message;
    ASSERT_FALSE(outcome->internal_error) << outcome->internal_error->message;
    if (outcome->plan) {
      ASSERT_TRUE(verify(*instance, *outcome->plan).valid());
      ASSERT_NE(ask_fcl(*instance, *outcome->plan).verdict, SecondOpinion::Verdict::collision);
    }
    if (outcome->status == Status::optimal) {
      ASSERT_TRUE(oracle.best);
      ASSERT_EQ(outcome->cost, oracle.best);
      ++plans;
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
  if (support::scaled(300) < 300) return;
  EXPECT_GE(plans, 100);
  EXPECT_LE(open, 100);
}

INSTANTIATE_TEST_SUITE_P(All, Parked, all_asked(), name_of);

}  // namespace
}  // namespace quadrille::continuous::test
