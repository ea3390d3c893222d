// SPDX-License-Identifier: MIT
//
// What is said of agents without looking at single plans, against plans of the oracle: the search
// of pairs may refute no plan, and agents that have one are not blocked.
#include "pairs/pair_search.hpp"

#include <gtest/gtest.h>

#include "continuous/routes/order_search.hpp"
#include "continuous/support/random_instance.hpp"
#include "continuous/support/roads.hpp"
#include "feasibility/feasibility.hpp"
#include "support/environment.hpp"

namespace quadrille::continuous::test {
namespace {

constexpr std::int64_t kManySteps = 1'000'000;

TimedPath moves_of(const Instance& instance, AgentId agent, const Path& path) {
  TimedPath moves{{}, as_ticks(cost(path))};
  for (std::size_t k = 0; k + 1 < path.size(); ++k)
    for (const EdgeId e : instance.out_edges(instance.class_of(agent), path[k].vertex))
      if (instance.roadmap().edge(e).to == path[k + 1].vertex &&
          path[k].depart + instance.duration(instance.class_of(agent), e) == path[k + 1].arrive) {
        moves.moves.push_back({e, path[k].depart});
        break;
      }
  EXPECT_EQ(moves.moves.size() + 1, path.size());
  return moves;
}

/// Random bans that the path obeys, one per slot.
void add_bans(const Instance& instance, AgentId agent, const Path& path, Draw& draw,
              BanTable& table) {
  PathUses uses;
  uses.assign(instance, agent, moves_of(instance, agent, path));
  const Roadmap& roadmap = instance.roadmap();
  for (int tried = 0; tried < 8; ++tried) {
    const Ticks begin = draw.ticks(0, cost(path) + 30);
    const Ticks end = begin + draw.ticks(1, 40);
    const auto random_index = [&](std::size_t size) {
      return static_cast<std::size_t>(draw.number(0, static_cast<std::int64_t>(size) - 1));
    };
    const Ban ban = roadmap.num_edges() > 0 && draw.number(0, 1) == 0
                        ? Ban::start(EdgeId(random_index(roadmap.num_edges())), {begin, end})
                        : Ban::stay(VertexId(random_index(roadmap.num_vertices())), {begin, end});
    if (!uses.breaks(ban)) table.add(std::vector<Ban>{ban});
  }
}

struct Count {
  int searches = 0, refuted = 0;
  int refuted_wide = 0;  ///< With intervals as long as they may be.
};

/// Caps that the plan exceeds, or just keeps: what is refuted has to end where the plan begins.
void check(Scene& scene, const Plan& plan, bool has_bans, Draw& draw, Count& count) {
  const Instance& instance = scene.instance();
  PairSearch search(scene);
  for (const std::size_t first : {0U, 1U}) {
    const AgentId i(first), j(1 - first);
    const Cost cost_i = cost(plan.paths[i]), cost_j = cost(plan.paths[j]);
    if (cost_i == scene.free_cost(i) && !has_bans) continue;  // nothing may be refuted
    for (int round = 0; round < 3; ++round) {
      for (const std::size_t side : {0U, 1U}) {
        const AgentId agent = side == 0 ? i : j;
        search.bans(side).clear(scene.standing_bans(agent));
        if (has_bans) add_bans(instance, agent, plan.paths[agent], draw, search.bans(side));
      }
      const Cost cap_i = draw.number(scene.free_cost(i), cost_i);
      const Cost cap_j = cost_j + draw.number(0, 2);
      const Ticks max_raise = draw.ticks(0, 60);
      for (const Ticks width : {kForever, draw.ticks(1, 20)}) {
        search.set_width(width);
        const Cost raise =
            as_cost(search.refuted_raise({i, as_ticks(cap_i)}, {j, as_ticks(cap_j)}, max_raise,
                                         width < kForever ? 50'000 : kManySteps));
        ASSERT_GE(raise, 0);
        // No plan has cost(i) < cap_i + raise and cost(j) <= cap_j: this one has.
        if (raise > 0) {
          ASSERT_GE(cost_i, cap_i + raise) << "caps " << cap_i << " and " << cap_j << " of agents "
                                           << first << " and " << 1 - first << ", width " << width;
        }
        (width < kForever ? count.refuted : count.refuted_wide) += raise > 0 ? 1 : 0;
      }
      ++count.searches;
    }
  }
}

void check_instances(bool has_bans, Count& count) {
  for (std::uint32_t seed = 0; seed < support::scaled(250); ++seed) {
    const Instance instance = random_pair(5'000'000 + seed);
    SCOPED_TRACE("seed " + std::to_string(5'000'000 + seed) + ": " + describe(instance));
    LimitMonitor limits({});
    Scene scene(instance, limits);
    Draw draw(seed);
    for (const Plan& plan : known_plans(instance, 4)) {
      check(scene, plan, has_bans, draw, count);
      if (testing::Test::HasFatalFailure()) return;
    }
  }
}

/// The test is of no use if nothing is refuted. Measured: a tenth, and with short
/// intervals a tenth or a sixth more.
void expect_many(const Count& count) {
  EXPECT_GT(20 * count.refuted_wide, count.searches);
  EXPECT_GT(count.refuted, count.refuted_wide);
}

TEST(PairSearch, RefutesNoPlan) {
  Count count;
  check_instances(false, count);
  expect_many(count);
}

TEST(PairSearch, RefutesNoPlanThatObeysTheBans) {
  Count count;
  check_instances(true, count);
  expect_many(count);
}

/// In a corridor two agents cannot change places, not either when one of them is at its last move.
TEST(PairSearch, KnowsTheLastMoveUntilItsEnd) {
  const auto instance = Instance::make(roadmap({{0, 0}, {20, 0}, {40, 0}}, {{0, 1}, {1, 2}}),
                                       {agent(0, 2, 2), agent(1, 0, 2)})
                            .value();
  LimitMonitor limits({});
  Scene scene(instance, limits);
  PairSearch search(scene);
  const auto party = [&](AgentId i) {
    return PairSearch::Party{i, as_ticks(scene.free_cost(i) + 10)};
  };
  for (const Ticks width : {kForever, Ticks{4}}) {
    search.set_width(width);
    EXPECT_EQ(search.refuted_raise(party(AgentId(0)), party(AgentId(1)), Ticks{5}, kManySteps),
              Ticks{6});
    EXPECT_EQ(search.refuted_raise(party(AgentId(1)), party(AgentId(0)), Ticks{5}, kManySteps),
              Ticks{6});
  }
}

/// What it keeps from the search before does not depend on the bans.
TEST(PairSearch, FindsWhatANewOneFinds) {
  int changes = 0;
  for (std::uint32_t seed = 0; seed < support::scaled(250); ++seed) {
    const Instance instance = random_pair(7'000'000 + seed);
    LimitMonitor limits({});
    Scene scene(instance, limits);
    Draw draw(seed);
    for (const Plan& plan : known_plans(instance, 2)) {
      const AgentId i(0), j(1);
      const Cost cost_i = cost(plan.paths[i]);
      const PairSearch::Party first{i, as_ticks(draw.number(scene.free_cost(i), cost_i))};
      const PairSearch::Party second{j, as_ticks(cost(plan.paths[j]))};
      const Ticks max_raise = draw.ticks(0, 60);
      PairSearch search(scene);
      std::optional<Ticks> last;
      for (std::uint32_t round = 0; round < 4; ++round) {
        PairSearch other(scene);
        for (PairSearch* each : {&search, &other}) {
          Draw bans(4 * seed + round);
          for (const std::size_t side : {0U, 1U}) {
            const AgentId agent = side == 0 ? i : j;
            each->bans(side).clear(scene.standing_bans(agent));
            add_bans(instance, agent, plan.paths[agent], bans, each->bans(side));
          }
        }
        const Ticks width = round % 2 == 0 ? kForever : draw.ticks(1, 20);
        search.set_width(width);
        other.set_width(width);
        const Ticks found = search.refuted_raise(first, second, max_raise, kManySteps);
        ASSERT_EQ(found, other.refuted_raise(first, second, max_raise, kManySteps))
            << "seed " << 7'000'000 + seed << ", round " << round << ": " << describe(instance);
        changes += last && *last != found ? 1 : 0;
        last = found;
      }
    }
  }
  EXPECT_GT(changes, 0);
}

/// A square of so many vertices a side, 1000 apart, all neighbours joined.
std::shared_ptr<const Roadmap> square(std::size_t side) {
  std::vector<Point> points;
  Roads roads;
  for (std::size_t y = 0; y < side; ++y)
    for (std::size_t x = 0; x < side; ++x) {
      points.push_back({Length(1000 * static_cast<std::int64_t>(x)),
                        Length(1000 * static_cast<std::int64_t>(y))});
      if (x > 0) roads.emplace_back(y * side + x - 1, y * side + x);
      if (y > 0) roads.emplace_back((y - 1) * side + x, y * side + x);
    }
  return roadmap(std::move(points), roads);
}

// Two agents with so much room that most of the work is to find out what can collide.
TEST(PairSearch, LooksAtWhatIsNearAndCountsThat) {
  constexpr std::size_t side = 40;
  const auto map = square(side);
  const auto instance =
      Instance::make(map, {agent(0, side * side - 1, 300), agent(side - 1, side * (side - 1), 300)})
          .value();
  LimitMonitor limits({});
  Scene scene(instance, limits);
  PairSearch search(scene);
  const auto look = [&](std::int64_t raise) {
    const std::int64_t before = search.num_looks();
    const auto party = [&](std::size_t i) {
      return PairSearch::Party{AgentId(i), as_ticks(scene.free_cost(AgentId(i)))};
    };
    static_cast<void>(search.refuted_raise(party(0), party(1), Ticks(raise), 10));
    return search.num_looks() - before;
  };
  const std::int64_t looks = look(3000);
  // An agent has all edges to choose from, and each move some thirty of the other one's near it.
  const auto num_edges = static_cast<std::int64_t>(map->num_edges());
  EXPECT_GT(looks, num_edges);
  EXPECT_LT(looks, 200 * num_edges);
  EXPECT_EQ(look(3000), 0);  // known
  // A limit ends it early: all that the geometry has to say is known, so that nothing else does.
  limits.stop(StopReason::gap);
  EXPECT_LT(2 * look(2999), looks);
}

TEST(BlockedAgents, HaveNoPlan) {
  int solvable = 0, blocked = 0;
  for (std::uint32_t seed = 0; seed < support::scaled(500); ++seed) {
    const Instance instance = random_pair(6'000'000 + seed);
    LimitMonitor limits({});
    Scene scene(instance, limits);
    const bool is_blocked = !check_feasibility(scene).blocked.empty();
    const bool is_solvable = !known_plans(instance, 4).empty();
    ASSERT_FALSE(is_blocked && is_solvable)
        << "seed " << 6'000'000 + seed << ": " << describe(instance);
    solvable += is_solvable ? 1 : 0;
    blocked += is_blocked ? 1 : 0;
  }
  // Measured: 388 and 64 of 500.
  EXPECT_GT(5 * solvable, 2 * (solvable + blocked));
  EXPECT_GT(blocked, 0);
}

}  // namespace
}  // namespace quadrille::continuous::test
