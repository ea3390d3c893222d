// SPDX-License-Identifier: MIT
//
// All agents at once, looked up by place, against each pair of stretches of each pair of agents.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "continuous/support/random_instance.hpp"
#include "continuous/support/random_walk.hpp"
#include "quadrille/continuous/verify.hpp"
#include "support/environment.hpp"
#include "verify/footprints.hpp"
#include "verify/trip.hpp"

namespace quadrille::continuous {
namespace {

using test::Draw;

/// The stretches of a way.
std::vector<Piece> pieces(Trip trip) {
  std::vector<Piece> all;
  while (const auto piece = trip.next()) all.push_back(*piece);
  return all;
}

/// Where somebody is at a moment.
long double place(const Piece& p, Ticks tick, Length Point::*axis) {
  return static_cast<long double>((p.from.*axis).value()) +
         static_cast<long double>((p.to.*axis - p.from.*axis).value()) *
             static_cast<long double>((tick - p.begin).value()) /
             static_cast<long double>((p.end - p.begin).value());
}

struct Told {
  double gap = std::numeric_limits<double>::infinity();
  /// Between which ticks they begin: what is nearer than a millionth may count or not.
  std::vector<std::pair<Ticks, Ticks>> collisions;
};

/// Each stretch of a with each one of b that is there at the same time; what goes on from one to
/// the next is one collision, unless the bodies just touch between them, which is not looked at
/// here.
Told by_hand(const Body& body_a, const std::vector<Piece>& a, const Body& body_b,
             const std::vector<Piece>& b) {
  const FootprintPair bodies(body_a, body_b);
  // When stretches begin and end, and between which ticks the bodies get into touch.
  std::vector<std::array<Ticks, 4>> meetings;
  Told told;
  for (const Piece& p : a)
    for (const Piece& q : b) {
      const Ticks begin = std::max(p.begin, q.begin), end = std::min(p.end, q.end);
      if (begin >= end) continue;
      const auto apart = [&](Ticks tick) {
        return RealPoint{place(q, tick, &Point::x) - place(p, tick, &Point::x),
                         place(q, tick, &Point::y) - place(p, tick, &Point::y),
                         place(q, tick, &Point::z) - place(p, tick, &Point::z)};
      };
      const auto gap = [&](Ticks from, Ticks to) {
        return static_cast<double>(bodies.nearest({apart(from), apart(to)}).gap);
      };
      told.gap = std::min(told.gap, gap(begin, end));
      if (gap(begin, end) > -1e-6) continue;
      // The first tick up to which they have come as near as that.
      const auto first_within = [&](double level) {
        if (gap(begin, begin) <= level) return begin;
        Ticks apart_until = begin, near_at = end;
        while (near_at - apart_until > 1) {
          const Ticks middle = apart_until + (near_at - apart_until) / 2;
          (gap(begin, middle) <= level ? near_at : apart_until) = middle;
        }
        return near_at;
      };
      meetings.push_back({begin, end, std::max(begin, first_within(1e-6) - 1),
                          std::max(begin, first_within(-1e-6) - 1)});
    }
  std::sort(meetings.begin(), meetings.end());
  for (std::size_t k = 0; k < meetings.size(); ++k)
    if (k == 0 || meetings[k - 1][1] != meetings[k][0])
      told.collisions.emplace_back(meetings[k][2], meetings[k][3]);
  return told;
}

struct Seen {
  std::size_t collisions = 0, obstacles = 0, split = 0;
};

void compare_with_pairs(const Instance& instance, const Plan& plan, Seen& seen) {
  const VerifyReport whole = verify(instance, plan, kAllClearances);
  std::map<std::pair<AgentId, AgentId>, Clearance> clearances;
  for (const Clearance& c : whole.clearances)
    EXPECT_TRUE(clearances.emplace(std::pair(c.agent, c.other), c).second);
  // As verify has it: those whose paths are sound, until after the last arrival.
  IdVector<AgentId, bool> is_sound(instance.num_agents(), true);
  for (const Violation& v : whole.violations)
    if (v.kind != Violation::Kind::collision && v.kind != Violation::Kind::obstacle)
      is_sound[v.agent] = false;
  Ticks horizon = 1;
  for (const MovingObstacle& obstacle : instance.obstacles())
    horizon = std::max(horizon, obstacle.path.back().depart + 1);
  for (const AgentId i : instance.agent_ids())
    if (is_sound[i]) horizon = std::max(horizon, plan.paths[i].back().arrive + 1);
  IdVector<AgentId, std::vector<Piece>> ways(instance.num_agents());
  for (const AgentId i : instance.agent_ids())
    if (is_sound[i])
      ways[i] = pieces(Trip(instance.roadmap(), plan.paths[i], instance.agent(i).leaves, horizon));
  for (const AgentId i : instance.agent_ids())
    for (const AgentId j : instance.agent_ids()) {
      if (i >= j) continue;
      const Told told = by_hand(instance.agent(i).body, ways[i], instance.agent(j).body, ways[j]);
      const auto found = clearances.find({i, j});
      ASSERT_EQ(found != clearances.end(), std::isfinite(told.gap));
      if (found != clearances.end()) {
        EXPECT_NEAR(found->second.gap, told.gap, 1e-9);
      }
      std::vector<Ticks> here;
      for (const Violation& v : whole.violations)
        if (v.agent == i && v.other == j) here.push_back(v.tick);
      // What is one collision is decided at the moments at which stretches end, exactly.
      ASSERT_EQ(here.empty(), told.collisions.empty());
      for (const auto& [least, most] : told.collisions)
        EXPECT_TRUE(std::any_of(here.begin(), here.end(), [&, low = least, high = most](Ticks t) {
          return low <= t && t <= high;
        }));
      seen.collisions += here.size();
      seen.split += here.size() - told.collisions.size();
    }
  for (const Violation& v : whole.violations)
    if (v.kind == Violation::Kind::obstacle) ++seen.obstacles;
  EXPECT_TRUE(std::is_sorted(whole.clearances.begin(), whole.clearances.end(),
                             [](const Clearance& a, const Clearance& b) { return a.gap < b.gap; }));
  // The least ones are the first of all, however few are asked for.
  for (const std::size_t num : {std::size_t{0}, std::size_t{1}, std::size_t{3}}) {
    const VerifyReport least = verify(instance, plan, num);
    ASSERT_EQ(least.clearances.size(), std::min(num, whole.clearances.size()));
    for (std::size_t k = 0; k < least.clearances.size(); ++k) {
      EXPECT_EQ(least.clearances[k].gap, whole.clearances[k].gap);
      EXPECT_EQ(least.clearances[k].tick, whole.clearances[k].tick);
      EXPECT_EQ(least.clearances[k].agent, whole.clearances[k].agent);
      EXPECT_EQ(least.clearances[k].other, whole.clearances[k].other);
    }
    ASSERT_EQ(least.violations.size(), whole.violations.size());
    for (std::size_t k = 0; k < least.violations.size(); ++k)
      EXPECT_EQ(least.violations[k].message, whole.violations[k].message);
  }
}

TEST(Replay, FindsWhatPairsFind) {
  Seen seen;
  for (std::uint32_t seed = 0; seed < support::scaled(300); ++seed) {
    test::RandomOptions random;
    random.shapes_percent = 0;
    random.num_vertices = 12;
    random.num_agents = 5;
    random.edge_percent = 25;
    random.obstacles_percent = random.leaves_percent = random.release_percent = 25;
    if (seed % 3 == 1) random.size = 20'000, random.max_radius = 3'000;
    const Instance instance = test::random_instance(seed, random);
    SCOPED_TRACE(testing::Message() << "seed " << seed << ": " << test::describe(instance));
    Draw draw(seed);
    for (int k = 0; k < 4; ++k) {
      Plan plan;
      for (const AgentId i : instance.agent_ids())
        plan.paths.push_back(test::draw_path(draw, instance, i));
      compare_with_pairs(instance, plan, seen);
      if (testing::Test::HasFailure()) return;
    }
  }
  EXPECT_GT(seen.collisions, support::scaled(300));
  EXPECT_GT(seen.obstacles, support::scaled(20));
  EXPECT_LT(seen.split, seen.collisions / 4);
}

}  // namespace
}  // namespace quadrille::continuous
