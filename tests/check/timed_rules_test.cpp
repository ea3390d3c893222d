// SPDX-License-Identifier: MIT
// The checker's rules in continuous time, with neighbours that are false: against enumeration, or
// against the solver's geometry, which shares nothing with the checker's.
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "check/timed_support.hpp"
#include "cover/cover_tree.hpp"
#include "quadrille/geometry/body_pair.hpp"
#include "support/environment.hpp"
#include "support/random.hpp"
#include "timed/cover.hpp"
#include "timed/meeting.hpp"

namespace quadrille_check::support {
namespace {

using quadrille::support::Random;
using quadrille::support::scaled;

// Whole numbers are ticks and length units. Edges: 0: 0 - 1, 1: 1 - 0, 2: 1 - 2, 3: 2 - 1, 4: 3 -
// 4, beside the first one and as long.
Road lanes(const std::string& agents) {
  return read_road(
      parse_json(R"({"quadrille": "instance", "version": 1, "resolution": 1, "roadmap": {
      "vertices": [[0, 0], [10, 0], [20, 0], [0, 6], [10, 6], [3, 3], [13, 3]],
      "edges": [[0, 1], [1, 0], [1, 2], [2, 1], [3, 4]]}, "agents": [)" +
                 agents + "]}"));
}
const std::string kFirst = R"({"start": 0, "goal": 2, "radius": 3})";
const std::string kSecond = R"({"start": 2, "goal": 0, "radius": 3})";
const Road kLane = lanes(kFirst + ", " + kSecond);

// ---- reading ------------------------------------------------------------------------------------

TEST(TimedInstances, AreReadInWholeUnits) {
  const Road road = read_road(parse_json(R"({"quadrille": "instance", "version": 1,
      "resolution": {"length": 0.001, "time": 0.01}, "now": 2,
      "roadmap": {"vertices": [[0, 0], [0.3, -0.4]], "edges": [[0, 1], {"from": 1, "to": 0,
      "duration": 1.234, "groups": [0, 5]}]},
      "agents": [{"start": 0, "goal": 1, "radius": 0.2999, "speed": 2, "group": 5, "release": 1.5,
      "deadline": 9.999, "at_goal": "leave"}]})"));
  EXPECT_EQ(road.points[1], (Point{300, -400, 0}));
  EXPECT_EQ(road.agents[0].body.radius, 299);
  EXPECT_EQ(road.agents[0].speed, 20'000'000);
  EXPECT_EQ(road.duration(0, 0), 25);
  EXPECT_EQ(road.duration(0, 1), 123);
  EXPECT_EQ(road.agents[0].release, 0);
  EXPECT_EQ(road.agents[0].deadline, 800);
  EXPECT_TRUE(road.agents[0].leaves);
  EXPECT_TRUE(road.may_use(0, 1));
}

TEST(TimedInstances, WithoutRulesAreRefused) {
  const auto refusal = [](const std::string& agent, const std::string& more = "") {
    try {
      static_cast<void>(read_road(parse_json(
          R"({"quadrille": "instance", "version": 1, "resolution": 1, "roadmap": {"vertices":
          [[0, 0], [9, 0]], "edges": [[0, 1]]}, "agents": [)" +
          agent + "]" + more + "}")));
    } catch (const BadInput& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(refusal(R"({"start": 0, "goal": 1, "radius": 1})"), "");
  EXPECT_NE(refusal(R"({"start": 0, "goals": [1], "radius": 1})").find("goals"), std::string::npos);
  EXPECT_NE(refusal(R"({"start": 0, "goal": 1, "polygon": [[0, 0], [1, 0]]})"), "");
  EXPECT_NE(refusal(R"({"start": 0, "goal": 2, "radius": 1})"), "");
  EXPECT_NE(refusal(R"({"start": 0, "goal": 1, "radius": 0.5})"), "");
  EXPECT_NE(refusal(R"({"start": 0, "goal": 1, "radius": -1})"), "");
  EXPECT_NE(refusal(R"({"start": 0, "goal": 1, "radius": 1, "colour": 1})"), "");
}

// ---- encounters ---------------------------------------------------------------------------------

TEST(TimedRules, StartsOfTwoMovesMeet) {
  // On one edge in opposite directions they meet at offsets from -10 to 10.
  const auto clause = [](int first, int last, int begin, int end) {
    return "f 1 0 4 0 0 " + std::to_string(first) + " " + std::to_string(last) + "\nf 2 1 4 0 1 " +
           std::to_string(begin) + " " + std::to_string(end) + "\na 12 | 1 2\n";
  };
  EXPECT_TRUE(accepts(kLane, clause(0, 1, 0, 11)));
  EXPECT_FALSE(accepts(kLane, clause(0, 1, 0, 12)));
  EXPECT_TRUE(accepts(kLane, clause(5, 11, 0, 16)));
  EXPECT_FALSE(accepts(kLane, clause(5, 12, 0, 16)));
  EXPECT_FALSE(accepts(kLane, clause(4, 11, 0, 16)));
  EXPECT_FALSE(accepts(kLane, clause(0, 1, 0, -1)));
}

TEST(TimedRules, AnEncounterHasTwoAgentsAndBans) {
  const std::string bans = "f 1 0 4 0 0 0 1\nf 2 1 4 0 1 0 1\nf 3 0 4 0 1 0 1\nc 4 0 20\n";
  EXPECT_TRUE(accepts(kLane, bans + "a 12 | 1 2\n"));
  EXPECT_FALSE(accepts(kLane, bans + "a 12 | 1 3\n"));
  EXPECT_FALSE(accepts(kLane, bans + "a 12 | 1 -2\n"));
  EXPECT_FALSE(accepts(kLane, bans + "a 12 | 1\n"));
  EXPECT_FALSE(accepts(kLane, bans + "a 12 | 4 2\n"));
  // Each of the bans has to meet each one.
  EXPECT_TRUE(accepts(kLane, "f 1 0 4 0 0 0 1 0 2 5 6\nf 2 1 4 0 3 0 5\na 12 | 1 2\n"));
  EXPECT_FALSE(accepts(kLane, "f 1 0 4 0 0 0 1 0 2 50 51\nf 2 1 4 0 1 0 5\na 12 | 1 2\n"));
}

TEST(TimedRules, TouchingIsNoEncounter) {
  const std::string side = "f 1 0 4 0 0 0 1\nf 2 1 4 0 4 0 1\na 12 | 1 2\n";
  EXPECT_FALSE(accepts(lanes(kFirst + R"(, {"start": 3, "goal": 4, "radius": 3})"), side));
  EXPECT_TRUE(accepts(lanes(kFirst + R"(, {"start": 3, "goal": 4, "radius": 4})"), side));
}

TEST(TimedRules, AMoveMeetsAStay) {
  // Agent 1 stands in 1: agent 0, on its way there, is nearer than 6 after more than 4 ticks, and
  // still when it arrives after 10.
  const auto clause = [](const std::string& starts, const std::string& stay) {
    return "f 1 0 4 0 0 " + starts + "\nf 2 1 4 1 1 " + stay + "\na 12 | 1 2\n";
  };
  EXPECT_TRUE(accepts(kLane, clause("0 1", "4 11")));
  EXPECT_FALSE(accepts(kLane, clause("0 1", "3 11")));  // it may go at 4
  EXPECT_FALSE(accepts(kLane, clause("0 1", "4 12")));  // it may come at 11
  EXPECT_TRUE(accepts(kLane, clause("0 4", "7 11")));
  EXPECT_FALSE(accepts(kLane, clause("0 5", "7 11")));
  EXPECT_FALSE(accepts(kLane, clause("0 4", "7 12")));
  EXPECT_TRUE(accepts(kLane, clause("0 1", "4 5")));
  EXPECT_FALSE(accepts(kLane, clause("0 1", "3 4")));   // only touching
  EXPECT_FALSE(accepts(kLane, clause("0 1", "4 -1")));  // for ever
  EXPECT_FALSE(accepts(kLane, clause("0 -1", "4 11")));
  EXPECT_FALSE(accepts(kLane, "f 1 0 4 1 1 0 5\nf 2 1 4 1 1 0 5\na 12 | 1 2\n"));
}

// ---- paths --------------------------------------------------------------------------------------

TEST(TimedRules, OnePathCostsMoreOrBreaksABan) {
  const std::string bans =
      "c 1 0 24\nc 2 0 25\nf 3 0 4 0 0 0 5\nf 4 1 4 0 0 0 5\nf 5 0 4 1 1 11 14\nf 6 0 4 1 0 3 4\n";
  EXPECT_TRUE(accepts(kLane, bans + "a 11 0 | -1 -3\n"));
  EXPECT_FALSE(accepts(kLane, bans + "a 11 0 | -2 -3\n"));  // it may cost 25
  EXPECT_FALSE(accepts(kLane, bans + "a 11 0 | -1 -4\n"));  // a ban of another agent
  EXPECT_FALSE(accepts(kLane, bans + "a 11 0 | -1 3\n"));
  EXPECT_FALSE(accepts(kLane, bans + "a 11 0 | -1\n"));
  EXPECT_FALSE(accepts(kLane, bans + "a 11 0 | -3\n"));
  EXPECT_FALSE(accepts(kLane, bans + "a 11 1 | -1 -3\n"));
  EXPECT_FALSE(accepts(kLane, bans + "a 11 0 | -1 -5\n"));    // it passes at 10
  EXPECT_TRUE(accepts(kLane, bans + "a 11 0 | -1 -3 -6\n"));  // it has to wait in 0
  EXPECT_FALSE(accepts(kLane, bans + "a 11 0 | -1 -6\n"));
  EXPECT_TRUE(accepts(kLane, bans + "a 11 0 | 2 -1\n"));  // at most 25 or more than 24
  EXPECT_FALSE(accepts(kLane, bans + "a 11 0 | 1 -2\n"));
  // It cannot wait anywhere.
  EXPECT_TRUE(accepts(kLane, "f 1 0 4 0 0 0 5 1 0 3 4\na 11 0 | -1\n"));
  EXPECT_FALSE(accepts(kLane, "f 1 0 4 0 0 0 3 1 0 3 4\na 11 0 | -1\n"));
  EXPECT_TRUE(accepts(kLane, "f 1 0 4 1 2 90 -1\na 11 0 | -1\n"));
  EXPECT_FALSE(accepts(kLane, "f 1 0 4 1 2 90 95\na 11 0 | -1\n"));
}

TEST(TimedRules, OthersAtTheirGoalsAreInTheWay) {
  // Agent 1 rests in 1 from 10 on at the latest: agent 0 does not pass.
  const Road road = lanes(kFirst + R"(, {"start": 2, "goal": 1, "radius": 3})");
  const auto clause = [](int most, const std::string& ban, const std::string& rule) {
    return "c 1 1 " + std::to_string(most) + "\nf 2 0 4 " + ban + "\nc 3 0 20\n" + rule;
  };
  const std::string passes = "a 11 0 2 | -1 -3\n";
  EXPECT_TRUE(accepts(road, clause(10, "0 2 5 -1", passes)));
  EXPECT_TRUE(accepts(road, clause(10, "0 2 5 100", passes)));
  EXPECT_TRUE(accepts(road, clause(10, "0 0 0 -1", passes)));
  // From 15 on it is out of reach after 6 ticks of the move that begins at 10.
  EXPECT_TRUE(accepts(road, clause(15, "0 2 10 -1", passes)));
  EXPECT_FALSE(accepts(road, clause(16, "0 2 10 -1", passes)));
  EXPECT_FALSE(accepts(road, clause(15, "0 2 9 -1", passes)));
  EXPECT_FALSE(accepts(road, clause(15, "0 2 10 -1", "a 11 0 2 | 1 -3\n")));
  EXPECT_FALSE(accepts(road, clause(15, "0 2 10 -1", "a 11 0 2 | -3\n")));
  EXPECT_FALSE(accepts(road, clause(15, "0 2 10 -1", "a 11 0 | -1 -3\n")));  // no ban is named
  EXPECT_FALSE(accepts(road, clause(15, "0 4 10 -1", passes)));
  // Vertex 6 is too near, 2 is not.
  const std::string starts_late = "f 4 0 4 0 0 0 1\na 11 0 2 | -1 -3 -4\n";
  EXPECT_TRUE(accepts(road, clause(15, "1 6 14 -1", starts_late)));
  EXPECT_FALSE(accepts(road, clause(15, "1 6 13 -1", starts_late)));
  EXPECT_FALSE(accepts(road, clause(15, "1 2 15 -1", starts_late)));
  // Of an agent that leaves nothing is in the way.
  const Road leaving =
      lanes(kFirst + R"(, {"start": 2, "goal": 1, "radius": 3, "at_goal": "leave"})");
  EXPECT_FALSE(accepts(leaving, clause(15, "0 2 10 -1", passes)));
}

TEST(TimedRules, ReleasesAndDeadlinesHold) {
  const Road road =
      lanes(R"({"start": 0, "goal": 2, "radius": 3, "release": 4, "deadline": 30}, )" + kSecond);
  EXPECT_TRUE(accepts(road, "c 1 0 23\na 11 0 | -1\n"));
  EXPECT_FALSE(accepts(road, "c 1 0 24\na 11 0 | -1\n"));
  EXPECT_TRUE(accepts(road, "c 1 0 30\na 11 0 | 1\n"));
  EXPECT_FALSE(accepts(road, "c 1 0 29\na 11 0 | 1\n"));
  EXPECT_TRUE(accepts(road, "f 1 0 4 0 0 4 11\na 11 0 | -1\n"));
  EXPECT_FALSE(accepts(road, "f 1 0 4 0 0 4 10\na 11 0 | -1\n"));
}

/// Path by path: when the agent is at its goal for good at the earliest, by `end`.
std::optional<Int> enumerate(const Road& road, const std::vector<TimedBan>& bans, Int end) {
  const Road::Agent& task = road.agents[0];
  std::set<std::pair<int, Int>> seen, todo{{task.start, 0}};
  std::optional<Int> best;
  const auto may_stay = [&](int vertex, Int from, Int until) {
    return std::none_of(bans.begin(), bans.end(), [&](const TimedBan& ban) {
      return ban.is_stay && ban.place == vertex && from < ban.end && until > ban.begin;
    });
  };
  const auto may_start = [&](int edge, Int tick) {
    return std::none_of(bans.begin(), bans.end(), [&](const TimedBan& ban) {
      return !ban.is_stay && ban.place == edge && ban.begin <= tick && tick < ban.end;
    });
  };
  while (!todo.empty()) {
    const auto [vertex, time] = *todo.begin();
    todo.erase(todo.begin());
    if (!seen.insert({vertex, time}).second) continue;
    if (vertex == task.goal &&
        (task.leaves ? may_stay(vertex, time, time) : may_stay(vertex, time, kNever)))
      if (!best || time < *best) best = time;
    for (Int depart = std::max(time, task.release); depart <= end; ++depart)
      for (const int edge : road.out[static_cast<std::size_t>(vertex)])
        if (may_stay(vertex, time, depart) && may_start(edge, depart) &&
            depart + road.duration(0, edge) <= end)
          todo.insert(
              {road.edges[static_cast<std::size_t>(edge)].to, depart + road.duration(0, edge)});
  }
  return best;
}

TEST(TimedRules, PathsAreThoseOfEnumeration) {
  std::size_t some = 0, none = 0;
  for (std::uint64_t seed = 0; seed < scaled(3000); ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    Road road;
    road.points.resize(4);
    road.out.resize(4);
    road.in.resize(4);
    road.durations.resize(1);
    for (int k = 0; k < 7; ++k) {
      const int from = static_cast<int>(random.below(4)), to = static_cast<int>(random.below(4));
      if (from == to) continue;
      road.out[static_cast<std::size_t>(from)].push_back(static_cast<int>(road.edges.size()));
      road.in[static_cast<std::size_t>(to)].push_back(static_cast<int>(road.edges.size()));
      road.edges.push_back({from, to});
      road.durations[0].push_back(static_cast<Int>(random.between(1, 3)));
    }
    if (road.edges.empty()) continue;
    Road::Agent agent;
    agent.goal = static_cast<int>(random.below(4));
    agent.leaves = random.percent(20);
    agent.release = random.percent(20) ? static_cast<Int>(random.below(4)) : 0;
    road.agents.push_back(agent);
    std::vector<TimedBan> bans;
    std::vector<const TimedBan*> pointers;
    for (std::size_t k = random.below(9); k > 0; --k) {
      const bool is_stay = random.percent(60);
      const Int begin = static_cast<Int>(random.below(9)) - 1;
      const Int length = static_cast<Int>(random.between(1, 4));
      bans.push_back({is_stay, static_cast<int>(random.below(is_stay ? 4 : road.edges.size())),
                      begin, random.percent(15) ? kNever : begin + length});
    }
    for (const TimedBan& ban : bans) pointers.push_back(&ban);
    constexpr Int kEnd = 16;
    const auto found = TimedPaths(road).arrival(0, pointers, kEnd);
    const auto expected = enumerate(road, bans, kEnd);
    // Who leaves where it starts is gone at once.
    if (agent.leaves && agent.goal == agent.start) continue;
    ASSERT_EQ(found, expected);
    ++(found ? some : none);
  }
  EXPECT_GT(some, 0U);
  EXPECT_GT(none, 0U);
}

// ---- geometry -----------------------------------------------------------------------------------

TEST(TimedRules, MotionsMeetWhereTheSolverSaysSo) {
  namespace geometry = quadrille::geometry;
  std::size_t meeting = 0, apart = 0, polygons = 0;
  for (std::uint64_t seed = 0; seed < scaled(20'000); ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    // From single units to the largest numbers that there are.
    const Int size = Int{1} << random.between(2, 40), long_time = Int{1} << random.between(1, 40);
    const auto number = [&](Int most) {
      return static_cast<Int>(random.below(static_cast<std::size_t>(most) + 1));
    };
    const bool is_flat = random.percent(50);
    Motion a, b;
    for (Motion* m : {&a, &b}) {
      for (Point* point : {&m->from, &m->to})
        for (std::size_t k = 0; k < (is_flat ? 2U : 3U); ++k)
          (*point)[k] = random.percent(50) ? number(size) : -number(size);
      m->begin = number(long_time);
      m->end = m->begin + 1 + number(long_time - 1);
      m->body.radius = 1 + number(size - 1);
      if (random.percent(20)) m->to = m->from;
    }
    const auto point = [](const Point& p) {
      return geometry::Point{geometry::Length(p[0]), geometry::Length(p[1]),
                             geometry::Length(p[2])};
    };
    const auto motion = [&](const Motion& m) {
      return geometry::Motion{point(m.from), point(m.to), geometry::Ticks(m.end - m.begin)};
    };
    std::vector<geometry::Body> bodies;
    for (Motion* m : {&a, &b}) {
      bodies.push_back(geometry::Disc{geometry::Length(m->body.radius)});
      if (!is_flat || random.percent(50)) continue;
      std::vector<geometry::Point> corners;
      std::vector<Point> own;
      for (std::size_t k = random.between(3, 5); k > 0; --k) {
        own.push_back({random.percent(50) ? number(size) : -number(size),
                       random.percent(50) ? number(size) : -number(size), 0});
        corners.push_back(point(own.back()));
      }
      auto polygon = geometry::ConvexPolygon::make(corners);
      if (!polygon) continue;  // not convex
      m->body = {0, std::make_shared<const std::vector<Point>>(own)};
      bodies.back() = *polygon;
      ++polygons;
    }
    const geometry::BodyPair pair(bodies[0], bodies[1]);
    const bool expected = pair.collide(motion(a), motion(b), geometry::Ticks(b.begin - a.begin));
    ASSERT_EQ(do_meet(a, b), expected);
    ASSERT_EQ(do_meet(b, a), expected);
    ++(expected ? meeting : apart);
  }
  EXPECT_GT(meeting, 0U);
  EXPECT_GT(apart, 0U);
  EXPECT_GT(polygons, 0U);
}

// ---- ceilings and claims ------------------------------------------------------------------------

TEST(TimedRules, CeilingsAreOfPlansThatAreCheapEnough) {
  const std::string costs = "c 1 0 29\nc 2 0 28\n";  // each costs 20 when it is alone
  EXPECT_TRUE(accepts(kLane, "u 50\n" + costs + "a 13 | 1\n"));
  EXPECT_FALSE(accepts(kLane, "u 50\n" + costs + "a 13 | 2\n"));
  EXPECT_FALSE(accepts(kLane, "u 51\n" + costs + "a 13 | 1\n"));
  EXPECT_FALSE(accepts(kLane, "u 50\n" + costs + "a 13 | -1\n"));
  EXPECT_FALSE(accepts(kLane, costs + "a 13 | 1\n"));
  EXPECT_FALSE(accepts(kLane, "u 50\nu 50\n" + costs));
  EXPECT_FALSE(accepts(kLane, costs + "a 11 0 | -1 1\nu 50\na 13 | 1\n"));  // too late
}

TEST(TimedRules, ClaimsAreNoMoreThanWhatWasProved) {
  EXPECT_TRUE(accepts(kLane, "q 40 0\n"));
  EXPECT_FALSE(accepts(kLane, "q 41 0\n"));
  EXPECT_FALSE(accepts(kLane, "u 39\nq 40 0\n"));
  EXPECT_EQ(rejection(kLane, "q 20 0\n", true), "");
  EXPECT_NE(rejection(kLane, "q 21 0\n", true), "");
  const std::string core = "c 1 0 24\nf 3 0 4 0 0 0 5\na 11 0 | -1 -3\n";
  EXPECT_FALSE(accepts(kLane, core + "q 45 1\n"));  // it has another literal
  const std::string late = "c 1 0 19\na 11 0 | -1\nc 2 0 18\na 11 0 | -2\n";
  EXPECT_TRUE(accepts(kLane, late + "q 40 1\n"));
  EXPECT_FALSE(accepts(kLane, late + "q 41 1\n"));
  EXPECT_EQ(rejection(kLane, late + "q 20 1\n", true), "");
  EXPECT_NE(rejection(kLane, late + "q 20 2\n", true), "");
  EXPECT_FALSE(accepts(kLane, late + "z 1\n"));
}

TEST(TimedRules, ThereIsNoPlanByAnEmptyClauseAboutAllPlans) {
  const auto hurried = [](const std::string& deadline) {
    return lanes(R"({"start": 0, "goal": 2, "radius": 3, "deadline": )" + deadline +
                 R"(}, {"start": 2, "goal": 0, "radius": 3, "deadline": )" + deadline + "}");
  };
  const std::string proof =
      "f 1 0 4 0 0 0 1\nf 2 1 4 0 3 0 1\na 12 | 1 2\na 11 0 | -1\na 11 1 | -2\nl 0 2 3 1\n";
  EXPECT_TRUE(accepts(hurried("20"), proof + "z 4\n"));
  EXPECT_FALSE(accepts(hurried("21"), proof + "z 4\n"));
  EXPECT_FALSE(accepts(hurried("20"), proof + "z 1\n"));
  EXPECT_FALSE(accepts(hurried("20"), "u 90\n" + proof + "z 4\n"));
  EXPECT_TRUE(accepts(hurried("20"), "u 90\n" + proof + "q 90 4\n"));
  EXPECT_FALSE(accepts(hurried("20"), "u 90\n" + proof + "q 91 4\n"));
  EXPECT_FALSE(accepts(hurried("20"), proof + "z 4\nq 40 0\n"));
}

// A pocket beside the middle of a lane, in which one of two agents waits.
TEST(TimedRules, PlansAreReplayed) {
  const auto pocket = [](const std::string& first, const std::string& more = "") {
    return read_road(parse_json(R"({"quadrille": "instance", "version": 1, "resolution": 1,
        "roadmap": {"vertices": [[0, 0], [10, 0], [20, 0], [10, 10]],
        "edges": [[0, 1], [1, 0], [1, 2], [2, 1], [1, 3], [3, 1]]}, "agents": [
        {"start": 0, "goal": 2, "radius": 3)" +
                                first + R"(}, {"start": 2, "goal": 0, "radius": 3}])" + more +
                                "}"));
  };
  const Road road = pocket("");
  const auto verdict = [](const Road& on, const std::string& first, const std::string& second,
                          const std::string& claim = "q 40 0") {
    return ask(on, "qcert 1 text\ni 2 0\n" + claim + "\np 0 " + first + "\np 1 " + second + "\n");
  };
  const std::string passes = "1 0 10 3 10 20 1 20 30 2 30 40", lane = "1 9 19 0 19 29";
  const Answer answer = verdict(road, passes, lane);
  ASSERT_TRUE(answer.is_verified) << answer.reason;
  EXPECT_EQ(answer.verdict.cost, 40 + 29);
  const auto refusal = [&](const std::string& first, const std::string& second) {
    return verdict(road, first, second).reason;
  };
  EXPECT_NE(refusal(passes, "1 8 18 0 18 28").find("collide"), std::string::npos);
  EXPECT_NE(refusal(passes, lane + " 0").find("three numbers"), std::string::npos);
  const std::string late = "1500000000000000000 1500000000000000010";
  EXPECT_NE(refusal("1 " + late + " 2 1600000000000000000 1600000000000000010",
                    "1 " + late + " 0 1600000000000000000 1600000000000000010")
                .find("too long"),
            std::string::npos);
  EXPECT_NE(refusal(passes, "1 0 10 0 10 20").find("collide"), std::string::npos);
  EXPECT_NE(refusal("1 0 10 2 10 20", lane).find("collide"), std::string::npos);
  EXPECT_NE(refusal("1 0 10 3 10 20 1 20 30 2 30 39", lane).find("not"), std::string::npos);
  EXPECT_NE(refusal("1 0 10 3 9 19 1 20 30 2 30 40", lane).find("back"), std::string::npos);
  EXPECT_NE(refusal("3 0 10 1 20 30 2 30 40", lane).find("not"), std::string::npos);
  EXPECT_NE(refusal("1 0 10 3 10 20", lane).find("ends elsewhere"), std::string::npos);
  EXPECT_NE(verdict(road, passes, lane, "u 90\nq 80 0").reason.find("more than"),
            std::string::npos);
  EXPECT_TRUE(verdict(pocket(R"(, "deadline": 40)"), passes, lane).is_verified);
  EXPECT_TRUE(verdict(pocket(R"(, "at_start": "under_way")"), passes, lane).is_verified);
  EXPECT_FALSE(verdict(pocket(R"(, "at_start": "under_way")"), "1 1 11 3 11 21 1 21 31 2 31 41",
                       "1 10 20 0 20 30")
                   .is_verified);
  EXPECT_TRUE(verdict(road, "1 1 11 3 11 21 1 21 31 2 31 41", "1 10 20 0 20 30").is_verified);
  EXPECT_FALSE(verdict(pocket(R"(, "deadline": 39)"), passes, lane).is_verified);
  EXPECT_FALSE(verdict(pocket(R"(, "release": 1)"), passes, lane).is_verified);
  // What is in the way of the pocket until it is too late, or in time.
  const auto obstacle = [](int end) {
    return R"(, "obstacles": [{"radius": 1, "path": [{"at": [10, 10], "arrive": 0, "depart": )" +
           std::to_string(end) + R"(}], "at_end": "leave"}])";
  };
  EXPECT_TRUE(verdict(pocket("", obstacle(16)), passes, lane).is_verified);
  EXPECT_FALSE(verdict(pocket("", obstacle(17)), passes, lane).is_verified);
}

TEST(TimedRules, MovingObstaclesAreInTheWay) {
  // One stands at (10, 10) until 16, nearer than 4 to whoever has been on the way there for 6
  // ticks.
  const Road road = read_road(parse_json(R"({"quadrille": "instance", "version": 1, "resolution": 1,
      "roadmap": {"vertices": [[0, 0], [10, 0], [10, 10]], "edges": [[0, 1], [1, 2]]},
      "agents": [{"start": 1, "goal": 2, "radius": 3}], "obstacles": [{"radius": 1, "path":
      [{"at": [10, 10], "arrive": 0, "depart": 16}], "at_end": "leave"}]})"));
  const auto clause = [](const std::string& ban, const std::string& rule) {
    return "f 1 0 4 " + ban + "\nc 2 0 19\nc 3 0 20\n" + rule;
  };
  const std::string passes = "a 11 0 1 | -3\n";
  EXPECT_TRUE(accepts(road, clause("0 1 0 10", "a 11 0 1 | -2\n")));
  EXPECT_FALSE(accepts(road, clause("0 1 0 10", passes)));  // it may set out at 10
  EXPECT_FALSE(accepts(road, clause("0 1 0 11", passes)));  // the obstacle has left by then
  EXPECT_FALSE(accepts(road, clause("0 0 0 10", "a 11 0 1 | -2\n")));
  EXPECT_FALSE(accepts(road, clause("0 1 0 -1", passes)));
  EXPECT_TRUE(accepts(road, "f 1 0 4 1 2 0 16\nc 2 0 15\na 11 0 1 | -2\n"));
  EXPECT_FALSE(accepts(road, "f 1 0 4 1 2 0 16\nc 2 0 16\na 11 0 1 | -2\n"));
  EXPECT_FALSE(accepts(road, "f 1 0 4 1 2 0 18\nc 2 0 15\na 11 0 1 | -2\n"));
  // What an agent costs alone is more then.
  const std::string raised = clause("0 1 0 10", "a 11 0 1 | -2\n");
  EXPECT_TRUE(accepts(road, raised + "b 1\nq 20 0\n"));
  EXPECT_FALSE(accepts(road, raised + "b 1\nq 21 0\n"));
  EXPECT_FALSE(accepts(road, "f 1 0 4 0 1 0 10\nc 2 0 19\na 11 0 | -2 -1\nb 1\n"));
}

TEST(TimedRules, CostsAreRaisedBeforeTrees) {
  const std::string core =
      "f 1 0 4 0 0 0 5\nf 2 1 4 0 3 0 5\nc 3 0 24\nc 4 1 24\na 12 | 1 2\n"
      "a 11 0 | -1 -3\na 11 1 | -2 -4\nl -3 -4 0 2 3 1\n";
  const std::string tree = "t 5 1 0 1 4 5\n", raise = "c 5 0 19\na 11 0 | -5\nb 5\n";
  EXPECT_TRUE(accepts(kLane, core + raise + tree + "q 45 0\n"));
  EXPECT_FALSE(accepts(kLane, core + raise + tree + "q 46 0\n"));
  EXPECT_FALSE(accepts(kLane, core + tree + raise));
  EXPECT_FALSE(accepts(kLane, core + "b 4\n"));  // two literals
  EXPECT_FALSE(accepts(kLane, core + "b 1\n"));
}

TEST(TimedRules, VariablesAreOfWhatThereIs) {
  for (const char* good : {"f 3 0 4 0 0 0 1", "f 3 0 4 1 0 -1 -1", "f 3 0 4", "c 3 0 4"})
    EXPECT_TRUE(accepts(kLane, std::string("c 1 0 4\n") + good + "\n")) << good;
  for (const char* bad : {"f 3 2 4 0 0 0 1",
                          "f 3 -1 4 0 0 0 1",
                          "f 3 0 4 0 5 0 1",
                          "f 3 0 4 0 -1 0 1",
                          "f 3 0 4 1 7 0 1",
                          "f 3 0 4 2 0 0 1",
                          "f 3 0 4 0 0 5 5",
                          "f 3 0 4 0 0 0",
                          "f 3 0",
                          "f 3 0 3 0 0 0 1",
                          "f 3 0 4 0 0 -2305843009213693952 1",
                          "f 3 0 4 0 0 0 2305843009213693953",
                          "c 3 0",
                          "c 3 0 4 4",
                          "c 3 2 4",
                          "c 3 0 -1",
                          "c 3 0 2305843009213693952",
                          "c 0 0 4",
                          "c 2147483648 0 4",
                          "c 1 0 5",
                          "t",
                          "t 0",
                          "t 0 1",
                          "t 0 0 0 0",
                          "t -1 1 0 0",
                          "t 0 1048577 0 0",
                          "t 0 1 0 1",
                          "t 0 1 0 -1",
                          "t 0 1 0 0 0",
                          "t 0 1 1 2 5",
                          "t 0 1 1 0 5 0 0",
                          "u",
                          "u -1",
                          "u 2305843009213693952",
                          "q 0",
                          "q -1 0",
                          "b",
                          "a 14 | 1",
                          "a 15 | 1",
                          "a 11 | 1",
                          "e 0"})
    EXPECT_FALSE(accepts(kLane, std::string("c 1 0 4\n") + bad + "\n")) << bad;
}

// ---- trees --------------------------------------------------------------------------------------

/// Cores with the variables that they are made of, and what the least costs are that hit them.
struct Cores {
  std::vector<quadrille::continuous::LevelCore> list;
  quadrille::IdVector<quadrille::AgentId, quadrille::Cost> free_costs;
  quadrille::Cost least = 0;  // above the free costs
};

Cores draw_cores(Random& random) {
  using quadrille::AgentId;
  Cores cores;
  constexpr std::size_t kAgents = 3;
  constexpr Int kMost = 5, kUnit = 10;  // so that rounding up is not enough
  for (std::size_t i = 0; i < kAgents; ++i)
    cores.free_costs.push_back(static_cast<Int>(random.below(3)));
  for (std::size_t k = random.between(1, 6); k > 0; --k) {
    quadrille::continuous::LevelCore core;
    for (std::size_t i = 0; i < kAgents; ++i)
      if (random.percent(60))
        core.push_back({AgentId(i), cores.free_costs[AgentId(i)] +
                                        kUnit * static_cast<Int>(random.between(1, kMost))});
    if (!core.empty()) cores.list.push_back(core);
  }
  cores.least = kNever;
  for (Int a = 0; a <= kMost; ++a)
    for (Int b = 0; b <= kMost; ++b)
      for (Int c = 0; c <= kMost; ++c) {
        const Int paid[] = {a * kUnit, b * kUnit, c * kUnit};
        const auto is_hit = [&](const auto& core) {
          return std::any_of(core.begin(), core.end(), [&](const auto& level) {
            return paid[level.agent.index()] + cores.free_costs[level.agent] >= level.cost;
          });
        };
        if (std::all_of(cores.list.begin(), cores.list.end(), is_hit))
          cores.least = std::min<Int>(cores.least, paid[0] + paid[1] + paid[2]);
      }
  return cores;
}

/// Whether the checker accepts the tree.
bool is_accepted(const Cores& cores, const std::vector<Int>& tree) {
  Road road;
  road.agents.resize(3);
  TimedMeanings meanings(road);
  Clauses clauses;
  Int variable = 0;
  for (const auto& core : cores.list) {
    std::vector<Int> clause;
    for (const auto& level : core) {
      meanings.add({'c', {++variable, static_cast<Int>(level.agent.index()), level.cost - 1}});
      clause.push_back(-variable);
    }
    clauses.add(clause);
  }
  const std::vector<Int> free_costs(cores.free_costs.begin(), cores.free_costs.end());
  Cover cover(clauses, meanings, free_costs);
  try {
    cover.add(tree);
    return true;
  } catch (const Rejected&) {
    return false;
  }
}

// What two agents pay for one core would count twice where both have to hit it.
TEST(TimedRules, MultipliersAreNotNegative) {
  using quadrille::AgentId;
  Cores cores;
  cores.free_costs.assign(3, 0);
  cores.list = {{{AgentId(0), 10}}, {{AgentId(1), 10}}, {{AgentId(0), 10}, {AgentId(1), 10}}};
  const auto tree = [](Int bound, Int third) {
    return std::vector<Int>{bound, 1, 1, 0,    10, 0, 1, 1,  1000, 1,  1, 10,
                            0,     1, 2, 1000, 0,  3, 1, 10, 2,    10, 3, third};
  };
  EXPECT_TRUE(is_accepted(cores, tree(20, 0)));
  EXPECT_FALSE(is_accepted(cores, tree(21, 0)));
  EXPECT_FALSE(is_accepted(cores, tree(25, -5)));
}

TEST(TimedRules, TreesProveTheLeastCosts) {
  std::size_t branched = 0;
  for (std::uint64_t seed = 0; seed < scaled(2000); ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Cores cores = draw_cores(random);
    if (cores.list.empty()) continue;
    const auto made =
        quadrille::continuous::make_cover_tree(cores.free_costs, cores.list, cores.least);
    ASSERT_EQ(made.bound, cores.least);
    std::vector<Int> tree{made.bound, quadrille::continuous::CoverTree::kFraction};
    for (const auto& node : made.nodes) {
      if (node.branch) {
        tree.insert(tree.end(),
                    {1, static_cast<Int>(node.branch->agent.index()), node.branch->cost});
        continue;
      }
      tree.insert(tree.end(), {0, static_cast<Int>(node.multipliers.size())});
      for (const auto& [core, units] : node.multipliers)
        tree.insert(tree.end(), {static_cast<Int>(core) + 1, units});
    }
    branched += made.nodes.size() > 1 ? 1 : 0;
    ASSERT_TRUE(is_accepted(cores, tree));
    ++tree[0];
    ASSERT_FALSE(is_accepted(cores, tree));
    // Whatever else is accepted is true.
    for (int k = 0; k < 20; ++k) {
      std::vector<Int> other = tree;
      other[0] = cores.least + 1;
      for (std::size_t n = random.between(1, 3); n > 0; --n) {
        Int& value = other[2 + random.below(other.size() - 2)];
        value = random.percent(50) ? value + 1 - static_cast<Int>(random.below(3))
                                   : static_cast<Int>(random.below(5000));
      }
      ASSERT_FALSE(is_accepted(cores, other));
    }
  }
  EXPECT_GT(branched, 0U);
}

}  // namespace
}  // namespace quadrille_check::support
