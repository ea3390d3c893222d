// SPDX-License-Identifier: MIT
//
// What a fleet asks for is heeded by its dispatcher, or refused in the fleet's words.
#include "quadrille/fleet/dispatcher.hpp"

#include <gtest/gtest.h>

#include "fleet/support.hpp"

namespace quadrille::fleet {
namespace {

using namespace quadrille::units;

constexpr VertexId a{0}, b{1}, d{3};

/// Two robots on a road "a" to "d".
Fleet on_a_road() {
  Fleet fleet(test::line(4));
  fleet.robot({.name = "amr", .body = Disc(0.3_m), .speed = 1_mps}).from(a).to(b);
  fleet.robot({.name = "agv", .body = Disc(0.3_m), .speed = 1_mps}).from(d);
  return fleet;
}

std::string why(const Fleet& fleet) {
  const auto made = Dispatcher::make(fleet);
  return made ? "" : made.error().message;
}

/// Calls until the robot is served, with everybody on time.
std::size_t calls_until_served(Dispatcher& dispatcher, AgentId robot, std::size_t most) {
  for (std::size_t call = 1; call <= most; ++call) {
    const Orders orders = dispatcher.tick(500_ms);
    for (std::size_t i = 0; i < 2; ++i) {
      const auto refused = dispatcher.report(AgentId(i), dispatcher.limit(AgentId(i)));
      EXPECT_FALSE(refused);
    }
    for (const AgentId served : orders.served)
      if (served == robot) return call;
  }
  return most + 1;
}

TEST(FleetDispatcher, RefusesWhatIsNotHeeded) {
  EXPECT_EQ(why(on_a_road()), "");
  Fleet whole = on_a_road();
  whole.release_whole_moves();
  EXPECT_EQ(why(whole),
            "plans for whole moves are not supported here: robots wait within lanes, where their "
            "limits are");
  Fleet later = on_a_road();
  later.begins_at(5_s);
  EXPECT_EQ(why(later), "a live fleet begins at time 0");
  Fleet passed = on_a_road();
  passed.obstacle({.body = Disc(0.1_m), .path = {{{9_m, 9_m}, 0_s, 1_s}}, .leaves = true});
  EXPECT_EQ(why(passed), "moving obstacles are not supported here: they wait for nobody");
  Fleet released = on_a_road();
  released[AgentId(1)].release(3_s);
  EXPECT_EQ(why(released), "'agv' is released later: assign its task then");
  Fleet leaving = on_a_road();
  leaving[AgentId(0)].leaves();
  EXPECT_EQ(why(leaving), "'amr' leaves at its goal: robots stay in the fleet");
  Fleet moving = on_a_road();
  moving[AgentId(0)].from_edge(a, b, 0.5);
  EXPECT_EQ(why(moving), "'amr' begins in the middle of a move");
}

// Of two that are sent to one place the more urgent one is first there.
TEST(FleetDispatcher, DeadlinesOfFirstTasksAreThoseOfTheFleet) {
  for (const bool is_urgent : {false, true}) {
    Fleet fleet = on_a_road();
    fleet[AgentId(1)].to(b).deadline(is_urgent ? std::optional(60_s) : std::nullopt);
    Dispatcher dispatcher = Dispatcher::make(fleet).value();
    static_cast<void>(dispatcher.tick(500_ms));
    EXPECT_EQ(dispatcher.course(AgentId(0)).back().vertex, is_urgent ? a : b);
    EXPECT_EQ(dispatcher.course(AgentId(1)).back().vertex, is_urgent ? b : d);
  }
}

TEST(FleetDispatcher, LanesOfTheFleetThatAreClosedAreOpenedAgain) {
  Fleet fleet = on_a_road();
  EXPECT_FALSE(fleet.close(a, b));
  Dispatcher dispatcher = Dispatcher::make(fleet).value();
  EXPECT_EQ(calls_until_served(dispatcher, AgentId(0), 20), 21u);
  EXPECT_FALSE(dispatcher.open(a, b));
  EXPECT_LE(calls_until_served(dispatcher, AgentId(0), 40), 40u);
  EXPECT_TRUE(dispatcher.open(a, b));
}

TEST(FleetDispatcher, RefusesClocksAndTasksInTheFleetsWords) {
  Dispatcher dispatcher = Dispatcher::make(on_a_road()).value();
  const auto message = [](const std::optional<Error>& error) {
    return error ? error->message : "";
  };
  EXPECT_EQ(message(dispatcher.report(AgentId(0), 1.5_s)),
            "'amr' has gone on to 1.5 s, and was allowed to go to 0 s");
  static_cast<void>(dispatcher.tick(500_ms));
  const Seconds limit = dispatcher.limit(AgentId(0));
  EXPECT_EQ(message(dispatcher.report(AgentId(0), limit)), "");
  EXPECT_EQ(
      message(dispatcher.report(AgentId(0), limit - 0.25_s)),
      "the clock of 'amr' goes back from " + to_string(limit) + " to " + to_string(limit - 0.25_s));
  EXPECT_EQ(message(dispatcher.report(AgentId(2), 0_s)), "there is no robot 2");
  EXPECT_EQ(message(dispatcher.assign(AgentId(1), a, {.deadline = -(1_s)})),
            "the task of 'agv' has a time that is negative or too long");
  EXPECT_EQ(message(dispatcher.assign(AgentId(2), a, {.deadline = -(1_s)})), "there is no robot 2");
}

}  // namespace
}  // namespace quadrille::fleet
