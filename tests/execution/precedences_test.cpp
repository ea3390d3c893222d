// SPDX-License-Identifier: MIT
#include "quadrille/execution/precedences.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <memory>
#include <variant>

#include "execution/plans.hpp"
#include "execution/replay.hpp"
#include "quadrille/discrete/graph.hpp"
#include "support/environment.hpp"

namespace quadrille::execution::test {
namespace {

using continuous::Agent;
using continuous::Disc;
using geometry::Point;
using quadrille::support::scaled;

VertexId v(std::size_t index) { return VertexId(index); }

/// A crossing of two roads of length 20, with agents of this radius from west to east and from
/// south to north.
continuous::Instance crossing(geometry::Length radius) {
  auto roadmap = continuous::Roadmap::make({{-10, 0}, {10, 0}, {0, -10}, {0, 10}},
                                           {{v(0), v(1), {}}, {v(2), v(3), {}}});
  return continuous::Instance::make(
             std::make_shared<const continuous::Roadmap>(std::move(roadmap).value()),
             {{v(0), v(1), Disc{radius}, continuous::kUnitSpeed},
              {v(2), v(3), Disc{radius}, continuous::kUnitSpeed}})
      .value();
}

continuous::Plan crossing_plan(Ticks second_start) {
  continuous::Plan plan;
  plan.paths.push_back({{v(0), 0, 0}, {v(1), 20, 20}});
  plan.paths.push_back({{v(2), 0, second_start}, {v(3), second_start + 20, second_start + 20}});
  return plan;
}

TEST(Precedences, SlackIsWhatIsLeftToTheNearestUnsafeOffset) {
  // Two points at right angles, offset d: the least distance is d / sqrt(2). Radii 3 and 3 collide
  // for d <= 8.
  const auto nine = precedences(crossing(3), crossing_plan(9));
  ASSERT_TRUE(nine.has_value());
  EXPECT_EQ(nine->list, (std::vector<Precedence>{{{AgentId(0), 0}, {AgentId(1), 0}, 0}}));
  EXPECT_EQ(nine->moves[AgentId(1)], (std::vector<TimedMove>{{v(2), v(3), 9, 29}}));
  EXPECT_EQ(nine->end(AgentId(1)), Ticks(29));
  EXPECT_TRUE(nine->overlaps(nine->list.front()));
  const auto fifty = precedences(crossing(3), crossing_plan(50));
  ASSERT_TRUE(fifty.has_value());
  EXPECT_EQ(fifty->list, (std::vector<Precedence>{{{AgentId(0), 0}, {AgentId(1), 0}, 41}}));
  EXPECT_FALSE(fifty->overlaps(fifty->list.front()));
}

TEST(Precedences, APlanWithACollisionIsRefused) {
  const auto refused = precedences(crossing(3), crossing_plan(8));
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().code, ErrorCode::invalid_plan);
  EXPECT_NE(refused.error().message.find("agent"), std::string::npos) << refused.error().message;
}

TEST(Precedences, MovesGoOnWhereNobodyMayWait) {
  auto roadmap = continuous::Roadmap::make({{0, 0}, {10, 0}, {20, 0}},
                                           {{v(0), v(1), {}}, {v(1), v(2), {}}}, {}, {}, {v(1)});
  const auto instance =
      continuous::Instance::make(std::move(roadmap).value(), {{v(0), v(2), Disc{1}}});
  continuous::Plan plan;
  plan.paths.push_back({{v(0), 0, 0}, {v(1), 10, 10}, {v(2), 20, 20}});
  const auto order = precedences(*instance, plan);
  ASSERT_TRUE(order.has_value());
  EXPECT_EQ(order->moves[AgentId(0)],
            (std::vector<TimedMove>{{v(0), v(1), 0, 10, true}, {v(1), v(2), 10, 20, false}}));
}

TEST(Precedences, AWindowBetweenTwoTicksCounts) {
  // Fast and small: agent 0 passes the crossing 2 ticks after it has begun, agent 1 after 1.2; they
  // collide at offsets near 0.8 and at no whole one. Delays need not be whole.
  auto roadmap = continuous::Roadmap::make({{-50, 0}, {50, 0}, {0, -40}, {0, 60}},
                                           {{v(0), v(1), Ticks(4)}, {v(2), v(3), Ticks(3)}});
  const auto instance = continuous::Instance::make(
      std::make_shared<const continuous::Roadmap>(std::move(roadmap).value()),
      {{v(0), v(1), Disc{1}, continuous::kUnitSpeed},
       {v(2), v(3), Disc{1}, continuous::kUnitSpeed}});
  ASSERT_TRUE(instance.has_value());
  for (const std::int64_t offset : {-3, 0, 1, 7}) {
    continuous::Plan plan;
    const Ticks first(std::max<std::int64_t>(0, -offset)),
        second(std::max<std::int64_t>(0, offset));
    plan.paths.push_back({{v(0), 0, first}, {v(1), first + 4, first + 4}});
    plan.paths.push_back({{v(2), 0, second}, {v(3), second + 3, second + 3}});
    const auto order = precedences(*instance, plan);
    ASSERT_TRUE(order.has_value()) << order.error().to_string();
    const Precedence wanted = offset >= 1
                                  ? Precedence{{AgentId(0), 0}, {AgentId(1), 0}, Ticks(offset - 1)}
                                  : Precedence{{AgentId(1), 0}, {AgentId(0), 0}, Ticks(-offset)};
    EXPECT_EQ(order->list, std::vector<Precedence>{wanted}) << offset;
  }
}

TEST(Precedences, WhoOnlyTouchIsFree) {
  // Agent 0 goes to (100, 0) and back, agent 1 to (100, 21): radii 10 and 11 touch there.
  auto roadmap = continuous::Roadmap::make(
      {{0, 0}, {100, 0}, {100, 21}, {200, 21}},
      {{v(0), v(1), Ticks(4)}, {v(1), v(0), Ticks(4)}, {v(3), v(2), Ticks(3)}});
  const auto instance = continuous::Instance::make(
      std::make_shared<const continuous::Roadmap>(std::move(roadmap).value()),
      {{v(0), v(0), Disc{10}, continuous::kUnitSpeed},
       {v(3), v(2), Disc{11}, continuous::kUnitSpeed}});
  ASSERT_TRUE(instance.has_value());
  continuous::Plan plan;
  plan.paths.push_back({{v(0), 0, 0}, {v(1), 4, 4}, {v(0), 8, 8}});
  plan.paths.push_back({{v(3), 0, 1}, {v(2), 4, 4}});
  const auto order = precedences(*instance, plan);
  ASSERT_TRUE(order.has_value()) << order.error().to_string();
  EXPECT_TRUE(order->list.empty());
}

TEST(Precedences, TimestepsFollowTheLastVisitor) {
  // 0 - 1 - 2 - 3: agent 0 goes ahead, agent 1 follows at its heels, agent 2 comes to 1 later.
  auto graph = discrete::Graph::make(5, {{v(0), v(1)}, {v(1), v(2)}, {v(2), v(3)}, {v(1), v(4)}});
  const auto instance = discrete::Instance::make(std::move(graph).value(),
                                                 {{v(1), v(3)}, {v(0), v(2)}, {v(4), v(1)}});
  ASSERT_TRUE(instance.has_value());
  discrete::Plan plan;
  plan.paths.push_back({v(1), v(2), v(3)});
  plan.paths.push_back({v(0), v(1), v(2)});
  plan.paths.push_back({v(4), v(4), v(4), v(4), v(1)});
  const auto order = precedences(*instance, plan);
  ASSERT_TRUE(order.has_value()) << order.error().to_string();
  EXPECT_EQ(order->list, (std::vector<Precedence>{{{AgentId(0), 0}, {AgentId(1), 0}, 0},
                                                  {{AgentId(0), 1}, {AgentId(1), 1}, 0},
                                                  {{AgentId(1), 1}, {AgentId(2), 0}, 2}}));
  EXPECT_EQ(order->moves[AgentId(2)], (std::vector<TimedMove>{{v(4), v(1), 3, 4}}));
}

// A second opinion on each single slack: with the clocks apart by as much, or by less, the two
// moves never collide; by one tick more, they do.

__extension__ typedef __int128 Wide;

/// Whether two discs that move as `a` and `b` say, b's clock ahead of a's by `lead`, collide while
/// both are on their moves. Exact.
bool discs_collide(const ContinuousCase& c, const Precedences& order, const MoveId& a,
                   const MoveId& b, std::int64_t lead) {
  const auto point = [&](VertexId vertex) {
    const Point& p = c.instance.roadmap().position(vertex);
    return std::array<Wide, 3>{p.x.value(), p.y.value(), p.z.value()};
  };
  const TimedMove &ma = order.at(a), &mb = order.at(b);
  const Wide duration_a = (ma.end - ma.begin).value(), duration_b = (mb.end - mb.begin).value();
  const auto radius = [&](const MoveId& id) -> Wide {
    return std::get<Disc>(c.instance.agent(id.agent).body).radius.value();
  };
  // s: since a began. b is at s - shift. All is multiplied by both durations.
  const Wide shift = (mb.begin - ma.begin).value() - lead;
  const Wide first = std::max<Wide>(0, shift), last = std::min(duration_a, duration_b + shift);
  if (first > last) return false;
  const auto [ax0, ay0, az0] = point(ma.from);
  const auto [ax1, ay1, az1] = point(ma.to);
  const auto [bx0, by0, bz0] = point(mb.from);
  const auto [bx1, by1, bz1] = point(mb.to);
  const Wide both = duration_a * duration_b;
  const Wide vx = (bx1 - bx0) * duration_a - (ax1 - ax0) * duration_b;
  const Wide vy = (by1 - by0) * duration_a - (ay1 - ay0) * duration_b;
  const Wide vz = (bz1 - bz0) * duration_a - (az1 - az0) * duration_b;
  const Wide px = (bx0 - ax0) * both - (bx1 - bx0) * duration_a * shift;
  const Wide py = (by0 - ay0) * both - (by1 - by0) * duration_a * shift;
  const Wide pz = (bz0 - az0) * both - (bz1 - bz0) * duration_a * shift;
  const Wide reach = (radius(a) + radius(b)) * both;
  const auto is_near = [&](Wide s) {
    const Wide x = px + vx * s, y = py + vy * s, z = pz + vz * s;
    return x * x + y * y + z * z < reach * reach;
  };
  if (is_near(first) || is_near(last)) return true;
  const Wide square = vx * vx + vy * vy + vz * vz, along = -(px * vx + py * vy + pz * vz);
  if (square == 0 || along <= first * square || along >= last * square) return false;
  const Wide x = py * vz - pz * vy, y = pz * vx - px * vz, z = px * vy - py * vx;
  return x * x + y * y + z * z < reach * reach * square;
}

/// The least separation of two bodies on the moves `a` and `b`, b's clock ahead of a's by `lead`.
Replay::Real separation(const Replay& replay, const Precedences& order, const MoveId& a,
                        const MoveId& b, Replay::Real lead) {
  const auto real = [](Ticks ticks) { return static_cast<Replay::Real>(ticks.value()); };
  const TimedMove &ma = order.at(a), &mb = order.at(b);
  const Replay::Real low = std::max(real(ma.begin), real(mb.begin) - lead);
  const Replay::Real high = std::min(real(ma.end), real(mb.end) - lead);
  if (low > high) return 1;
  return replay.separation(a.agent, low, high, b.agent, low + lead, high + lead);
}

/// Whether the two collide with a lead of a tick more than the slack, or some part of one. A hair
/// more, because who leaves is still there in its last moment, but not for Replay.
bool collide_within_a_tick(const Replay& replay, const Precedences& order, const Precedence& p) {
  const auto slack = static_cast<Replay::Real>(p.slack.value());
  for (int part = 4097; part >= 1; --part)
    if (separation(replay, order, p.leader, p.follower, slack + part / Replay::Real{4096}) < 0)
      return true;
  return false;
}

TEST(Precedences, OneTickMoreThanEachSlackAndTheTwoCollide) {
  std::size_t num_discs = 0, num_polygons = 0;
  for (std::uint32_t seed = 0; seed < scaled(200); ++seed) {
    const auto c = continuous_case(seed, 2 + seed % 3);
    if (!c) continue;
    const auto order = precedences(c->instance, c->plan);
    ASSERT_TRUE(order.has_value()) << order.error().to_string();
    const Replay replay(c->instance, c->plan);
    for (const Precedence& p : order->list) {
      SCOPED_TRACE("seed " + std::to_string(seed));
      ASSERT_GE(p.slack, Ticks(0));
      const std::int64_t slack = p.slack.value();
      const auto is_disc = [&](AgentId i) {
        const Agent& agent = c->instance.agent(i);
        return agent.shapes.empty() && std::holds_alternative<Disc>(agent.body);
      };
      if (!is_disc(p.leader.agent) || !is_disc(p.follower.agent)) {
        ++num_polygons;
        for (const std::int64_t less : {0, 1, 2, 5, 10, 20, 50, 100})
          ASSERT_GE(separation(replay, *order, p.leader, p.follower,
                               static_cast<Replay::Real>(slack - less)),
                    -1e-9L)
              << slack - less;
        EXPECT_TRUE(collide_within_a_tick(replay, *order, p));
        continue;
      }
      ++num_discs;
      for (std::int64_t lead = -200; lead <= slack; ++lead)
        ASSERT_FALSE(discs_collide(*c, *order, p.leader, p.follower, lead)) << lead;
      EXPECT_TRUE(discs_collide(*c, *order, p.leader, p.follower, slack + 1) ||
                  collide_within_a_tick(replay, *order, p));
    }
  }
  EXPECT_GE(num_discs, scaled(400));
  EXPECT_GE(num_polygons, scaled(100));
}

}  // namespace
}  // namespace quadrille::execution::test
