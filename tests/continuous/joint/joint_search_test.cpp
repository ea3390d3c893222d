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
#include "quadrille/continuous/verify.hpp"
#include "support/environment.hpp"

namespace quadrille::continuous::test {
namespace {

constexpr std::int64_t kWork = 1'000'000'000;

/// Two to four agents, `max_vertices` at most, mixed radii and speeds, one-way edges, moves of a
/// few ticks, some of other durations than their lengths say.
Instance tiny_instance(std::uint32_t seed, std::int64_t max_vertices, std::int64_t max_agents) {
  Draw draw(seed), more(seed + 77);
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
    auto roadmap = Roadmap::make(points, edges);
    if (!roadmap) continue;
    const auto map = std::make_shared<const Roadmap>(std::move(roadmap).value());
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
    auto instance = Instance::make(map, std::move(agents));
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
  const JointReport some = find_joint_plan(scene, agents, work);
  ASSERT_NE(some.end, JointReport::End::stopped);
  const JointReport best = find_cheapest_joint_plan(scene, objective, {}, work);
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
  ASSERT_EQ(find_cheapest_joint_plan(scene, objective, least, work).end,
            JointReport::End::exhausted);
  for (work = 100; work < 1'000'000;) {
    std::int64_t left = work;
    const JointReport report = find_cheapest_joint_plan(scene, objective, {}, left);
    ASSERT_LE(report.lower_bound, least);
    if (report.end != JointReport::End::stopped) break;
    work *= 4;
  }
}

class JointRandom : public testing::TestWithParam<std::tuple<Objective, std::uint32_t>> {};

TEST_P(JointRandom, AgreesWithTheTicks) {
  const auto [objective, shard] = GetParam();
  const auto count = static_cast<std::uint32_t>(support::scaled(500));
  Answers answers;
  for (std::uint32_t n = 0; n < count; ++n) {
    const std::uint32_t seed = shard * 1'000'000 + n;
    const Instance instance = tiny_instance(seed, 6, 3);
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

INSTANTIATE_TEST_SUITE_P(All, JointRandom,
                         testing::Combine(testing::Values(Objective::sum_of_costs,
                                                          Objective::makespan),
                                          testing::Values(1U, 2U)),
                         [](const auto& param) {
                           return std::string(std::get<0>(param.param) == Objective::makespan
                                                  ? "Makespan"
                                                  : "SumOfCosts") +
                                  std::to_string(std::get<1>(param.param));
                         });

// What is asked of the program as a whole: a proof or a refutation, each time.
class TinyRandom : public testing::TestWithParam<Objective> {};

TEST_P(TinyRandom, IsSolvedOrRefuted) {
  const auto count = static_cast<std::uint32_t>(support::scaled(1000));
  const std::uint32_t first = GetParam() == Objective::makespan ? 30'000'000 : 40'000'000;
  Answers answers;
  for (std::uint32_t seed = first; seed < first + count; ++seed) {
    const Instance instance = tiny_instance(seed, 9, 4);
    SCOPED_TRACE("seed " + std::to_string(seed) + ": " + describe(instance));
    SolveOptions options;
    options.objective = GetParam();
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

INSTANTIATE_TEST_SUITE_P(All, TinyRandom,
                         testing::Values(Objective::sum_of_costs, Objective::makespan),
                         [](const auto& param) {
                           return std::string(param.param == Objective::makespan ? "Makespan"
                                                                                 : "SumOfCosts");
                         });

}  // namespace
}  // namespace quadrille::continuous::test
