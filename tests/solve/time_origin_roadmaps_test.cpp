// SPDX-License-Identifier: MIT
// See time_origin.hpp.
#include <gtest/gtest.h>

#include <cstdint>
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
#include "solve/time_origin.hpp"
#include "support/environment.hpp"

namespace quadrille {
namespace {

using support::expect_same;
using support::options_for;
using support::scaled;

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
  EXPECT_GE(solved, static_cast<int>(scaled(100) / 20));
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
