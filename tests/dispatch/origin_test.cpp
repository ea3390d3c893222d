// SPDX-License-Identifier: MIT
//
// From wherever robots are that obey the rule, however late, there is a plan, if those that are
// ahead may wait within their lanes; and none of it rests on rounding.
#include "origin.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "dispatch/simulated_fleet.hpp"
#include "dispatch/towns.hpp"
#include "quadrille/continuous/solver.hpp"
#include "quadrille/continuous/verify.hpp"
#include "support/environment.hpp"

namespace quadrille::dispatch::test {
namespace {

struct State {
  std::vector<Course> courses;
  std::vector<Ticks> clocks, limits;
};

State state_of(const Dispatcher& dispatcher) {
  State state;
  for (std::size_t i = 0; i < dispatcher.num_robots(); ++i) {
    state.courses.push_back(dispatcher.course(AgentId(i)));
    state.clocks.push_back(dispatcher.clock(AgentId(i)));
    state.limits.push_back(dispatcher.limit(AgentId(i)));
  }
  return state;
}

TEST(NewOrigin, WhoeverIsLateThereIsAPlan) {
  constexpr std::uint32_t kSteps = 500;
  const std::size_t num_fleets = support::scaled(20);
  std::size_t num_plans = 0, num_in_lanes = 0, num_waits = 0, num_solved = 0;
  for (std::uint32_t seed = 0; seed < num_fleets; ++seed) {
    const auto roadmap = grid(5, 4, 180, seed);
    const auto robots = robots_on(*roadmap, 7, seed, 330);
    Options options;
    options.improves = false;
    options.patience = 1'000'000;  // Only here plans begin anew.
    SimulatedFleet fleet(roadmap, robots, options, {4, 60, {}}, seed);
    support::Random random(seed);
    for (std::uint32_t step = 0; step < kSteps; ++step) {
      for (std::size_t i = 0; i < robots.size(); ++i)
        if (fleet.dispatcher().num_tasks(AgentId(i)) == 0)
          static_cast<void>(fleet.dispatcher().assign(AgentId(i), {VertexId(random.below(20))}));
      static_cast<void>(fleet.step(7));
      const State state = state_of(fleet.dispatcher());
      // As far as they have got, and as far as they may.
      for (const std::vector<Ticks>& reached : {state.clocks, state.limits}) {
        const NewOrigin made =
            move_origin(state.courses, state.clocks, reached, fleet.dispatcher().now());
        const auto snapshot =
            take_snapshot_of_ends(roadmap, {}, robots, made.courses, fleet.dispatcher().now());
        ASSERT_TRUE(snapshot.has_value())
            << seed << ", " << step << ": " << snapshot.error().message;
        const auto report = continuous::verify(snapshot->instance, snapshot->plan);
        ASSERT_TRUE(report.valid())
            << seed << ", " << step << ": " << report.violations.front().message;
        ++num_plans;
        for (const AgentId i : snapshot->instance.agent_ids()) {
          const auto& begin = snapshot->plan.paths[i].front();
          const bool is_in_lane = snapshot->instance.roadmap().lane_place(begin.vertex) != nullptr;
          num_in_lanes += is_in_lane ? 1 : 0;
          num_waits += is_in_lane && begin.depart > begin.arrive ? 1 : 0;
        }
        if (step % 50 > 0) continue;
        continuous::SolveOptions asked;
        asked.gap_percent = 1e9;
        asked.limits.conflicts = 2'000;
        const auto outcome = continuous::solve(snapshot->instance, asked);
        ASSERT_NE(outcome.value().status, Status::infeasible) << seed << ", " << step;
        num_solved += outcome->plan ? 1 : 0;
      }
    }
  }
  RecordProperty("plans", static_cast<int>(num_plans));
  EXPECT_EQ(num_plans, 2 * num_fleets * kSteps);
  EXPECT_GT(num_in_lanes, num_plans);
  EXPECT_GT(num_waits, num_plans / 2);
  EXPECT_GT(num_solved, 2 * num_fleets * kSteps / 50 / 2);
}

}  // namespace
}  // namespace quadrille::dispatch::test
