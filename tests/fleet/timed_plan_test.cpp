// SPDX-License-Identifier: MIT
#include "quadrille/fleet/timed_plan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "fleet/support.hpp"
#include "quadrille/continuous/solver.hpp"
#include "support/environment.hpp"
#include "support/random.hpp"

namespace quadrille::fleet {
namespace {

using namespace quadrille::units;
using quadrille::support::Random;

const VertexId kA(0), kB(1), kC(2);

/// From a to b, where it waits, to c and back to b. At 2 m/s and 50 ms a step, a lane takes 10.
TimedPlan there_and_back() {
  Fleet fleet(test::line(3, {.length = 1_mm, .time = 50_ms}));
  fleet.robot({.name = "r", .body = Disc(0.3_m), .speed = 2_mps}).from(kA).to(kB);
  return TimedPlan::make(fleet,
                         {{continuous::Path{{kA, 0, 4}, {kB, 14, 20}, {kC, 30, 30}, {kB, 40, 40}}}})
      .value();
}

TEST(TimedPlan, StopsWaitsAndCosts) {
  const TimedPlan plan = there_and_back();
  const TimedPath& path = plan[AgentId(0)];
  EXPECT_EQ(path.name(), "r");
  EXPECT_EQ(path.stops(), (std::vector<Stop>{{kA, {0_m, 0_m}, 0_s, 0.2_s},
                                             {kB, {1_m, 0_m}, 0.7_s, 1_s},
                                             {kC, {2_m, 0_m}, 1.5_s, 1.5_s},
                                             {kB, {1_m, 0_m}, 2_s, 2_s}}));
  EXPECT_EQ(path.waits(), (std::vector<Wait>{{kA, 0_s, 0.2_s}, {kB, 0.7_s, 1_s}}));
  EXPECT_EQ(path.cost(), 2_s);
  EXPECT_EQ(path.free_cost(), 0.5_s);
  EXPECT_EQ(path.delay(), 1.5_s);
  EXPECT_EQ(plan.makespan(), 2_s);
  EXPECT_EQ(plan.sum_of_costs(), 2_s);
  EXPECT_EQ(plan.delay(), 1.5_s);
  EXPECT_FALSE(plan.least_clearance().has_value());
  EXPECT_EQ(plan.summary(),
            "r: 2 s, 1.5 s more than alone, 2 waits\n"
            "sum of costs 2 s, makespan 2 s, delay 1.5 s\n");
}

TEST(TimedPlan, PositionAndVelocity) {
  const TimedPlan plan = there_and_back();
  const TimedPath& path = plan[AgentId(0)];
  const auto x = [&](Seconds t) { return path.at(t).x.value(); };
  const auto v = [&](Seconds t) { return path.velocity(t).x.value(); };
  EXPECT_EQ(x(-1_s), 0);
  EXPECT_EQ(x(0_s), 0);
  EXPECT_EQ(x(0.2_s), 0);
  EXPECT_NEAR(x(0.45_s), 0.5, 1e-12);
  EXPECT_EQ(x(0.7_s), 1);
  EXPECT_EQ(x(0.9_s), 1);
  EXPECT_NEAR(x(1.25_s), 1.5, 1e-12);
  EXPECT_EQ(x(1.5_s), 2);
  EXPECT_NEAR(x(1.75_s), 1.5, 1e-12);
  EXPECT_EQ(x(2_s), 1);
  EXPECT_EQ(x(1e9 * 1_s), 1);
  // At the moment of a change, what comes after it.
  EXPECT_EQ(v(-1_s), 0);
  EXPECT_EQ(v(0.1_s), 0);
  EXPECT_NEAR(v(0.2_s), 2, 1e-12);
  EXPECT_NEAR(v(0.69_s), 2, 1e-12);
  EXPECT_EQ(v(0.7_s), 0);
  EXPECT_NEAR(v(1_s), 2, 1e-12);
  EXPECT_NEAR(v(1.5_s), -2, 1e-12);
  EXPECT_EQ(v(2_s), 0);
}

TEST(TimedPlan, SamplesEndWithTheFirstOneAtTheGoal) {
  const TimedPlan plan = there_and_back();
  const TimedPath& path = plan[AgentId(0)];
  EXPECT_EQ(path.samples(20_Hz).size(), 41u);
  EXPECT_EQ(path.samples(0.3_Hz).size(), 2u);
  EXPECT_EQ(path.samples(20_Hz, 3_s).size(), 61u);
  EXPECT_EQ(path.samples(20_Hz, 0_s).size(), 1u);
  const Sample last = path.samples(0.3_Hz).back();
  EXPECT_EQ(last.position, (Point{1_m, 0_m}));
  EXPECT_EQ(last.velocity, Velocity{});
  EXPECT_EQ(last.time, Seconds(1 / 0.3));
}

TEST(TimedPlan, RefusesWhatIsNoPlan) {
  Fleet fleet(test::line(2));
  fleet.robot({.name = "r", .body = Disc(0.3_m), .speed = 1_mps}).from(kA).to(kB);
  const auto made = TimedPlan::make(fleet, {{continuous::Path{{kA, 0, 0}, {kB, 99, 99}}}});
  ASSERT_FALSE(made.has_value());
  EXPECT_EQ(made.error().code, ErrorCode::invalid_plan);
  EXPECT_EQ(made.error().message,
            "'r' takes longer or shorter for a lane than it does at its speed, at 0 s");
}

/// A walk with waits of one robot over a random roadmap, which ends at its goal.
continuous::Plan random_walk(Random& random, const continuous::Instance& instance) {
  const continuous::Roadmap& roads = instance.roadmap();
  const AgentId robot(0);
  continuous::Path path{{instance.agent(robot).start, 0, 0}};
  const auto done = [&](std::size_t moves) {
    return moves >= 4 && path.back().vertex == instance.agent(robot).goal();
  };
  for (std::size_t moves = 0; !done(moves); ++moves) {
    if (random.percent(40))
      path.back().depart += continuous::Ticks(static_cast<std::int64_t>(random.below(300)));
    const auto out = roads.out_edges(path.back().vertex);
    const continuous::EdgeId e = out[random.below(out.size())];
    const continuous::Ticks arrive =
        path.back().depart + instance.duration(instance.class_of(robot), e);
    path.push_back({roads.edge(e).to, arrive, arrive});
  }
  continuous::Plan plan;
  plan.paths.push_back(std::move(path));
  return plan;
}

/// Position and velocity by a look at each stop, in whole units and long doubles.
struct Exact {
  long double x, y, vx, vy;  // Length units, and those per tick.
};
Exact by_hand(const continuous::Instance& instance, const continuous::Path& path,
              long double tick) {
  for (std::size_t k = 0; k + 1 < path.size(); ++k) {
    const auto depart = static_cast<long double>(path[k].depart.value());
    const auto arrive = static_cast<long double>(path[k + 1].arrive.value());
    const auto& p = instance.roadmap().position(path[k].vertex);
    const auto& q = instance.roadmap().position(path[k + 1].vertex);
    const auto px = static_cast<long double>(p.x.value()),
               py = static_cast<long double>(p.y.value());
    if (tick < depart) return {px, py, 0, 0};
    if (tick >= arrive) continue;
    const long double vx = static_cast<long double>((q.x - p.x).value()) / (arrive - depart);
    const long double vy = static_cast<long double>((q.y - p.y).value()) / (arrive - depart);
    return {px + (tick - depart) * vx, py + (tick - depart) * vy, vx, vy};
  }
  const auto& p = instance.roadmap().position(path.back().vertex);
  return {static_cast<long double>(p.x.value()), static_cast<long double>(p.y.value()), 0, 0};
}

TEST(TimedPlan, RandomWalksAreWhereTheIntegersSay) {
  const std::size_t rounds = support::scaled(400);
  for (std::uint32_t seed = 0; seed < rounds; ++seed) {
    SCOPED_TRACE(seed);
    const Fleet fleet = test::random_fleet(seed, 1);
    const auto instance = fleet.instance();
    ASSERT_TRUE(instance.has_value());
    Random random(seed + 1000);
    const continuous::Plan plan = random_walk(random, *instance);
    const auto made = TimedPlan::make(fleet, plan);
    ASSERT_TRUE(made.has_value()) << made.error().message;
    const TimedPath& path = (*made)[AgentId(0)];
    const double tick = instance->resolution().time, unit = instance->resolution().length;
    const auto agrees = [&](Seconds time, const Point& position, const Velocity& velocity,
                            long double at) {
      const Exact exact = by_hand(*instance, plan.paths[AgentId(0)], at);
      EXPECT_NEAR(position.x.value(), static_cast<double>(exact.x * unit), 1e-9) << time.value();
      EXPECT_NEAR(position.y.value(), static_cast<double>(exact.y * unit), 1e-9) << time.value();
      EXPECT_NEAR(velocity.x.value(), static_cast<double>(exact.vx * unit / tick), 1e-9)
          << time.value();
      EXPECT_NEAR(velocity.y.value(), static_cast<double>(exact.vy * unit / tick), 1e-9)
          << time.value();
    };
    // 1/rate is a whole number of ticks, so that moments of change are sampled, too.
    const Hertz rate(tick == 0.01 ? 100 : 20);
    const std::vector<Sample> samples = path.samples(rate);
    for (std::size_t k = 0; k < samples.size(); ++k) {
      agrees(samples[k].time, samples[k].position, samples[k].velocity,
             static_cast<long double>(k));
      EXPECT_EQ(path.at(samples[k].time), samples[k].position);
      EXPECT_EQ(path.velocity(samples[k].time), samples[k].velocity);
    }
    EXPECT_EQ(samples.size(),
              static_cast<std::size_t>(plan.paths[AgentId(0)].back().arrive.value()) + 1);
    for (int query = 0; query < 50; ++query) {
      // Never a moment of change, whose last bit would decide.
      const double at = (static_cast<double>(random.below(100'000)) + 0.5) / 37;
      const Seconds time(at * tick);
      agrees(time, path.at(time), path.velocity(time),
             static_cast<long double>(time.value()) / tick);
    }
  }
}

/// For discs: the free space between two robots at a moment.
double gap(const TimedPlan& plan, const Fleet& fleet, AgentId a, AgentId b, Seconds time) {
  const auto radius = [&](AgentId i) { return std::get<Disc>(fleet.spec(i).body).radius; };
  return (distance(plan[a].at(time), plan[b].at(time)) - radius(a) - radius(b)).value();
}

TEST(TimedPlan, ClearancesOfSolvedFleetsAreWhatTheSamplesShow) {
  const std::size_t rounds = support::scaled(60);
  std::size_t pairs = 0;
  for (std::uint32_t seed = 0; seed < rounds; ++seed) {
    SCOPED_TRACE(seed);
    const Fleet fleet = test::random_fleet(seed, 3);
    const auto instance = fleet.instance();
    if (!instance) continue;
    continuous::SolveOptions options;
    options.limits.conflicts = 500;
    options.joint_work = 2'000'000;
    const auto outcome = continuous::solve(*instance, options).value();
    if (!outcome.plan) continue;
    const TimedPlan plan = TimedPlan::make(fleet, *outcome.plan).value();
    const VerifyReport report = verify(fleet, *outcome.plan, continuous::kAllClearances).value();
    Seconds sum, most, delay;
    for (const AgentId i : plan.robot_ids()) {
      sum += plan[i].cost();
      delay += plan[i].delay();
      most = std::max(most, plan[i].cost());
      EXPECT_GE(plan[i].delay(), 0_s);
      EXPECT_NEAR((plan[i].cost() - plan[i].free_cost()).value(), plan[i].delay().value(), 1e-9);
    }
    EXPECT_NEAR(plan.sum_of_costs().value(), sum.value(), 1e-9);
    EXPECT_NEAR(plan.delay().value(), delay.value(), 1e-9);
    EXPECT_EQ(plan.makespan(), most);
    for (const Clearance& clearance : report.clearances) {
      EXPECT_LE(plan.least_clearance()->gap, clearance.gap);
      if (!std::holds_alternative<Disc>(fleet.spec(clearance.robot).body) ||
          !std::holds_alternative<Disc>(fleet.spec(clearance.other).body))
        continue;
      ++pairs;
      const auto at = [&](Seconds time) {
        return gap(plan, fleet, clearance.robot, clearance.other, time);
      };
      EXPECT_NEAR(at(clearance.time), clearance.gap.value(), 1e-9);
      for (int k = 0; k <= 200; ++k)
        EXPECT_GE(at(k / 200.0 * plan.makespan()), clearance.gap.value() - 1e-9);
    }
  }
  EXPECT_GE(pairs, rounds / 3);
}

}  // namespace
}  // namespace quadrille::fleet
