// SPDX-License-Identifier: MIT
#include "quadrille/dispatch/dispatcher.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "dispatch/simulated_fleet.hpp"
#include "dispatch/towns.hpp"
#include "quadrille/continuous/under_way.hpp"
#include "support/environment.hpp"

namespace quadrille::dispatch::test {
namespace {

using continuous::Agent;

Options quick() {
  Options options;
  options.effort = Effort::microseconds(3'000);
  options.improves = false;
  return options;
}

/// Everybody always has a task; the number of those that were done.
struct Tally {
  std::size_t num_served = 0, longest_idle = 0, num_origins = 0, num_too_late = 0;
};

Tally run_for(SimulatedFleet& fleet, std::size_t steps, Ticks duration, std::uint64_t seed,
              std::size_t num_places) {
  support::Random random(seed);
  Tally run;
  Dispatcher& dispatcher = fleet.dispatcher();
  for (std::size_t step = 0; step < steps; ++step) {
    for (std::size_t i = 0; i < dispatcher.num_robots(); ++i) {
      if (dispatcher.num_tasks(AgentId(i)) > 0) continue;
      const Task task{VertexId(random.below(num_places)),
                      Ticks(static_cast<std::int64_t>(random.below(30)))};
      EXPECT_FALSE(dispatcher.assign(AgentId(i), task));
    }
    const News news = fleet.step(duration);
    run.num_served += news.served.size();
    run.num_origins += news.has_new_origin ? 1 : 0;
    run.num_too_late += news.was_too_late ? 1 : 0;
    EXPECT_LE(news.lower_bound, news.cost);
    if (fleet.referee().num_contacts() > 0) {
      ADD_FAILURE() << "contact in step " << step << ", gap " << fleet.referee().least_gap();
      break;
    }
    for (std::size_t i = 0; i < dispatcher.num_robots(); ++i)
      run.longest_idle = std::max(run.longest_idle, fleet.idle(AgentId(i)));
  }
  return run;
}

TEST(Dispatcher, SendsRobotsToTheirGoals) {
  const auto roadmap = grid(5, 4, 0, 1);
  SimulatedFleet fleet(roadmap, robots_on(*roadmap, 6, 1), quick(), {}, 1);
  const Tally run = run_for(fleet, support::scaled(600), 10, 1, 20);
  EXPECT_EQ(fleet.referee().num_contacts(), 0U);
  EXPECT_GT(run.num_served,
            support::scaled(300));  // a way of three lanes takes four calls, and six go at once
  EXPECT_LT(run.longest_idle, 60U);
}

// Roads of uneven length, so that places in the middle of moves are nowhere whole; robots of two
// sizes and speeds, 30 % of the time held up.
TEST(Dispatcher, KeepsRobotsApartThatAreLate) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const auto roadmap = grid(6, 5, 150, seed);
    Options options = quick();
    options.improves = seed == 4;
    SimulatedFleet fleet(roadmap, robots_on(*roadmap, 10, seed), options, {2, 40, {}}, seed);
    const Tally run = run_for(fleet, support::scaled(800), 10, seed, 30);
    EXPECT_EQ(fleet.referee().num_contacts(), 0U) << seed;
    EXPECT_GT(run.num_served, support::scaled(800) / 4) << seed;
    EXPECT_GT(run.num_origins, support::scaled(800) / 40) << seed;
    EXPECT_LT(run.longest_idle, 200U) << seed;
  }
}

TEST(Dispatcher, HasAPlanWithoutTimeToMakeOne) {
  const auto roadmap = grid(5, 4, 100, 5);
  Options none;
  none.effort = Effort();
  SimulatedFleet still(roadmap, robots_on(*roadmap, 6, 5), none, {}, 5);
  EXPECT_EQ(run_for(still, 50, 10, 5, 20).num_served, 0U);
  // A deadline that is over ends the search, and nothing else.
  SimulatedFleet hasty(roadmap, robots_on(*roadmap, 6, 5), {}, {3, 20, {}}, 5);
  Limits over;
  over.wall_s = 0;
  for (int round = 0; round < 20; ++round) {
    static_cast<void>(run_for(hasty, 10, 10, static_cast<std::uint64_t>(round), 20));
    for (int k = 0; k < 10; ++k) {
      const News news = hasty.step(10, over);
      EXPECT_EQ(news.num_sent, 0U);
    }
  }
  EXPECT_EQ(hasty.referee().num_contacts(), 0U);
}

TEST(Dispatcher, GoesOnWhereRobotsStopForEver) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const auto roadmap = grid(7, 6, 150, seed);
    Delays delays{1, 20, std::vector<Ticks>(9, -1)};
    delays.breaks[0] = 333;
    delays.breaks[4] = 1'007;
    SimulatedFleet fleet(roadmap, robots_on(*roadmap, 9, seed), quick(), delays, seed);
    const Tally early = run_for(fleet, 150, 10, seed, 42);
    const Tally late = run_for(fleet, support::scaled(200), 10, seed, 42);
    EXPECT_EQ(fleet.referee().num_contacts(), 0U) << seed;
    EXPECT_GT(early.num_served + late.num_served, 0U) << seed;
  }
}

/// Lanes that a robot enters on its course between these times of its clock.
std::vector<std::pair<VertexId, VertexId>> lanes_entered(const Course& course, Ticks from,
                                                         Ticks until) {
  std::vector<std::pair<VertexId, VertexId>> lanes;
  for (std::size_t k = 0; k + 1 < course.size(); ++k) {
    const Spot &here = course[k].spot, &next = course[k + 1].spot;
    if (here.is_vertex() && course[k].depart >= from && course[k].depart < until)
      lanes.emplace_back(here.from, next.is_vertex() ? next.from : next.to);
  }
  return lanes;
}

// Lanes are closed under robots that are about to enter them, or are there.
TEST(Dispatcher, NobodyEntersLanesThatAreClosed) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const auto roadmap = grid(6, 5, 150, seed);
    const std::size_t n = 8;
    Options options = quick();
    options.improves = seed == 2;
    SimulatedFleet fleet(roadmap, robots_on(*roadmap, n, seed), options, {seed < 3 ? 0 : 2, 40, {}},
                         seed);
    Dispatcher& dispatcher = fleet.dispatcher();
    support::Random random(seed);
    using Lane = std::pair<VertexId, VertexId>;
    std::set<Lane> closed;
    std::set<std::pair<std::size_t, Lane>> allowed;  // when it was closed
    std::size_t num_served = 0, num_barred = 0, longest_idle = 0;
    const auto run = [&](std::size_t steps, bool closes) {
      for (std::size_t step = 0; step < steps; ++step) {
        if (closes && step % 7 == 0) {
          // A lane that somebody is going to use, if there is one.
          const AgentId robot(random.below(n));
          const auto ahead = lanes_entered(dispatcher.course(robot), dispatcher.clock(robot),
                                           Ticks(1'000'000'000));
          const Lane lane = ahead.empty() ? Lane(VertexId(step % 29), VertexId(step % 29 + 1))
                                          : random.pick(ahead);
          if (!dispatcher.close(lane.first, lane.second)) {
            closed.insert(lane);
            for (std::size_t i = 0; i < n; ++i) {
              const Course& course = dispatcher.course(AgentId(i));
              const Ticks limit = dispatcher.limit(AgentId(i));
              const auto now = lanes_entered(course, dispatcher.clock(AgentId(i)), limit);
              const auto later = lanes_entered(course, limit, Ticks(1'000'000'000));
              if (std::count(now.begin(), now.end(), lane) > 0) allowed.emplace(i, lane);
              num_barred += std::count(later.begin(), later.end(), lane) > 0 ? 1 : 0;
            }
          }
          if (closed.size() > 10) {
            const std::vector<Lane> all(closed.begin(), closed.end());
            const Lane one = random.pick(all);
            EXPECT_FALSE(dispatcher.open(one.first, one.second));
            closed.erase(one);
            std::erase_if(allowed, [&](const auto& entry) { return entry.second == one; });
          }
        }
        for (std::size_t i = 0; i < n; ++i) {
          if (dispatcher.num_tasks(AgentId(i)) > 0) continue;
          EXPECT_FALSE(dispatcher.assign(AgentId(i), {VertexId(random.below(30)), 5}));
        }
        num_served += fleet.step(10).served.size();
        for (std::size_t i = 0; i < n; ++i) {
          longest_idle = std::max(longest_idle, fleet.idle(AgentId(i)));
          for (const Lane& lane :
               lanes_entered(dispatcher.course(AgentId(i)), dispatcher.clock(AgentId(i)),
                             dispatcher.limit(AgentId(i))))
            EXPECT_TRUE(!closed.contains(lane) || allowed.contains({i, lane}))
                << seed << " step " << step << " robot " << i;
        }
      }
    };
    run(support::scaled(600), true);
    EXPECT_EQ(fleet.referee().num_contacts(), 0U) << seed;
    EXPECT_GT(num_served, support::scaled(600) / 5) << seed;
    EXPECT_GT(num_barred, support::scaled(600) / 60) << seed;
    for (const Lane& lane : closed) EXPECT_FALSE(dispatcher.open(lane.first, lane.second));
    closed.clear();
    const std::size_t before = num_served;
    run(200, false);
    EXPECT_GT(num_served, before + 20) << seed;
    EXPECT_EQ(fleet.referee().num_contacts(), 0U) << seed;
    EXPECT_LT(longest_idle, support::scaled(600)) << seed;
  }
}

TEST(Dispatcher, GoalsBehindClosedLanesWait) {
  const auto roadmap = grid(4, 1, 0, 1);
  std::vector<Agent> robots = robots_on(*roadmap, 1, 1);
  robots[0].start = VertexId(0);
  SimulatedFleet fleet(roadmap, robots, quick(), {}, 1);
  Dispatcher& dispatcher = fleet.dispatcher();
  EXPECT_FALSE(dispatcher.assign(AgentId(0), {VertexId(3)}));
  static_cast<void>(fleet.step(5));
  EXPECT_FALSE(dispatcher.close(VertexId(1), VertexId(2)));
  for (int t = 0; t < 60; ++t) EXPECT_TRUE(fleet.step(10).served.empty());
  EXPECT_EQ(dispatcher.course(AgentId(0)).back().spot, Spot(VertexId(1)));
  EXPECT_FALSE(dispatcher.open(VertexId(1), VertexId(2)));
  std::size_t served = 0;
  for (int t = 0; t < 60; ++t) served += fleet.step(10).served.size();
  EXPECT_EQ(served, 1U);
  EXPECT_EQ(dispatcher.close(VertexId(0), VertexId(2))->message,
            "there is not the lane from vertex 0 to vertex 2");
  EXPECT_EQ(dispatcher.open(VertexId(0), VertexId(1))->message,
            "the lane from vertex 0 to vertex 1 is not closed");
}

TEST(Dispatcher, OnePlaceIsForOneAtATime) {
  const auto roadmap = grid(4, 3, 0, 1);
  SimulatedFleet fleet(roadmap, robots_on(*roadmap, 4, 3), {}, {}, 3);
  Dispatcher& dispatcher = fleet.dispatcher();
  const VertexId station(5);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_FALSE(dispatcher.assign(AgentId(i), {station, 40}));
    EXPECT_FALSE(dispatcher.assign(AgentId(i), {VertexId(2 * i), 0}));
  }
  std::vector<AgentId> served;
  for (int step = 0; step < 200; ++step)
    for (const AgentId robot : fleet.step(10).served) served.push_back(robot);
  EXPECT_EQ(served.size(), 8U);
  EXPECT_EQ(fleet.referee().num_contacts(), 0U);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(dispatcher.num_tasks(AgentId(i)), 0U);
    EXPECT_EQ(dispatcher.course(AgentId(i)).back().spot, Spot(VertexId(2 * i)));
  }
}

// The other one has to go by where the first one is sent to, in the same call.
TEST(Dispatcher, NobodyIsPushedAwayFromWhereItHasJustBeenSent) {
  const auto roadmap = grid(5, 1, 0, 1);
  std::vector<Agent> robots = robots_on(*roadmap, 2, 3);
  robots[0].start = VertexId(0);
  robots[1].start = VertexId(1);
  SimulatedFleet fleet(roadmap, robots, {}, {}, 3);
  Dispatcher& dispatcher = fleet.dispatcher();
  EXPECT_FALSE(dispatcher.assign(AgentId(0), {VertexId(3)}));
  EXPECT_FALSE(dispatcher.assign(AgentId(1), {VertexId(2), 0, Ticks(100)}));
  static_cast<void>(fleet.step(10));
  EXPECT_EQ(dispatcher.course(AgentId(1)).back().spot, Spot(VertexId(2)));
  EXPECT_EQ(dispatcher.course(AgentId(0)).back().spot, Spot(VertexId(0)));
  std::vector<AgentId> served;
  for (int step = 0; step < 60; ++step)
    for (const AgentId robot : fleet.step(10).served) served.push_back(robot);
  EXPECT_EQ(served, (std::vector{AgentId(1), AgentId(0)}));
}

TEST(Dispatcher, WhoIsUrgentGoesFirst) {
  const auto roadmap = grid(3, 2, 0, 1);
  std::vector<Agent> robots = robots_on(*roadmap, 2, 3);
  robots[0].start = VertexId(0);
  robots[1].start = VertexId(2);
  for (const bool is_second_urgent : {false, true}) {
    SimulatedFleet fleet(roadmap, robots, {}, {}, 3);
    EXPECT_FALSE(fleet.dispatcher().assign(AgentId(0), {VertexId(1), 100}));
    EXPECT_FALSE(fleet.dispatcher().assign(
        AgentId(1),
        {VertexId(1), 100, is_second_urgent ? std::optional(Ticks(50)) : std::nullopt}));
    std::vector<AgentId> served;
    for (int step = 0; step < 60; ++step)
      for (const AgentId robot : fleet.step(10).served) served.push_back(robot);
    // Both are done there: whoever is done and idle steps aside.
    ASSERT_EQ(served.size(), 2U);
    EXPECT_EQ(served.front(), AgentId(is_second_urgent ? 1 : 0));
  }
}

TEST(Dispatcher, SaysTheSameAgain) {
  const auto roadmap = grid(6, 5, 150, 7);
  std::vector<Course> courses[2];
  for (std::vector<Course>& end : courses) {
    SimulatedFleet fleet(roadmap, robots_on(*roadmap, 9, 7), {}, {2, 30, {}}, 7);
    static_cast<void>(run_for(fleet, 60, 10, 7, 30));
    for (std::size_t i = 0; i < 9; ++i) end.push_back(fleet.dispatcher().course(AgentId(i)));
  }
  EXPECT_EQ(courses[0], courses[1]);
}

TEST(Dispatcher, RefusesWhatMakesNoSense) {
  const auto roadmap = grid(3, 2, 0, 1);
  std::vector<Agent> robots = robots_on(*roadmap, 2, 1);
  robots[1].start = robots[0].start;
  EXPECT_EQ(Dispatcher::make(roadmap, robots).error().message,
            "the starts of agents 0 and 1 overlap");
  continuous::RoadmapParts parts(*roadmap);
  parts.no_waiting = {VertexId(5)};
  const auto passed = std::make_shared<const continuous::Roadmap>(std::move(parts).make().value());
  EXPECT_EQ(Dispatcher::make(passed, robots_on(*roadmap, 2, 1)).error().message,
            "places where nobody may wait are not supported here: who is late waits");
  Dispatcher dispatcher = Dispatcher::make(roadmap, robots_on(*roadmap, 2, 1)).value();
  EXPECT_EQ(dispatcher.assign(AgentId(2), {VertexId(0)})->message, "there is no robot 2");
  EXPECT_EQ(dispatcher.assign(AgentId(1), {VertexId(6)})->message,
            "robot 1: agent 0 names vertex 6, but there are 6 vertices");
  EXPECT_EQ(dispatcher.assign(AgentId(1), {VertexId(0), -1})->message,
            "the task of robot 1 has a time that is negative or too long");
  EXPECT_EQ(dispatcher.report(AgentId(0), 1)->message,
            "robot 0 has gone on to 1, and was allowed to go to 0");
  static_cast<void>(dispatcher.tick(10));
  EXPECT_FALSE(dispatcher.report(AgentId(0), 10));
  EXPECT_EQ(dispatcher.report(AgentId(0), 9)->message,
            "the clock of robot 0 goes back from 10 to 9");
}

// What an instance asks for is heeded, or refused.
TEST(Dispatcher, RefusesWhatIsNotHeeded) {
  const auto roadmap = grid(3, 2, 0, 1);
  std::vector<Agent> robots = robots_on(*roadmap, 2, 1);
  const auto message = [](const continuous::Instance& instance) {
    const auto made = Dispatcher::make(instance);
    return made ? "" : made.error().message;
  };
  const auto with = [&](auto change) {
    std::vector<Agent> changed = robots;
    change(changed[1]);
    return continuous::Instance::make(roadmap, changed).value();
  };
  const continuous::Instance plain = with([](Agent&) {});
  EXPECT_EQ(message(plain), "");
  EXPECT_EQ(message(plain.with_whole_moves()),
            "plans for whole moves are not supported here: robots wait within lanes, where their "
            "limits are");
  EXPECT_EQ(message(continuous::Instance::make(roadmap, robots, {}, {}, {}, 5).value()),
            "a live fleet begins at time 0");
  const continuous::MovingObstacle passer{
      continuous::Disc{10}, {{{500, 500}, 0, 0}, {{600, 500}, 100, 100}}, true};
  EXPECT_EQ(message(continuous::Instance::make(roadmap, robots, {}, {}, {passer}).value()),
            "moving obstacles are not supported here: they wait for nobody");
  EXPECT_EQ(message(with([](Agent& robot) { robot.release = 7; })),
            "robot 1 is released later, which is not supported here: assign its task then");
  EXPECT_EQ(message(with([](Agent& robot) { robot.leaves = true; })),
            "robot 1 leaves at its goal, which is not supported here: robots stay in the fleet");
  // Goals and deadlines are for tasks.
  EXPECT_EQ(message(with([](Agent& robot) { robot.deadline = Ticks(100'000); })), "");

  continuous::RoadmapParts parts(*roadmap);
  std::vector<Agent> moving = robots;
  const VertexId from = moving[1].start;
  const continuous::Edge& lane = roadmap->edge(roadmap->out_edges(from).front());
  moving[1].start = continuous::add_lane_place(parts, from, lane.to, 100, 30);
  moving[1].goals = lane.to;
  moving[0].goals = from;
  moving[1].under_way = true;
  EXPECT_EQ(message(continuous::Instance::make(std::move(parts).make().value(), moving).value()),
            "robot 1 begins in the middle of a move, which is not supported here: robots begin at "
            "vertices");

  const auto close = std::make_shared<const continuous::Roadmap>(
      continuous::Roadmap::make({{0, 0}, {500, 0}, {9000, 0}},
                                {{VertexId(0), VertexId(2), {}}, {VertexId(1), VertexId(2), {}}})
          .value());
  std::vector<Agent> parked = robots_on(*close, 2, 1);
  for (std::size_t i = 0; i < 2; ++i) {
    parked[i].start = VertexId(i);
    parked[i].goals = VertexId(2 * i);
    parked[i].overlaps_at_start = true;
  }
  parked[0].goals = VertexId(0);
  EXPECT_EQ(message(continuous::Instance::make(close, parked).value()),
            "robot 0 and robot 1 overlap at their starts, which is not supported here");
}

// A long lane, which is begun, and another one that crosses it: by the plan the second robot is
// there first, but it is late, and the first one has been allowed to go further than that leaves.
TEST(Dispatcher, NewOrdersLeaveWhatWasAllowed) {
  const auto roadmap = std::make_shared<const continuous::Roadmap>(
      continuous::Roadmap::make(
          {{0, 0}, {10'000, 0}, {9'000, -7'000}, {9'000, -2'000}, {9'000, 2'000}},
          {{VertexId(0), VertexId(1), {}},
           {VertexId(2), VertexId(3), {}},
           {VertexId(3), VertexId(4), {}}})
          .value());
  std::vector<Agent> robots;
  for (const VertexId start : {VertexId(0), VertexId(2)}) {
    robots.push_back({start, start, continuous::Disc{300}});
    robots.back().speed = 100'000'000;
  }
  for (const Ticks clock : {Ticks(50), Ticks(10)}) {
    Options options = quick();
    options.patience = 1'000;
    Dispatcher dispatcher = Dispatcher::make(roadmap, robots, {}, options).value();
    EXPECT_FALSE(dispatcher.assign(AgentId(0), {VertexId(1), 0, {}}));
    EXPECT_FALSE(dispatcher.assign(AgentId(1), {VertexId(3), 0, {}}));
    EXPECT_EQ(dispatcher.tick(50).num_sent, 2U);
    EXPECT_EQ(dispatcher.limit(AgentId(0)), Ticks(50));
    EXPECT_FALSE(dispatcher.report(AgentId(0), 50));
    EXPECT_FALSE(dispatcher.report(AgentId(1), clock));
    EXPECT_FALSE(dispatcher.cancel(AgentId(1)));
    EXPECT_FALSE(dispatcher.assign(AgentId(1), {VertexId(4), 0, {}}));
    const News news = dispatcher.tick(10);
    EXPECT_EQ(news.was_too_late, clock == Ticks(10));
    EXPECT_EQ(news.num_sent, clock == Ticks(10) ? 0U : 1U);
    EXPECT_EQ(end_of(dispatcher.course(AgentId(1))), clock == Ticks(10) ? Ticks(50) : Ticks(90));
  }
}

TEST(Dispatcher, TasksCanBeTakenBack) {
  const auto roadmap = grid(5, 1, 0, 1);
  std::vector<Agent> robots = robots_on(*roadmap, 1, 1);
  robots[0].start = VertexId(0);
  SimulatedFleet fleet(roadmap, robots, {}, {}, 1);
  EXPECT_FALSE(fleet.dispatcher().assign(AgentId(0), {VertexId(4)}));
  static_cast<void>(fleet.step(10));
  EXPECT_FALSE(fleet.dispatcher().cancel(AgentId(0)));
  EXPECT_FALSE(fleet.dispatcher().assign(AgentId(0), {VertexId(0)}));
  std::size_t served = 0;
  for (int step = 0; step < 30; ++step) served += fleet.step(10).served.size();
  EXPECT_EQ(served, 1U);
  EXPECT_EQ(fleet.dispatcher().course(AgentId(0)).back().spot, Spot(VertexId(0)));
}

}  // namespace
}  // namespace quadrille::dispatch::test
