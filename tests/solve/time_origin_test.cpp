// SPDX-License-Identifier: MIT
//
// Instances that begin later than at 0, in both domains: the answer is that of the same instance
// begun at 0, but for the times of the plan.
#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "continuous/support/random_instance.hpp"
#include "quadrille/continuous/instance_json.hpp"
#include "quadrille/continuous/plan_files.hpp"
#include "quadrille/continuous/second_opinion.hpp"
#include "quadrille/continuous/session.hpp"
#include "quadrille/continuous/solver.hpp"
#include "quadrille/continuous/verify.hpp"
#include "quadrille/discrete/instance_json.hpp"
#include "quadrille/discrete/instance_yaml.hpp"
#include "quadrille/discrete/plan_formats.hpp"
#include "quadrille/discrete/primal.hpp"
#include "quadrille/discrete/solver.hpp"
#include "quadrille/discrete/timed_plan.hpp"
#include "quadrille/discrete/verify.hpp"
#include "support/environment.hpp"
#include "support/generators.hpp"

namespace quadrille {
namespace {

using quadrille::support::Random;
using quadrille::support::scaled;

// What both domains are asked, and how their answers are compared.

template <class Options>
Options options_for(std::uint32_t seed) {
  Options options;
  options.objective = seed % 3 == 0 ? Objective::makespan : Objective::sum_of_costs;
  options.limits.conflicts = 300;
  options.explain = seed % 2 == 0;
  options.debug.audit = seed % 4 == 0;
  return options;
}

template <class Outcome>
void expect_same(const Outcome& from_0, const Outcome& later, Cost now) {
  ASSERT_FALSE(later.internal_error) << later.internal_error->message;
  EXPECT_EQ(later.status, from_0.status);
  EXPECT_EQ(later.cost, from_0.cost);
  EXPECT_EQ(later.lower_bound, from_0.lower_bound);
  EXPECT_EQ(later.statistics.conflicts, from_0.statistics.conflicts);
  ASSERT_EQ(later.attribution.has_value(), from_0.attribution.has_value());
  if (!later.attribution) return;
  const auto &a = from_0.attribution->sites, &b = later.attribution->sites;
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) {
    EXPECT_EQ(b[k].begin, a[k].begin + now);
    EXPECT_EQ(b[k].end, a[k].end == CollisionSite::kForever ? a[k].end : a[k].end + now);
  }
}

// The discrete domain.

discrete::Instance drawn(std::uint32_t seed) {
  Random random(seed);
  discrete::Instance instance = random.percent(50) ? discrete::support::random_grid(random, {})
                                                   : discrete::support::random_graph(random, 8, 4);
  return random.percent(25) ? discrete::support::with_more_goals(random, instance) : instance;
}

Timestep drawn_now(std::uint32_t seed) {
  Random random(seed + 1000);
  return random.percent(10) ? discrete::kMaxNow : static_cast<Timestep>(1 + random.below(5000));
}

TEST(TimeOriginDiscrete, AnswersAreThoseFrom0ButForTheTimes) {
  int solved = 0;
  for (std::uint32_t seed = 0; seed < scaled(400); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const discrete::Instance from_0 = drawn(seed);
    const Timestep now = drawn_now(seed);
    const discrete::Instance later = from_0.with_now(now).value();
    auto options = options_for<discrete::SolveOptions>(seed);
    options.first_plan = seed % 5 != 0;
    const auto expected = discrete::solve(from_0, options).value();
    std::vector<Timestep> told;
    options.on_plan = [&](const discrete::Plan& plan) { told.push_back(plan.now); };
    options.plan_interval_s = 0;
    const auto outcome = discrete::solve(later, options).value();
    expect_same(expected, outcome, now);
    for (const Timestep begin : told) EXPECT_EQ(begin, now);
    if (!outcome.plan) continue;
    ++solved;
    EXPECT_EQ(outcome.plan->now, now);
    EXPECT_EQ(outcome.plan->paths, expected.plan->paths);
    EXPECT_TRUE(discrete::verify(later, *outcome.plan).valid());
    EXPECT_FALSE(discrete::verify(later, *expected.plan).valid());
    EXPECT_FALSE(discrete::verify(from_0, *outcome.plan).valid());
    EXPECT_EQ(discrete::verify(later, *outcome.plan).sum_of_costs,
              discrete::verify(from_0, *expected.plan).sum_of_costs);
    const auto timed = discrete::TimedPlan::make(later, *outcome.plan).value();
    EXPECT_EQ(timed.sum_of_costs(), outcome.plan->cost(Objective::sum_of_costs));
    for (const AgentId i : timed.agent_ids()) {
      EXPECT_EQ(timed[i].stops().front().arrive, now);
      EXPECT_EQ(timed[i].samples(2).front().time, now);
      EXPECT_EQ(timed[i].cost(), discrete::arrival(outcome.plan->paths[i]));
    }
    // Given back, it is taken.
    options.initial_plan = options.debug.known_plan = outcome.plan;
    EXPECT_EQ(discrete::solve(later, options).value().cost, outcome.cost);
    options.debug.known_plan.reset();
    options.initial_plan = expected.plan;
    EXPECT_EQ(discrete::solve(later, options).error().code, ErrorCode::invalid_plan);
  }
  EXPECT_GE(solved, static_cast<int>(scaled(400) / 4));
}

TEST(TimeOriginDiscrete, PlansWithoutProofBeginThen) {
  LimitMonitor limits{Limits{}};
  int found = 0;
  for (std::uint32_t seed = 0; seed < 50; ++seed) {
    const discrete::Instance later = drawn(seed).with_now(77).value();
    const auto plan = discrete::find_plan(later, limits, 0);
    if (!plan) continue;
    ++found;
    EXPECT_TRUE(discrete::verify(later, *plan).valid()) << seed;
  }
  EXPECT_GT(found, 10);
}

TEST(TimeOriginDiscrete, FilesSayIt) {
  const auto later = drawn(3).with_now(12).value();
  std::stringstream file;
  ASSERT_FALSE(discrete::write_instance_json(file, "i.json", later));
  EXPECT_NE(file.str().find("\"now\": 12"), std::string::npos);
  EXPECT_EQ(discrete::read_instance_json(file, "i.json").value().now(), 12);

  LimitMonitor limits{Limits{}};
  const auto grid = discrete::Instance::make(discrete::Graph::grid(3, 1, {true, true, true}),
                                             {{VertexId(0), VertexId(2)}}, 12);
  const auto plan = discrete::find_plan(*grid, limits, 0).value();
  std::stringstream text;
  ASSERT_FALSE(
      discrete::write_plan(text, "p.json", grid->graph(), plan, discrete::PlanFormat::json));
  EXPECT_EQ(discrete::read_plan(text, "p.json", grid->graph()).value().plan, plan);
  for (const auto format : {discrete::PlanFormat::cbsh2, discrete::PlanFormat::visualizer,
                            discrete::PlanFormat::yaml}) {
    const auto error = discrete::write_plan(text, "p", grid->graph(), plan, format);
    ASSERT_TRUE(error);
    EXPECT_NE(error->message.find("begin at timestep 0, and this one at 12"), std::string::npos);
  }
  EXPECT_TRUE(discrete::write_instance_yaml(text, "i.yaml", *grid));
}

TEST(TimeOriginDiscrete, WhatIsOutOfRangeIsRefused) {
  const auto from_0 = drawn(3);
  for (const Timestep now : {-1, discrete::kMaxNow + 1})
    EXPECT_EQ(from_0.with_now(now).error().code, ErrorCode::out_of_range);
  std::stringstream file(
      "{\n\"quadrille\": \"instance\", \"version\": 1,\n\"now\": -3,\n"
      "\"graph\": {\"vertices\": 1, \"edges\": []}, \"agents\": []}");
  const auto read = discrete::read_instance_json(file, "i.json");
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().where.line, 3);
  // No plan is too broken.
  discrete::Plan plan{{}, INT32_MAX};
  plan.paths.push_back({VertexId(0), VertexId(0), VertexId(0)});
  EXPECT_FALSE(discrete::verify(from_0, plan).valid());
}

// Continuous time.

using continuous::Ticks;

bool is_proof(const continuous::SolveOutcome& outcome) {
  return outcome.status == Status::optimal || outcome.status == Status::infeasible;
}

continuous::Plan shifted(continuous::Plan plan, Ticks by) {
  for (auto& path : plan.paths)
    for (auto& stop : path) {
      stop.arrive += by;
      stop.depart += by;
    }
  return plan;
}

std::vector<continuous::MovingObstacle> shifted(std::vector<continuous::MovingObstacle> obstacles,
                                                Ticks by) {
  for (auto& obstacle : obstacles)
    for (auto& stop : obstacle.path) {
      stop.arrive += by;
      stop.depart += by;
    }
  return obstacles;
}

std::vector<continuous::Agent> shifted_agents(const continuous::Instance& instance, Ticks by) {
  std::vector<continuous::Agent> agents(instance.agents().begin(), instance.agents().end());
  for (continuous::Agent& agent : agents) {
    if (agent.release > 0) agent.release += by;
    if (agent.deadline) *agent.deadline += by;
  }
  return agents;
}

continuous::Instance shifted(const continuous::Instance& instance, Ticks by) {
  return continuous::Instance::make(instance.shared_roadmap(), shifted_agents(instance, by),
                                    instance.resolution(), {}, shifted(instance.obstacles(), by),
                                    instance.now() + by)
      .value();
}

continuous::test::RandomOptions shape(std::uint32_t seed) {
  continuous::test::RandomOptions options;
  options.num_agents = 2 + seed % 3;
  options.release_percent = options.deadline_percent = options.obstacles_percent = 40;
  options.under_way_percent = 20;
  options.goal_sets_percent = seed % 4 == 0 ? 40 : 0;
  return options;
}

Ticks drawn_ticks(std::uint32_t seed) {
  continuous::test::Draw draw(seed + 1000);
  return draw.chance(10) ? geometry::kMaxDuration - 100'000 : draw.ticks(1, 1000);
}

TEST(TimeOriginContinuous, AnswersAreThoseFrom0ButForTheTimes) {
  int solved = 0;
  for (std::uint32_t seed = 0; seed < scaled(100); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const auto from_0 = continuous::test::random_instance(seed, shape(seed));
    const Ticks now = drawn_ticks(seed);
    const auto later = shifted(from_0, now);
    auto options = options_for<continuous::SolveOptions>(seed);
    options.joint_work = options.route_work = seed % 2 == 0 ? 0 : 1'000'000;
    // Some have no plan, and the search does not end.
    options.limits.looks = 2000;
    const auto expected = continuous::solve(from_0, options).value();
    if (!is_proof(expected)) continue;
    options.limits.looks = 20'000;
    const auto outcome = continuous::solve(later, options).value();
    expect_same(expected, outcome, now.value());
    if (!outcome.plan) continue;
    ++solved;
    EXPECT_EQ(*outcome.plan, shifted(*expected.plan, now));
    EXPECT_TRUE(continuous::verify(later, *outcome.plan).valid());
    EXPECT_FALSE(continuous::verify(later, *expected.plan).valid());
    EXPECT_FALSE(continuous::verify(from_0, *outcome.plan).valid());
    using Verdict = continuous::SecondOpinion::Verdict;
    const auto opinion = continuous::ask_fcl(later, *outcome.plan);
    EXPECT_EQ(continuous::find_contradiction(true, opinion), "");
    EXPECT_EQ(continuous::ask_fcl(later, *expected.plan).verdict, Verdict::broken);
    EXPECT_EQ(opinion.verdict, continuous::ask_fcl(from_0, *expected.plan).verdict);
    options.initial_plan = options.debug.known_plan = outcome.plan;
    EXPECT_EQ(continuous::solve(later, options).value().cost, outcome.cost);
    options.debug.known_plan.reset();
    options.initial_plan = expected.plan;
    EXPECT_EQ(continuous::solve(later, options).error().code, ErrorCode::invalid_plan);
  }
  EXPECT_GE(solved, static_cast<int>(scaled(100) / 10));
}

/// An obstacle that goes by steps of whole lengths and ticks, begun before `now`, and the same cut
/// there.
std::pair<continuous::MovingObstacle, continuous::MovingObstacle> whole_and_cut(
    continuous::test::Draw& draw, Ticks now) {
  const auto coordinate = [&] { return draw.length(0, 40); };
  const std::int64_t steps = draw.number(1, 6), before = draw.number(0, steps);
  const Ticks of_step = draw.ticks(1, 8), waits = draw.ticks(0, 20);
  const auto dx = draw.length(-8, 8), dy = draw.length(-8, 8);
  continuous::Point from;
  from.x = coordinate();
  from.y = coordinate();
  const auto place = [&](std::int64_t k) {
    continuous::Point p = from;
    p.x += dx * k;
    p.y += dy * k;
    return p;
  };
  const Ticks depart = now - of_step * before, arrive = depart + of_step * steps;
  continuous::MovingObstacle whole{continuous::Disc{draw.length(1, 9)}, {}, draw.chance(50)};
  whole.path = {{from, depart - waits, depart}, {place(steps), arrive, arrive + 5}};
  continuous::MovingObstacle cut = whole;
  if (before < steps)
    cut.path = {{place(before), now, now}, {place(steps), arrive, arrive + 5}};
  else
    cut.path = {{place(steps), now, now + 5}};
  return {whole, cut};
}

TEST(TimeOriginContinuous, WhatObstaclesDidBeforeMeansNothing) {
  int solved = 0, refused = 0;
  constexpr Ticks kNow = 500;
  for (std::uint32_t seed = 0; seed < scaled(100); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    auto options = shape(seed);
    options.obstacles_percent = options.space_percent = 0;
    const auto plain = continuous::test::random_instance(seed, options);
    continuous::test::Draw draw(seed);
    const auto [whole, cut] = whole_and_cut(draw, kNow);
    const auto make = [&](const continuous::MovingObstacle& obstacle) {
      return continuous::Instance::make(plain.shared_roadmap(), shifted_agents(plain, kNow),
                                        plain.resolution(), {}, {obstacle}, kNow);
    };
    const auto a = make(whole), b = make(cut);
    ASSERT_EQ(a.has_value(), b.has_value());
    if (!a) {
      EXPECT_EQ(a.error().message, b.error().message);
      ++refused;
      continue;
    }
    auto asked = options_for<continuous::SolveOptions>(seed);
    asked.joint_work = asked.route_work = seed % 2 == 0 ? 0 : 1'000'000;
    asked.limits.looks = 2000;
    const auto expected = continuous::solve(*b, asked).value();
    if (!is_proof(expected)) continue;
    asked.limits.looks = 20'000;
    const auto outcome = continuous::solve(*a, asked).value();
    ASSERT_FALSE(outcome.internal_error) << outcome.internal_error->message;
    EXPECT_EQ(outcome.status, expected.status);
    EXPECT_EQ(outcome.cost, expected.cost);
    EXPECT_EQ(outcome.lower_bound, expected.lower_bound);
    if (!outcome.plan) continue;
    ++solved;
    EXPECT_TRUE(continuous::verify(*a, *expected.plan).valid());
    EXPECT_TRUE(continuous::verify(*b, *outcome.plan).valid());
  }
  EXPECT_GE(solved, static_cast<int>(scaled(100) / 10));
  EXPECT_GE(refused, static_cast<int>(scaled(100) / 50));
}

TEST(TimeOriginContinuous, SessionsAnswerAsSolveDoes) {
  for (std::uint32_t seed = 0; seed < scaled(15); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    auto kind = shape(seed);
    kind.under_way_percent = 0;
    const Ticks now = drawn_ticks(seed);
    const auto later = shifted(continuous::test::random_instance(seed, kind), now);
    continuous::Session session(later.shared_roadmap(), later.resolution(), later.obstacles(), now);
    continuous::SolveOptions options;
    options.limits.conflicts = 300;
    options.joint_work = options.route_work = 0;
    options.limits.looks = 2000;
    std::vector<continuous::MemberId> members;
    for (const auto& agent : later.agents()) {
      members.push_back(session.add(agent).value());
      const auto instance = session.instance();
      if (!instance) continue;
      EXPECT_EQ(instance->now(), now);
      const auto fresh = continuous::solve(*instance, options).value();
      for (int again = 0; again < 2; ++again) {
        const auto outcome = session.solve(options).value();
        ASSERT_FALSE(outcome.internal_error) << outcome.internal_error->message;
        if (fresh.status != Status::optimal || outcome.status != Status::optimal) continue;
        EXPECT_EQ(outcome.cost, fresh.cost);
        EXPECT_TRUE(continuous::verify(*instance, *outcome.plan).valid());
      }
    }
  }
}

TEST(TimeOriginContinuous, FilesSayIt) {
  const auto later = shifted(continuous::test::random_instance(7, {}), 1500);
  std::stringstream file;
  ASSERT_FALSE(continuous::write_instance_json(file, "i.json", later));
  const auto read = continuous::read_instance_json(file, "i.json");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->now(), later.now());
  continuous::SolveOptions options;
  options.limits.conflicts = 300;
  const auto outcome = continuous::solve(later, options).value();
  ASSERT_TRUE(outcome.plan);
  std::stringstream text;
  ASSERT_FALSE(
      continuous::write_plan(text, "p.json", later, *outcome.plan, continuous::PlanFormat::json));
  EXPECT_EQ(continuous::read_plan(text, "p.json", *read).value().plan, *outcome.plan);
  const auto error =
      continuous::write_plan(text, "p.xml", later, *outcome.plan, continuous::PlanFormat::ccbs);
  ASSERT_TRUE(error);
  EXPECT_NE(error->message.find("does not begin at tick 0"), std::string::npos);
}

TEST(TimeOriginContinuous, WhatIsWrongIsRefused) {
  const auto from_0 = continuous::test::random_instance(7, {});
  std::vector<continuous::Agent> agents(from_0.agents().begin(), from_0.agents().end());
  const auto made = [&](Ticks now) {
    return continuous::Instance::make(from_0.shared_roadmap(), agents, from_0.resolution(), {}, {},
                                      now);
  };
  for (const Ticks now : {Ticks{-1}, geometry::kMaxDuration + 1})
    EXPECT_EQ(made(now).error().code, ErrorCode::out_of_range);
  agents[0].deadline = Ticks{99};
  const auto late = made(100);
  ASSERT_FALSE(late);
  EXPECT_EQ(late.error().code, ErrorCode::no_plan);
  EXPECT_NE(late.error().message.find("its deadline is"), std::string::npos);
}

}  // namespace
}  // namespace quadrille
