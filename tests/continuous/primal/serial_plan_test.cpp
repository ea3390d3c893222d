// SPDX-License-Identifier: MIT
// Plans whose moves are made one after the other: found wherever there is one, by two yardsticks of
// their own; and what is made of such moves is a plan.
#include "primal/serial_plan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numeric>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "continuous/support/few_looks.hpp"
#include "continuous/support/meeting.hpp"
#include "continuous/support/random_instance.hpp"
#include "primal/first_plan.hpp"
#include "primal/road_settling.hpp"
#include "primal/serial_moves.hpp"
#include "primal/serial_search.hpp"
#include "quadrille/continuous/solver.hpp"
#include "quadrille/continuous/verify.hpp"
#include "quadrille/discrete/feasibility.hpp"
#include "quadrille/discrete/primal.hpp"
#include "support/environment.hpp"

namespace quadrille::continuous::test {
namespace {

using quadrille::support::scaled;

constexpr std::int64_t kEffort = 5'000'000;

// ---- instances ----------------------------------------------------------------------------------

enum class Family { trees, grids, jittered, one_way, mixed };

template <class T>
void shuffle(Draw& draw, std::vector<T>& items) {
  for (std::size_t k = items.size(); k > 1; --k)
    std::swap(items[k - 1],
              items[static_cast<std::size_t>(draw.number(0, static_cast<std::int64_t>(k) - 1))]);
}

/// A connected part of a lattice with discs that crowd it. Nothing if starts, goals or ways do not
/// fit.
std::optional<Instance> crowd(Family family, std::uint32_t seed) {
  Draw draw(seed * 5 + static_cast<std::uint32_t>(family));
  const auto width = static_cast<std::size_t>(draw.number(2, 7));
  const auto height = static_cast<std::size_t>(draw.number(2, 7));
  const std::size_t size = width * height;
  const std::int64_t jitter = family == Family::jittered ? draw.number(0, 400)
                              : family == Family::mixed  ? draw.number(0, 200)
                                                         : 0;
  std::vector<Point> points;
  std::vector<std::pair<std::size_t, std::size_t>> lanes;
  for (std::size_t v = 0; v < size; ++v) {
    const std::size_t x = v % width, y = v / width;
    points.push_back({Length(static_cast<std::int64_t>(1000 * x) + draw.number(-jitter, jitter)),
                      Length(static_cast<std::int64_t>(1000 * y) + draw.number(-jitter, jitter))});
    if (x + 1 < width) lanes.emplace_back(v, v + 1);
    if (y + 1 < height) lanes.emplace_back(v, v + width);
  }
  shuffle(draw, lanes);
  std::vector<std::size_t> part(size);
  std::iota(part.begin(), part.end(), std::size_t{0});
  const int kept = family == Family::trees ? 0 : static_cast<int>(draw.number(0, 100));
  const int one_way = family == Family::one_way ? static_cast<int>(draw.number(5, 40)) : 0;
  std::vector<Edge> edges;
  for (const auto& [a, b] : lanes) {
    const bool is_bridge = part[a] != part[b];
    if (!is_bridge && !draw.chance(kept)) continue;
    std::replace(part.begin(), part.end(), std::size_t(part[b]), std::size_t(part[a]));
    const bool there = !draw.chance(one_way), back = !there || !draw.chance(one_way);
    if (there) edges.push_back({VertexId(a), VertexId(b), std::nullopt});
    if (back) edges.push_back({VertexId(b), VertexId(a), std::nullopt});
  }
  const auto roadmap =
      std::make_shared<const Roadmap>(Roadmap::make(points, std::move(edges)).value());
  const std::int64_t radius = family == Family::jittered ? draw.number(200, 450) : 300;
  auto count = static_cast<std::size_t>(
      draw.number(2, std::max<std::int64_t>(2, static_cast<std::int64_t>(size) * 7 / 10)));
  for (int attempt = 0; attempt < 60 && count >= 2; ++attempt) {
    std::vector<std::size_t> starts(size), goals(size);
    std::iota(starts.begin(), starts.end(), std::size_t{0});
    std::iota(goals.begin(), goals.end(), std::size_t{0});
    shuffle(draw, starts);
    shuffle(draw, goals);
    std::vector<Agent> agents;
    for (std::size_t i = 0; i < count; ++i) {
      const bool is_large = family == Family::mixed && draw.chance(50);
      const std::int64_t own = family != Family::mixed ? radius : is_large ? 400 : 200;
      agents.push_back({VertexId(starts[i]), VertexId(goals[i]), Disc{Length(own)},
                        is_large ? Speed(1'500'000) : kUnitSpeed});
    }
    auto instance = Instance::make(roadmap, std::move(agents));
    if (instance) return *std::move(instance);
    if (attempt % 10 == 9) --count;
  }
  return std::nullopt;
}

// ---- the plan of the discrete domain ------------------------------------------------------------

/// The agents' graph, whatever the bodies and directions.
std::optional<discrete::Instance> graph_of(const Instance& instance) {
  std::set<std::pair<VertexId, VertexId>> pairs;
  for (const Edge& edge : instance.roadmap().edges()) pairs.insert(std::minmax(edge.from, edge.to));
  const std::vector<discrete::Graph::Edge> edges(pairs.begin(), pairs.end());
  std::vector<discrete::Agent> agents;
  for (const Agent& agent : instance.agents()) agents.push_back({agent.start, agent.goal()});
  auto made = discrete::Instance::make(
      std::make_shared<const discrete::Graph>(
          discrete::Graph::make(instance.roadmap().num_vertices(), edges).value()),
      std::move(agents));
  if (!made) return std::nullopt;
  return *std::move(made);
}

/// The moves of each timestep one after the other, who follows somebody behind it. Nothing if some
/// rotate, or go the wrong way.
std::optional<std::vector<SerialMove>> serialised(const Instance& instance,
                                                  const discrete::Plan& plan) {
  const auto at = [&](AgentId i, std::size_t t) {
    return plan.paths[i][std::min(t, plan.paths[i].size() - 1)];
  };
  std::size_t end = 0;
  for (const auto& path : plan.paths) end = std::max(end, path.size());
  std::vector<SerialMove> moves;
  for (std::size_t t = 1; t < end; ++t) {
    std::vector<AgentId> waiting;
    for (const AgentId i : instance.agent_ids())
      if (at(i, t) != at(i, t - 1)) waiting.push_back(i);
    while (!waiting.empty()) {
      const auto next = std::find_if(waiting.begin(), waiting.end(), [&](AgentId i) {
        return std::none_of(waiting.begin(), waiting.end(),
                            [&](AgentId j) { return at(j, t - 1) == at(i, t); });
      });
      if (next == waiting.end()) return std::nullopt;
      const auto ways = instance.roadmap().out_edges(at(*next, t - 1));
      const auto way = std::find_if(ways.begin(), ways.end(), [&](EdgeId e) {
        return instance.roadmap().edge(e).to == at(*next, t);
      });
      if (way == ways.end()) return std::nullopt;
      moves.push_back({*next, *way});
      waiting.erase(next);
    }
  }
  return moves;
}

bool has_serialised_plan(StandingBodies& bodies, const Instance& instance) {
  const auto graph = graph_of(instance);
  if (!graph || !discrete::check_feasibility(*graph).feasible) return false;
  for (std::uint32_t seed = 0; seed < 2; ++seed) {
    LimitMonitor limits{Limits{}};
    const auto plan = discrete::find_plan(*graph, limits, seed);
    if (!plan) continue;
    const auto moves = serialised(instance, *plan);
    if (moves && is_serial_plan(bodies, *moves)) return true;
  }
  return false;
}

TEST(SerialPlan, IsFoundWhereTheDiscretePlanCanBeMadeOneMoveAfterTheOther) {
  for (const Family family :
       {Family::trees, Family::grids, Family::jittered, Family::one_way, Family::mixed}) {
    std::size_t with_plan = 0, settled = 0, beyond = 0;
    for (std::uint32_t seed = 0; seed < scaled(50); ++seed) {
      const auto instance = crowd(family, seed);
      if (!instance) continue;
      LimitMonitor limits{Limits{}};
      Scene scene(*instance, limits);
      StandingBodies bodies(scene);
      const auto by_settling = settle_agents(scene);
      const auto by_search = search_serial_plan(scene, kEffort);
      for (const auto& plan : {by_settling, by_search})
        if (plan) {
          ASSERT_TRUE(verify(*instance, *plan).valid());
        }
      bool is_found = by_settling || by_search;
      if (has_serialised_plan(bodies, *instance)) {
        ++with_plan;
        // As a solve goes on.
        is_found = is_found || search_serial_plan(scene, 10 * kEffort);
        ASSERT_TRUE(is_found) << "family " << static_cast<int>(family) << " seed " << seed;
      } else {
        beyond += is_found ? 1 : 0;
      }
      settled += by_settling ? 1 : 0;
    }
    if (scaled(50) < 50) continue;  // a few instances need not have any
    EXPECT_GE(with_plan, 10U) << static_cast<int>(family);
    EXPECT_GE(settled, 10U) << static_cast<int>(family);
    if (family == Family::one_way) {
      EXPECT_GE(beyond, 10U);
    }
  }
}

// ---- all arrangements ---------------------------------------------------------------------------

/// By breadth-first search, with an exact predicate of its own: whether moves made one after the
/// other lead everybody home. Nobody leaves, nothing else moves.
bool has_serial_plan(const Instance& instance) {
  using Arrangement = std::vector<std::size_t>;
  Arrangement start, goal;
  for (const Agent& agent : instance.agents()) {
    start.push_back(agent.start.index());
    goal.push_back(agent.goal().index());
  }
  const auto is_clear = [&](const Arrangement& places, AgentId i, EdgeId e) {
    const geometry::Motion motion = instance.motion(instance.class_of(i), e);
    const Element move{motion.from, motion.to, 0, motion.duration};
    for (const AgentId j : instance.agent_ids()) {
      if (j == i) continue;
      if (places[j.index()] == instance.roadmap().edge(e).to.index()) return false;
      const Point& place = instance.roadmap().position(VertexId(places[j.index()]));
      const Element stay{place, place, 0, motion.duration};
      const Roadmap& roadmap = instance.roadmap();
      if (meet(move, instance.agent(i).body_as(roadmap.edge(e).shape), stay,
               instance.agent(j).body_as(roadmap.shape(VertexId(places[j.index()])))))
        return false;
    }
    return true;
  };
  std::set<Arrangement> seen{start};
  std::vector<Arrangement> queue{start};
  for (std::size_t head = 0; head < queue.size(); ++head) {
    const Arrangement places = queue[head];
    if (places == goal) return true;
    for (const AgentId i : instance.agent_ids())
      for (const EdgeId e : instance.roadmap().out_edges(VertexId(places[i.index()]))) {
        if (!is_open(instance, i, e) || !is_clear(places, i, e)) continue;
        Arrangement next = places;
        next[i.index()] = instance.roadmap().edge(e).to.index();
        if (seen.insert(next).second) queue.push_back(std::move(next));
      }
  }
  return false;
}

RandomOptions small(std::uint32_t seed) {
  RandomOptions options;
  options.num_vertices = 4 + seed % 4;
  options.num_agents = 2 + seed % 3;
  options.one_way_percent = seed % 2 == 0 ? 10 : 50;
  options.deadline_percent = options.leaves_percent = options.obstacles_percent = 0;
  options.no_waiting_percent = 0;  // between moves there are pauses
  return options;
}

TEST(SerialSearch, FindsAPlanExactlyWhereThereIsOne) {
  std::size_t with_plan = 0, without = 0, settled = 0;
  for (std::uint32_t seed = 0; seed < scaled(1500); ++seed) {
    const Instance instance = random_instance(seed, small(seed));
    SCOPED_TRACE("seed " + std::to_string(seed) + ": " + describe(instance));
    LimitMonitor limits{Limits{}};
    Scene scene(instance, limits);
    StandingBodies bodies(scene);
    if (!Standing(bodies).are_apart()) continue;  // polygons beside their places
    SerialSearch search(bodies);
    const auto state = search.advance(INT64_MAX / 2);
    ASSERT_NE(state, SerialSearch::State::working);
    const bool is_found = state == SerialSearch::State::found;
    ASSERT_EQ(is_found, has_serial_plan(instance));
    ++(is_found ? with_plan : without);
    const auto by_settling = settle_agents(scene);
    if (!is_found) {
      ASSERT_FALSE(by_settling.has_value());
      continue;
    }
    settled += by_settling ? 1 : 0;
    ASSERT_TRUE(is_serial_plan(bodies, search.moves()));
    // Without verify's help: what is made of the moves is a plan, as it is and shortened.
    ASSERT_TRUE(verify(instance, earliest_plan(bodies, search.moves())).valid());
    const auto shorter = without_loops(bodies, search.moves(), kEffort);
    ASSERT_TRUE(is_serial_plan(bodies, shorter));
    ASSERT_TRUE(verify(instance, earliest_plan(bodies, shorter)).valid());
  }
  EXPECT_GE(with_plan, scaled(300));
  EXPECT_GE(without, scaled(100));
  EXPECT_GE(settled, scaled(50));
}

// ---- what is made of the moves ------------------------------------------------------------------

TEST(SerialMoves, AnyWalkBecomesAPlanAndLosesItsLoops) {
  std::size_t with_loops = 0;
  for (std::uint32_t seed = 0; seed < scaled(400); ++seed) {
    RandomOptions options = small(seed);
    options.num_vertices = 8;
    const Instance drawn = random_instance(seed, options);
    // As everybody happens to walk; where that ends are the goals.
    LimitMonitor limits{Limits{}};
    Scene scene(drawn, limits);
    StandingBodies bodies(scene);
    Standing standing(bodies);
    if (!standing.are_apart()) continue;
    Draw draw(seed);
    std::vector<SerialMove> moves;
    std::int64_t effort = 0;
    for (int k = 0; k < 60; ++k) {
      const AgentId i(static_cast<std::size_t>(
          draw.number(0, static_cast<std::int64_t>(drawn.num_agents()) - 1)));
      const auto ways = drawn.out_edges(drawn.class_of(i), standing.vertex_of(i));
      if (ways.empty()) continue;
      const SerialMove move{i,
                            ways[static_cast<std::size_t>(draw.number(0, std::ssize(ways) - 1))]};
      if (!standing.can_move(move, effort)) continue;
      standing.move(move);
      moves.push_back(move);
    }
    std::vector<Agent> agents(drawn.agents().begin(), drawn.agents().end());
    for (const AgentId i : drawn.agent_ids()) agents[i.index()].goals = standing.vertex_of(i);
    const auto instance = Instance::make(drawn.shared_roadmap(), std::move(agents));
    if (!instance) continue;
    Scene own_scene(*instance, limits);
    StandingBodies own_bodies(own_scene);
    SCOPED_TRACE("seed " + std::to_string(seed) + ": " + describe(*instance));
    ASSERT_TRUE(is_serial_plan(own_bodies, moves));
    const Plan plan = earliest_plan(own_bodies, moves);
    ASSERT_TRUE(verify(*instance, plan).valid()) << verify(*instance, plan).violations[0].message;
    const auto shorter = without_loops(own_bodies, moves, kEffort);
    ASSERT_TRUE(is_serial_plan(own_bodies, shorter));
    ASSERT_LE(shorter.size(), moves.size());
    with_loops += shorter.size() < moves.size() ? 1 : 0;
    ASSERT_EQ(without_loops(own_bodies, shorter, kEffort), shorter);
    ASSERT_TRUE(verify(*instance, earliest_plan(own_bodies, shorter)).valid());
  }
  EXPECT_GE(with_loops, scaled(100));
}

/// Two robots on roads that do not meet move at the same time; a third one follows the first.
TEST(SerialMoves, BeginAsEarlyAsTheOrderAllows) {
  std::vector<Point> points{{0, 0}, {1000, 0}, {2000, 0}, {0, 9000}, {1000, 9000}};
  const auto edge = [](std::size_t a, std::size_t b) {
    return Edge{VertexId(a), VertexId(b), std::nullopt};
  };
  const auto roadmap = std::make_shared<const Roadmap>(
      Roadmap::make(points, {edge(0, 1), edge(1, 2), edge(3, 4)}).value());
  const auto agent = [](std::size_t a, std::size_t b) {
    return Agent{VertexId(a), VertexId(b), Disc{300}};
  };
  const Instance instance =
      Instance::make(roadmap, {agent(1, 2), agent(3, 4), agent(0, 1)}).value();
  LimitMonitor limits{Limits{}};
  Scene scene(instance, limits);
  StandingBodies bodies(scene);
  const std::vector<SerialMove> moves{
      {AgentId(0), EdgeId(1)}, {AgentId(1), EdgeId(2)}, {AgentId(2), EdgeId(0)}};
  const Plan plan = earliest_plan(bodies, moves);
  for (const AgentId i : instance.agent_ids()) EXPECT_EQ(cost(plan.paths[i]), 1000);
}

// ---- rules of fleets ----------------------------------------------------------------------------

TEST(SerialPlan, KeepsAllRulesOfFleets) {
  std::size_t found = 0, with_obstacles = 0, under_way = 0, leaving = 0, released = 0;
  for (std::uint32_t seed = 0; seed < scaled(1200); ++seed) {
    RandomOptions options;
    options.num_vertices = 6 + seed % 3;
    options.num_agents = 2 + seed % 3;
    options.release_percent = options.leaves_percent = 40;
    options.obstacles_percent = options.under_way_percent = 30;
    options.no_waiting_percent = 0;
    const Instance instance = random_instance(seed, options);
    SCOPED_TRACE("seed " + std::to_string(seed) + ": " + describe(instance));
    LimitMonitor limits{Limits{}};
    Scene scene(instance, limits);
    for (const auto& plan : {settle_agents(scene), search_serial_plan(scene, 1'000'000)}) {
      if (!plan) continue;
      ASSERT_TRUE(verify(instance, *plan).valid());
      ++found;
      const auto& agents = instance.agents();
      const auto has = [&](auto test) { return std::any_of(agents.begin(), agents.end(), test); };
      with_obstacles += instance.obstacles().empty() ? 0 : 1;
      under_way += has([](const Agent& agent) { return agent.under_way; }) ? 1 : 0;
      leaving += has([](const Agent& agent) { return agent.leaves; }) ? 1 : 0;
      released += has([](const Agent& agent) { return agent.release > 0; }) ? 1 : 0;
    }
  }
  EXPECT_GE(found, scaled(300));
  for (const std::size_t count : {with_obstacles, under_way, leaving, released})
    EXPECT_GE(count, scaled(20));
}

// ---- as a part of a solve -----------------------------------------------------------------------

/// A street with a house on either side of each vertex, and as many robots as half of the places.
Instance caterpillar(std::size_t length, std::uint32_t seed) {
  std::vector<Point> points;
  std::vector<Edge> edges;
  const auto connect = [&](std::size_t a, std::size_t b) {
    edges.push_back({VertexId(a), VertexId(b), std::nullopt});
    edges.push_back({VertexId(b), VertexId(a), std::nullopt});
  };
  for (std::size_t k = 0; k < length; ++k) {
    const Length x(static_cast<std::int64_t>(2000 * k));
    for (const Length y : {Length(0), Length(2000), Length(-2000)}) points.push_back({x, y});
    connect(3 * k, 3 * k + 1);
    connect(3 * k, 3 * k + 2);
    if (k > 0) connect(3 * k - 3, 3 * k);
  }
  Draw draw(seed);
  std::vector<std::size_t> starts(points.size()), goals(points.size());
  std::iota(starts.begin(), starts.end(), std::size_t{0});
  goals = starts;
  shuffle(draw, starts);
  shuffle(draw, goals);
  std::vector<Agent> agents;
  for (std::size_t i = 0; 2 * i < points.size(); ++i)
    agents.push_back({VertexId(starts[i]), VertexId(goals[i]), Disc{300}});
  return Instance::make(std::make_shared<const Roadmap>(
                            Roadmap::make(std::move(points), std::move(edges)).value()),
                        std::move(agents))
      .value();
}

TEST(SerialPlan, IsTheFirstPlanOfACrowdedTree) {
  int num_hard = 0;
  for (std::uint32_t seed = 0; seed < 10; ++seed) {
    const Instance instance = caterpillar(10, seed);
    LimitMonitor limits{Limits{}};
    Scene scene(instance, limits);
    const bool is_hard = !find_first_plan(scene);
    num_hard += is_hard ? 1 : 0;
    SolveOptions options;
    options.gap_percent = 1e9;
    const SolveOutcome outcome = solve(instance, options).value();
    ASSERT_EQ(outcome.status, Status::feasible);
    const std::string& source = outcome.statistics.first_plan;
    EXPECT_EQ(source == "serial-search" || source == "settling", is_hard) << source;
  }
  EXPECT_GE(num_hard, 5);
  const Instance wide = caterpillar(40, 1);
  LimitMonitor limits{Limits{}};
  Scene scene(wide, limits);
  EXPECT_TRUE(settle_agents(scene).has_value());
}

TEST(SerialPlan, StopsAtEachLookAtTheLimits) {
  const Instance instance = caterpillar(5, 3);
  std::size_t cut = 0;
  at_each_look(instance, 400, 7, [&](Scene& scene, LimitMonitor&) {
    for (const auto& plan : {settle_agents(scene), search_serial_plan(scene, kEffort)}) {
      if (plan) {
        ASSERT_TRUE(verify(instance, *plan).valid());
      }
      cut += plan ? 0 : 1;
    }
  });
  EXPECT_GE(cut, std::size_t{10});
}

TEST(SerialPlan, IsTheSameEachTime) {
  const Instance instance = caterpillar(8, 2);
  LimitMonitor limits{Limits{}};
  Scene scene(instance, limits), other(instance, limits);
  EXPECT_EQ(settle_agents(scene), settle_agents(other));
  EXPECT_EQ(search_serial_plan(scene, kEffort), search_serial_plan(other, kEffort));
}

TEST(FirstPlan, IsToldWhereItComesFrom) {
  SolveOptions options;
  options.gap_percent = 1e9;
  options.joint_work = options.route_work = 0;
  const Instance easy = crowd(Family::grids, 1).value();
  const auto told = [&](const Instance& instance) {
    return solve(instance, options).value().statistics.first_plan;
  };
  const Instance tree = caterpillar(10, 0);
  const std::string source = told(tree);
  EXPECT_NE(source, "");
  options.initial_plan = solve(tree, options).value().plan;
  EXPECT_EQ(told(tree), "given");
  options.initial_plan.reset();
  options.limits.looks = 1;
  EXPECT_EQ(told(tree), "") << "there is none";
}

}  // namespace
}  // namespace quadrille::continuous::test
