// SPDX-License-Identifier: MIT
// The checker's rules about two agents, with neighbours that are false, and against enumeration.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "check/support.hpp"
#include "rules/rules.hpp"
#include "support/environment.hpp"
#include "support/random.hpp"

namespace quadrille_check::support {
namespace {

using quadrille::support::Random;
using quadrille::support::scaled;

// Agent 0 from 0 to 4 along a lane, agent 1 beside it.
const Instance kLane = grid("...../.....", {{0, 4}, {5, 9}});

TEST(Rules, TwoAgentsAreInOnePlace) {
  EXPECT_TRUE(accepts(kLane, "f 1 0 0 2 3\nf 2 1 0 2 3\na 2 | 1 2\n"));
  EXPECT_TRUE(accepts(kLane, "f 1 0 0 2 3\nx 2 1 2 3\na 2 | 1 -2\n"));
  EXPECT_TRUE(accepts(kLane, "f 1 0 1 2 3 5\nf 2 1 1 3 2 5\na 2 | 1 2\n"));
  EXPECT_FALSE(accepts(kLane, "f 1 0 0 2 3\nf 2 1 0 2 4\na 2 | 1 2\n"));  // another time
  EXPECT_FALSE(accepts(kLane, "f 1 0 0 2 3\nf 2 1 0 3 3\na 2 | 1 2\n"));  // another place
  EXPECT_FALSE(accepts(kLane, "f 1 0 0 2 3\nf 2 0 0 2 3\na 2 | 1 2\n"));  // one agent
  EXPECT_FALSE(accepts(kLane, "f 1 0 0 2 3\nf 2 1 0 2 3\na 2 | 1 -2\n"));
  EXPECT_FALSE(accepts(kLane, "f 1 0 0 2 3\nx 2 1 2 3\na 2 | 1 2\n"));
  EXPECT_FALSE(accepts(kLane, "f 1 0 2 2 3 4\nf 2 1 2 2 3 4\na 2 | 1 2\n"));  // at different times
  EXPECT_FALSE(accepts(kLane, "f 1 0 1 2 3 5\nf 2 1 1 3 2 6\na 2 | 1 2\n"));
  EXPECT_FALSE(accepts(kLane, "f 1 0 1 2 3 5\nf 2 1 0 2 5\na 2 | 1 2\n"));
}

TEST(Rules, TwoAgentsSwap) {
  const auto swap = [](const char* meanings, const char* clause = "-1 -2 -3 -4") {
    return accepts(kLane, std::string(meanings) + "a 3 | " + clause + "\n");
  };
  EXPECT_TRUE(swap("x 1 0 2 3\nx 2 0 3 4\nx 3 1 3 3\nx 4 1 2 4\n"));
  EXPECT_TRUE(swap("x 1 0 2 3\nx 2 0 3 4\nx 3 1 3 3\nx 4 1 2 4\n", "-3 -2 -4 -1"));
  EXPECT_TRUE(swap("f 1 0 0 2 3\nx 2 0 3 4\nx 3 1 3 3\nx 4 1 2 4\n", "1 -2 -3 -4"));
  EXPECT_FALSE(swap("x 1 0 2 3\nx 2 0 3 4\nx 3 1 3 3\nx 4 1 2 4\n", "-1 -2 -3"));
  EXPECT_FALSE(swap("x 1 0 2 3\nx 2 0 3 4\nx 3 1 3 3\nx 4 1 2 4\n", "-1 -2 -3 4"));
  EXPECT_FALSE(swap("x 1 0 2 3\nx 2 0 3 4\nx 3 1 3 3\nx 4 1 3 4\n"));  // that is a meeting
  EXPECT_FALSE(swap("x 1 0 2 3\nx 2 0 3 4\nx 3 1 3 4\nx 4 1 2 5\n"));  // later
  EXPECT_FALSE(swap("x 1 0 2 3\nx 2 0 3 5\nx 3 1 3 3\nx 4 1 2 5\n"));  // in two steps
  EXPECT_FALSE(swap("x 1 0 2 3\nx 2 0 3 4\nx 3 1 2 3\nx 4 1 3 4\n"));  // side by side
  EXPECT_FALSE(swap("x 1 0 2 3\nx 2 0 3 4\nx 3 0 3 3\nx 4 0 2 4\n"));  // one agent
  EXPECT_FALSE(swap("x 1 0 2 3\nx 2 0 2 4\nx 3 1 2 3\nx 4 1 2 4\n"));  // nobody moves
  EXPECT_FALSE(swap("x 1 0 2 3\nx 2 0 3 4\nx 3 1 3 3\nx 4 1 4 4\n"));
}

// Agent 0 crosses from x 1 to x 2, agent 1 from y 1 to y 2; cell (1, 1) at time 2.
TEST(Rules, TwoAgentsCrossARectangle) {
  const Instance square = grid("..../..../..../....", {{4, 7}, {1, 13}});
  const std::string sides =
      "f 1 0 3 5 2 9 3\nf 2 0 3 6 3 10 4\nf 3 1 3 5 2 6 3\nf 4 1 3 9 3 10 4\n";
  const std::string rule = "a 4 1 1 2 2 2 0 1 | ";
  EXPECT_TRUE(accepts(square, sides + rule + "1 2 3 4\n"));
  EXPECT_FALSE(accepts(square, sides + rule + "1 2 3\n"));
  EXPECT_FALSE(accepts(square, sides + "a 4 1 1 2 2 3 0 1 | 1 2 3 4\n"));  // another time
  EXPECT_FALSE(accepts(square, sides + "a 4 1 1 2 2 2 1 0 | 1 2 3 4\n"));  // the other way round
  EXPECT_FALSE(accepts(square, sides + "a 4 1 1 3 2 2 0 1 | 1 2 3 4\n"));  // larger
  EXPECT_FALSE(accepts(square, sides + "a 4 2 1 1 2 2 0 1 | 1 2 3 4\n"));  // mirrored
  EXPECT_FALSE(accepts(square, sides + "f 5 0 3 5 2 9 4\n" + rule + "5 2 3 4\n"));   // a late visit
  EXPECT_FALSE(accepts(square, sides + "f 5 0 3 5 2 13 4\n" + rule + "5 2 3 4\n"));  // one outside
  EXPECT_FALSE(accepts(square, sides + rule + "-1 2 3 4\n"));
  // A start in the side is as good as a visit.
  const Instance inside = grid("..../..../..../....", {{5, 7}, {1, 13}});
  EXPECT_TRUE(accepts(inside,
                      "f 2 0 3 6 1 10 2\nf 3 1 3 5 0 6 1\nf 4 1 3 9 1 10 2\n"
                      "a 4 1 1 2 2 0 0 1 | 2 3 4\n"));
}

// 0 1 2 3 4, with a second way around from 0 to 4 of 6 steps.
TEST(Rules, TwoAgentsPassACorridor) {
  const Instance ring = [] {
    Instance made = Instance::on_graph(12, {{0, 1},
                                            {1, 2},
                                            {2, 3},
                                            {3, 4},
                                            {0, 5},
                                            {5, 6},
                                            {6, 7},
                                            {7, 8},
                                            {8, 9},
                                            {9, 4},
                                            {0, 10},
                                            {4, 11}});
    made.add_agent({10, 11});
    made.add_agent({11, 10});
    return made;
  }();
  // Agent 0 is in 4 at 5 the earliest, the other way at 7; agent 1 likewise in 0.
  EXPECT_TRUE(accepts(ring, "f 1 0 2 4 5 6\nf 2 1 2 0 5 6\na 5 2 | 1 2\n"));
  EXPECT_FALSE(accepts(ring, "f 1 0 2 4 5 6\nf 2 1 2 0 5 6\na 5 | 1 2\n"));
  EXPECT_FALSE(accepts(ring, "f 1 0 2 4 5 6\nf 2 1 2 0 5 6\na 5 2 3 | 1 2\n"));
  EXPECT_FALSE(accepts(ring, "f 1 0 2 4 5 6\nf 2 1 2 0 5 6\na 5 99 | 1 2\n"));
  EXPECT_FALSE(accepts(ring, "f 1 0 2 4 5 7\nf 2 1 2 0 5 6\na 5 2 | 1 2\n"));
  EXPECT_FALSE(accepts(ring, "f 1 0 2 4 5 6\nf 2 1 2 0 5 7\na 5 2 | 1 2\n"));
  EXPECT_FALSE(
      accepts(ring, "f 1 0 2 0 5 6\nf 2 1 2 4 5 6\na 5 2 | 1 2\n"));  // where they come from
  EXPECT_FALSE(accepts(ring, "f 1 0 2 4 5 6\nf 2 1 2 4 5 6\na 5 2 | 1 2\n"));  // one end
  EXPECT_FALSE(
      accepts(ring, "f 1 0 2 4 5 6\nf 2 1 2 0 5 6\na 5 0 | 1 2\n"));  // an end is not inside
  EXPECT_FALSE(accepts(ring, "f 1 0 2 4 5 6\nf 2 1 2 0 5 -1\na 5 2 | 1 2\n"));
  Instance started = Instance::on_graph(4, {{0, 1}, {1, 2}, {2, 3}});
  started.add_agent({1, 3});
  started.add_agent({3, 0});
  EXPECT_FALSE(accepts(started, "f 1 0 2 3 2 3\nf 2 1 2 0 3 4\na 5 1 | 1 2\n"));  // starts inside
  Instance circle = Instance::on_graph(4, {{0, 1}, {1, 2}, {2, 3}, {3, 0}});
  circle.add_agent({0, 2});
  circle.add_agent({2, 0});
  EXPECT_FALSE(accepts(circle, "f 1 0 2 2 2 3\nf 2 1 2 0 2 3\na 5 1 | 1 2\n"));
}

// 0 1 2 3 4 without a way around. Who is out first lets the other one in: agent 1 is in 0 at 5 the
// earliest, so agent 0 in 4 at 10.
TEST(Rules, TheSecondInACorridorBeginsWhenTheFirstHasEnded) {
  Instance lane =
      Instance::on_graph(9, {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {0, 5}, {0, 6}, {4, 7}, {4, 8}});
  lane.add_agent({5, 7});
  lane.add_agent({7, 5});
  EXPECT_TRUE(accepts(lane, "f 1 0 2 4 5 9\nf 2 1 2 0 5 9\na 5 2 | 1 2\n"));
  EXPECT_FALSE(accepts(lane, "f 1 0 2 4 5 10\nf 2 1 2 0 5 9\na 5 2 | 1 2\n"));
  EXPECT_FALSE(accepts(lane, "f 1 0 2 4 5 9\nf 2 1 2 0 5 10\na 5 2 | 1 2\n"));
}

/// Whether two agents can do all of these, each one or more of its visits, without colliding.
bool can_do(const Instance& instance, const std::vector<const Variable*>& usages) {
  using State = std::tuple<int, int, unsigned>;  // places, and what was done
  int end = 0;
  for (const Variable* usage : usages)
    for (const Visit& visit : usage->visits) end = std::max(end, visit.last);
  const auto with_visits = [&](int a, int b, unsigned done, int time) {
    for (std::size_t k = 0; k < usages.size(); ++k)
      for (const Visit& visit : usages[k]->visits)
        if (visit.first <= time && time <= visit.last &&
            visit.place == (usages[k]->agent == 0 ? a : b))
          done |= 1U << k;
    return State{a, b, done};
  };
  const auto moves = [&](int place) {
    const auto neighbours = instance.neighbours(place);
    std::vector<int> to(neighbours.begin(), neighbours.end());
    to.push_back(place);
    return to;
  };
  const auto &first = instance.agents()[0], &second = instance.agents()[1];
  std::set<State> states{with_visits(first.start, second.start, 0, 0)};
  for (int time = 0; time <= end; ++time) {
    std::set<State> next;
    for (const auto& [a, b, done] : states) {
      if (done + 1 == 1U << usages.size()) return true;
      for (const int c : moves(a))
        for (const int d : moves(b))
          if (c != d && (c != b || d != a)) next.insert(with_visits(c, d, done, time + 1));
    }
    states = std::move(next);
  }
  return false;
}

// Sides of random rectangles, most of them as they should be.
TEST(Rules, RectanglesAgreeWithEnumeration) {
  int num_accepted = 0;
  for (std::uint64_t seed = 0; seed < scaled(3000); ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const auto coordinate = [&] { return static_cast<int>(random.below(4)); };
    const auto cell = [](int x, int y) { return 4 * y + x; };
    const int start = cell(coordinate(), coordinate());
    const Instance instance = grid("..../..../..../....", {{start, 0}, {15 - start, 15}});
    const int x0 = coordinate(), y0 = coordinate(), x1 = coordinate(), y1 = coordinate();
    const int begin = static_cast<int>(random.between(1, 3));
    Checker checker(instance);
    checker.check({'i', {2, 0}});
    Ints clause;
    for (Int side = 0; side < 4; ++side) {
      const Int agent = side < 2 ? 0 : 1;
      Ints values{side + 1, agent, 3};
      for (int k = 0; k < 4; ++k) {
        int x = side == 0 ? x0 : side == 1 ? x1 : coordinate();
        int y = side == 2 ? y0 : side == 3 ? y1 : coordinate();
        if (side >= 2 && !random.percent(5)) x = std::clamp(x, std::min(x0, x1), std::max(x0, x1));
        if (side < 2 && !random.percent(5)) y = std::clamp(y, std::min(y0, y1), std::max(y0, y1));
        const int slip = random.percent(2) ? static_cast<int>(random.below(3)) - 1 : 0;
        const int right = x1 < x0 ? x0 - x : x - x0, down = y1 < y0 ? y0 - y : y - y0;
        values.push_back(cell(x, y));
        values.push_back(std::max(0, begin + right + down + slip));
      }
      checker.check({'f', values});
      clause.push_back(side + 1);
    }
    const Ints parameters{x0, y0, x1, y1, begin, 0, 1};
    if (!is_rectangle(instance, checker.meanings(), clause, parameters)) continue;
    ++num_accepted;
    std::vector<const Variable*> usages;
    for (const Int lit : clause) usages.push_back(&checker.meanings().variable(lit));
    ASSERT_FALSE(can_do(instance, usages));
  }
  EXPECT_GT(num_accepted, static_cast<int>(scaled(3000)) / 4);
}

// A lane with a few more roads, and times around those that can be had.
TEST(Rules, CorridorsAgreeWithEnumeration) {
  int num_accepted = 0, num_true = 0;
  for (std::uint64_t seed = 0; seed < scaled(1500); ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    constexpr int kPlaces = 8;
    std::vector<std::pair<int, int>> edges{{0, 1}, {1, 2}, {2, 3}, {0, 4}, {3, 5}};
    const auto outside = [&] { return random.pick(std::vector<int>{0, 3, 4, 5, 6, 7}); };
    std::set<std::pair<int, int>> known(edges.begin(), edges.end());
    for (int k = static_cast<int>(random.between(2, 5)); k > 0; --k) {
      const int u = outside(), v = outside();
      if (u != v && known.insert(std::minmax(u, v)).second) edges.emplace_back(std::minmax(u, v));
    }
    Instance instance = Instance::on_graph(kPlaces, edges);
    const int start = random.percent(50) ? 4 : 0, other = random.percent(50) ? 5 : 3;
    instance.add_agent({start, other});
    instance.add_agent({other, start});
    Checker checker(instance);
    checker.check({'i', {2, 0}});
    const auto last = [&] { return static_cast<Int>(random.between(2, 11)); };
    checker.check({'f', {1, 0, 2, 3, 0, last()}});
    checker.check({'f', {2, 1, 2, 0, 0, last()}});
    std::vector<const Variable*> usages{&checker.meanings().variable(1),
                                        &checker.meanings().variable(2)};
    const bool is_true = !can_do(instance, usages);
    num_true += is_true ? 1 : 0;
    Distances distances(instance);
    const Ints clause{1, 2}, inside{1};
    if (!is_corridor(instance, checker.meanings(), distances, clause, inside)) continue;
    ++num_accepted;
    ASSERT_TRUE(is_true);
  }
  EXPECT_GT(num_accepted, 0);
  EXPECT_LT(num_accepted, num_true);
}

}  // namespace
}  // namespace quadrille_check::support
