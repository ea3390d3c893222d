// SPDX-License-Identifier: MIT
// Agents that go through vertices where nobody may wait are let through, or stay before them.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "execution/plans.hpp"
#include "execution/replay.hpp"
#include "quadrille/execution/executor.hpp"
#include "quadrille/execution/node_order.hpp"
#include "quadrille/execution/releaser.hpp"
#include "quadrille/execution/simulation.hpp"
#include "support/environment.hpp"

namespace quadrille::execution::test {
namespace {

using continuous::Disc;
using quadrille::support::scaled;

VertexId v(std::size_t index) { return VertexId(index); }

std::vector<Replay::Real> real(std::span<const Ticks> clocks) {
  std::vector<Replay::Real> result;
  for (const Ticks clock : clocks) result.push_back(static_cast<Replay::Real>(clock.value()));
  return result;
}

/// The same on a roadmap where everybody may wait everywhere, with the passages marked here.
Precedences marked(const ContinuousCase& c) {
  const continuous::Roadmap& roads = c.instance.roadmap();
  const auto plain = continuous::Roadmap::make(roads.positions(), roads.edges(),
                                               roads.lane_places(), roads.shapes())
                         .value();
  const auto instance =
      continuous::Instance::make(plain, c.instance.agents().items(), c.instance.resolution(), {},
                                 {}, c.instance.now())
          .value();
  Precedences order = precedences(instance, c.plan).value();
  for (auto& moves : order.moves)
    for (std::size_t k = 0; k + 1 < moves.size(); ++k)
      moves[k].goes_on = !roads.may_wait(moves[k].to);
  return order;
}

/// What an agent has to have got to before others, from docs/execution.md: nothing is executed.
class Needs {
 public:
  explicit Needs(const Precedences& order) : order_(order), until_(order.num_agents(), order.now) {}

  /// Whether the agent can begin the passage that begins with this move only after it has.
  bool is_circular(const MoveId& entry) {
    std::fill(until_.begin(), until_.end(), order_.now);
    open_.clear();
    enter(entry);
    while (!open_.empty()) {
      const AgentId agent = open_.back();
      open_.pop_back();
      const Ticks until = until_[agent.index()];
      const auto& moves = order_.moves[agent];
      for (std::uint32_t k = 0; k < moves.size(); ++k) {
        const MoveId id{agent, k};
        if (starts_passage(id)) {
          if (moves[k].begin < until) enter(id);
        } else if (!is_inside(id) && moves[k].begin < until) {
          follow(id, std::min(until, moves[k].end));
        }
      }
    }
    return until_[entry.agent.index()] > order_.at(entry).begin;
  }
  bool starts_passage(const MoveId& id) const { return order_.at(id).goes_on && !is_inside(id); }
  bool is_inside(const MoveId& id) const {
    return id.move > 0 && order_.moves[id.agent][id.move - 1].goes_on;
  }

 private:
  void enter(MoveId id) {
    for (bool more = true; more; ++id.move) {
      follow(id, order_.at(id).end);
      more = order_.at(id).goes_on;
    }
  }
  /// For the agent to come to a time within a move.
  void follow(const MoveId& id, Ticks time) {
    for (const Precedence& p : order_.list)
      if (p.follower == id) need(p.leader.agent, std::min(order_.at(p.leader).end, time - p.slack));
  }
  void need(AgentId agent, Ticks until) {
    if (until <= until_[agent.index()]) return;
    until_[agent.index()] = until;
    open_.push_back(agent);
  }

  const Precedences& order_;
  std::vector<Ticks> until_;
  std::vector<AgentId> open_;
};

bool blocks(const Precedences& order) {
  Needs needs(order);
  for (const AgentId agent : IdRange<AgentId>(order.num_agents()))
    for (std::uint32_t k = 0; k < order.moves[agent].size(); ++k)
      if (needs.starts_passage({agent, k}) && needs.is_circular({agent, k})) return true;
  return false;
}

/// Agent 1 goes from (0, 0) by (10, 0), where nobody may wait, to (40, 0); agent 0 has crossed its
/// second move at (30, 0) before.
ContinuousCase crossing() {
  auto roadmap = continuous::Roadmap::make({{30, -20}, {30, 20}, {0, 0}, {10, 0}, {40, 0}},
                                           {{v(0), v(1), {}}, {v(2), v(3), {}}, {v(3), v(4), {}}},
                                           {}, {}, {v(3)})
                     .value();
  auto instance =
      continuous::Instance::make(std::move(roadmap), {{v(0), v(1), Disc{3}}, {v(2), v(4), Disc{3}}})
          .value();
  continuous::Plan plan;
  plan.paths.push_back({{v(0), 0, 0}, {v(1), 40, 40}});
  plan.paths.push_back({{v(2), 0, 5}, {v(3), 15, 15}, {v(4), 45, 45}});
  return {std::move(instance), std::move(plan)};
}

TEST(Passages, WhoIsLetOnIsLetThrough) {
  const ContinuousCase c = crossing();
  const Precedences order = precedences(c.instance, c.plan).value();
  EXPECT_TRUE(order.moves[AgentId(1)][0].goes_on);
  EXPECT_FALSE(order.moves[AgentId(1)][1].goes_on);
  ASSERT_EQ(order.list.size(), 1U);
  const Precedence& only = order.list.front();
  ASSERT_EQ(only.follower, (MoveId{AgentId(1), 1}));
  EXPECT_EQ(order.entry(only.follower), (MoveId{AgentId(1), 0}));
  Executor executor(order);
  const Ticks free = std::min(Ticks(40), 45 - only.slack);
  std::vector<Ticks> limits(2), targets;
  for (Ticks leader = 0; leader <= 40; leader += 1) {
    const std::vector<Ticks> clocks{leader, 5};
    executor.limits(clocks, limits);
    EXPECT_EQ(limits[1], leader < free ? Ticks(5) : Executor::kUnlimited) << leader.value();
    targets = {leader, 45};
    executor.couple(clocks, targets);
    EXPECT_EQ(targets[1], leader < free ? Ticks(5) : Ticks(45)) << leader.value();
  }
  executor.reset();
  targets = {39, 45};
  executor.gate(std::vector<Ticks>{39, 5}, targets);
  EXPECT_EQ(targets[1], Ticks(5));
  Releaser releaser(order);
  EXPECT_EQ(releaser.released(AgentId(1)), 0U);
  releaser.end_moves(AgentId(0), 1);
  EXPECT_EQ(releaser.released(AgentId(1)), 2U);
}

/// Two agents that go around a square against each other's halves: the first move of each crosses
/// the second one of the other.
ContinuousCase knot() {
  auto roadmap = continuous::Roadmap::make(
                     {{0, 0}, {40, 0}, {40, 40}, {70, 20}, {20, 20}, {20, -30}},
                     {{v(0), v(1), {}}, {v(1), v(2), {}}, {v(3), v(4), {}}, {v(4), v(5), {}}}, {},
                     {}, {v(1), v(4)})
                     .value();
  auto instance =
      continuous::Instance::make(std::move(roadmap), {{v(0), v(2), Disc{3}}, {v(3), v(5), Disc{3}}})
          .value();
  continuous::Plan plan;
  plan.paths.push_back({{v(0), 0, 0}, {v(1), 40, 40}, {v(2), 80, 80}});
  plan.paths.push_back({{v(3), 0, 0}, {v(4), 50, 50}, {v(5), 100, 100}});
  return {std::move(instance), std::move(plan)};
}

TEST(Passages, WhoWouldWaitForEachOtherForEverIsRefused) {
  const ContinuousCase c = knot();
  EXPECT_TRUE(blocks(marked(c)));
  const auto order = precedences(c.instance, c.plan);
  ASSERT_FALSE(order.has_value());
  EXPECT_EQ(order.error().code, ErrorCode::invalid_plan);
  EXPECT_EQ(order.error().message,
            "where nobody may wait, agents go through at once, and so they would wait for each "
            "other for ever: agent 0 at vertex 0 before vertex 1, agent 1 at vertex 3 before "
            "vertex 4");
}

TEST(PassagesRandom, NobodyCollidesOrStopsAndAllArrive) {
  std::size_t num_passages = 0, num_blocked = 0, num_gated = 0;
  const std::size_t count = scaled(500);
  for (std::uint32_t seed = 0, k = 0; k < count; ++seed) {
    const auto c = passing_case(seed, 3 + seed % 5);
    if (!c) continue;
    ++k;
    SCOPED_TRACE(seed);
    const Precedences expected = marked(*c);
    const auto order = precedences(c->instance, c->plan);
    ASSERT_EQ(order.has_value(), !blocks(expected));
    if (!order) {
      ++num_blocked;
      ASSERT_NE(order.error().message.find("where nobody may wait"), std::string::npos);
      continue;
    }
    ASSERT_EQ(*order, expected);
    for (const auto& moves : order->moves)
      num_passages += static_cast<std::size_t>(std::ranges::count_if(moves, &TimedMove::goes_on));
    const bool can_be_gated = node_order(*order).acyclic();
    num_gated += can_be_gated ? 1 : 0;
    const Replay replay(c->instance, c->plan);
    for (const Rule rule : {Rule::coupled, Rule::gated})
      for (std::uint64_t draw = 0; draw < 3; ++draw) {
        const Delays delays = draw_delays(*order, {.pause_chance = 0.3, .longest_pause = 40}, draw);
        Replay::Real least = 1;
        bool has_stopped = false;
        const auto look = [&](std::span<const Ticks> before, std::span<const Ticks> after) {
          least = std::min(least, replay.least_separation(real(before), real(after)));
          for (const AgentId agent : c->instance.agent_ids()) {
            const Ticks clock = before[agent.index()];
            const auto& moves = order->moves[agent];
            for (std::size_t m = 0; m + 1 < moves.size(); ++m)
              // A pause is somewhere in a move, if that takes more than a tick.
              if (moves[m].goes_on && moves[m].end == clock && moves[m + 1].end > clock + 1)
                has_stopped = has_stopped || after[agent.index()] == clock;
          }
        };
        const auto result = simulate(*order, delays, rule, 3, look);
        ASSERT_GT(least, -1e-8L);
        ASSERT_FALSE(has_stopped);
        if (rule == Rule::coupled || can_be_gated) {
          ASSERT_TRUE(result.all_arrived);
        } else {
          ASSERT_FALSE(result.all_arrived);
        }
      }
    Releaser releaser(*order);
    for (const AgentId agent : c->instance.agent_ids()) {
      const std::uint32_t released = releaser.released(agent);
      if (released > 0 && released < order->moves[agent].size()) {
        ASSERT_FALSE(order->moves[agent][released - 1].goes_on);
      }
    }
  }
  RecordProperty("passages", static_cast<int>(num_passages));
  RecordProperty("blocked", static_cast<int>(num_blocked));
  RecordProperty("gated", static_cast<int>(num_gated));
  if (count < 100) return;  // scaled down, for slow builds: too few to count on chance
  EXPECT_GE(3 * num_passages, count);
  EXPECT_GE(num_blocked, count / 100);
  EXPECT_GE(num_gated, count / 100);
}

}  // namespace
}  // namespace quadrille::execution::test
