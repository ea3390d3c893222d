// SPDX-License-Identifier: MIT
// Settling finds a plan exactly where the test in linear time says that there is one.
#include "settle/settle.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "discrete/primal/primal_support.hpp"
#include "primal/time_windows.hpp"
#include "quadrille/discrete/feasibility.hpp"
#include "quadrille/discrete/verify.hpp"
#include "quadrille/pebbles/exchange.hpp"
#include "quadrille/pebbles/shorten.hpp"
#include "settle/local_graph.hpp"
#include "settle/shift_paths.hpp"
#include "support/environment.hpp"
#include "support/joint_search.hpp"

namespace quadrille::discrete::primal_test {
namespace {

using pebbles::Board;
using pebbles::earliest_times;
using pebbles::Exchanger;
using pebbles::LocalGraph;
using pebbles::Shift;
using pebbles::without_loops;
using quadrille::support::nightly;
using quadrille::support::scaled;
using support::instance_text;
using support::replay;

/// The plan; nullopt: given up.
std::optional<Plan> settled(const Instance& instance, std::int64_t slice = kNoEnd) {
  LimitMonitor limits{Limits{}};
  Settling settling(instance);
  while (settling.state() == Settling::State::working) settling.advance(slice, limits);
  if (settling.state() != Settling::State::found) return std::nullopt;
  return settling.plan(limits);
}

/// Empty if there is a plan exactly if there has to be one.
std::string fault_of(const Instance& instance) {
  const bool feasible = check_feasibility(instance).feasible;
  const auto plan = settled(instance);
  if (plan.has_value() != feasible) return feasible ? "no plan was found" : "there is no plan";
  if (!plan) return "";
  const auto report = verify(instance, *plan);
  return report.valid() ? replay(instance, *plan) : report.violations.front().message;
}

/// All tasks on a graph but for the agents' names; every `step`-th of them. How many are feasible.
std::size_t try_all_tasks(const std::shared_ptr<const Graph>& graph, std::size_t num_agents,
                          std::size_t step) {
  const auto ends = support::arrangements(graph->num_vertices(), num_agents);
  std::size_t count = 0, feasible = 0;
  for (const auto& starts : ends) {
    if (!std::is_sorted(starts.begin(), starts.end())) continue;
    for (const auto& goals : ends) {
      if (++count % step != 0) continue;
      std::vector<Agent> agents;
      for (std::size_t i = 0; i < num_agents; ++i)
        agents.push_back({VertexId(starts[i]), VertexId(goals[i])});
      const Instance instance = Instance::make(graph, std::move(agents)).value();
      const std::string fault = fault_of(instance);
      EXPECT_EQ(fault, "") << instance_text(instance);
      if (!fault.empty()) return feasible;
      feasible += check_feasibility(instance).feasible ? 1 : 0;
    }
  }
  return feasible;
}

TEST(Settling, AllConnectedGraphsOfUpToSixVertices) {
  std::size_t feasible = 0;
  for (std::size_t n = 2; n <= 6; ++n)
    for (Graph& graph : support::connected_graphs(n)) {
      const auto shared = std::make_shared<const Graph>(std::move(graph));
      for (std::size_t agents = 1; agents <= n && !HasFailure(); ++agents)
        feasible += try_all_tasks(shared, agents, n < 6 || nightly() ? 1 : 97);
    }
  EXPECT_GE(feasible, std::size_t{28'000});
}

TEST(Settling, RandomGraphsAndCrowdedGrids) {
  support::Random random(11);
  std::size_t feasible = 0;
  for (std::size_t round = 0; round < scaled(3000); ++round) {
    const Instance instance = round % 2 == 0 ? support::random_graph(random, 24, 24)
                                             : support::random_grid(random, {2, 9, 50, 2, 81});
    ASSERT_EQ(fault_of(instance), "") << instance_text(instance);
    feasible += check_feasibility(instance).feasible ? 1 : 0;
  }
  EXPECT_GE(feasible, scaled(1000));
}

/// A cycle with a pendant vertex or a branch somewhere: agents have to be led far to be exchanged.
TEST(Settling, LongCyclesWithOneWayOut) {
  support::Random random(5);
  for (std::size_t round = 0; round < scaled(60); ++round) {
    const std::size_t length = 3 + random.below(30), tail = 1 + random.below(4);
    std::vector<Graph::Edge> edges;
    for (std::size_t v = 0; v < length; ++v)
      edges.emplace_back(VertexId(v), VertexId((v + 1) % length));
    for (std::size_t k = 0; k < tail; ++k)
      edges.emplace_back(VertexId(k == 0 ? 0 : length + k - 1), VertexId(length + k));
    const std::size_t size = length + tail;
    const Instance instance =
        support::random_tasks(random, Graph::make(size, edges).value(),
                              size - std::min<std::size_t>(size, random.below(3)));
    ASSERT_EQ(fault_of(instance), "") << instance_text(instance);
  }
}

/// Two triangles, squares, ... that share a vertex, and the like: blocks of which no two cycles
/// share an edge, and none is free.
TEST(Settling, FullCacti) {
  support::Random random(7);
  for (std::size_t round = 0; round < scaled(200); ++round) {
    std::vector<Graph::Edge> edges;
    std::size_t size = 1;
    for (std::size_t k = 1 + random.below(4); k > 0; --k) {
      const std::size_t hub = random.below(size), length = 3 + random.below(3);
      for (std::size_t v = 0; v < length; ++v)
        edges.emplace_back(VertexId(v == 0 ? hub : size + v - 1),
                           VertexId(v + 1 == length ? hub : size + v));
      size += length - 1;
    }
    const Instance instance = support::random_tasks(random, Graph::make(size, edges).value(), size);
    ASSERT_EQ(fault_of(instance), "") << instance_text(instance);
  }
}

TEST(Settling, BoardsWithFewFreeCells) {
  for (std::size_t free = 0; free <= 10; ++free)
    EXPECT_EQ(fault_of(crowd(12, 144 - free, 3 + free)), "") << free << " free cells";
}

TEST(Settling, TheSamePlanInSlicesOfAnySize) {
  const Instance instance = crowd(8, 60, 1);
  const auto whole = settled(instance);
  ASSERT_TRUE(whole.has_value());
  EXPECT_EQ(settled(instance, 1), whole);
  EXPECT_EQ(settled(instance, 100), whole);
}

TEST(Settling, StopsAtEachLookAtTheLimits) {
  const Instance instance = crowd(5, 25, 1), roomy = crowd(5, 22, 2);
  for (const Instance* board : {&instance, &roomy})
    for (std::int64_t looks = 1; looks < 60; ++looks) {
      Limits few;
      few.looks = looks;
      LimitMonitor limits(few);
      Settling settling(*board);
      const auto state = settling.advance(kNoEnd, limits);
      if (state == Settling::State::found) continue;
      ASSERT_EQ(state, Settling::State::working) << "given up when a limit was met";
      // It goes on where it was.
      LimitMonitor none{Limits{}};
      ASSERT_EQ(settling.advance(kNoEnd, none), Settling::State::found) << looks;
      ASSERT_EQ(replay(*board, settling.plan(none).value()), "");
    }
}

TEST(Settling, NoPlanBeyondTheLimitOfMemory) {
  const Instance instance = crowd(12, 140, 1);
  LimitMonitor limits{Limits{}};
  Settling settling(instance);
  ASSERT_EQ(settling.advance(kNoEnd, limits), Settling::State::found);
  Limits none;
  none.memory_mib = 0;
  LimitMonitor tight(none);
  EXPECT_EQ(settling.plan(tight), std::nullopt);
  EXPECT_EQ(tight.reason(), StopReason::memory);
}

TEST(Exchanger, PutsEverybodyElseBack) {
  support::Random random(3);
  std::size_t exchanged = 0;
  for (std::size_t round = 0; round < scaled(400); ++round) {
    const Instance instance = support::random_graph(random, 14, 12);
    ComponentNumbering numbering(instance.graph());
    const Component component = numbering.explore(instance.agents()[AgentId(0)].start);
    const LocalGraph graph = local_graph(component, numbering);
    if (component.degree(0) < 3) continue;
    std::vector<Local> starts;
    for (const Agent& agent : instance.agents())
      if (numbering.component_of(agent.start) == 0) starts.push_back(numbering.number(agent.start));
    if (starts.size() < 2 || starts.size() == graph.size()) continue;
    Board board(graph.size(), starts);
    Exchanger exchanger(graph, board);
    for (Local a = 0; a < starts.size(); ++a)
      for (const Local w : graph.neighbours(starts[a])) {
        const Local b = board.agent_at(w);
        if (b == kNoLocal || b < a || board.vertex_of(a) != starts[a] || w != starts[b]) continue;
        const bool done = exchanger.exchange(a, b);
        if (done) std::swap(starts[a], starts[b]);
        exchanged += done ? 1 : 0;
        for (Local c = 0; c < starts.size(); ++c)
          ASSERT_EQ(board.vertex_of(c), starts[c]) << (done ? "" : "not ") << "exchanged";
      }
  }
  EXPECT_GE(exchanged, scaled(200));
}

TEST(Shorten, LeavesOutWhatNobodyWasInTheWayOf) {
  // Agent 0 goes to 1 and back to 0, then to 2; agent 1 passes 3 twice, but 0 was there meanwhile.
  const std::vector<Shift> shifts{{0, 0, 1}, {0, 1, 0}, {1, 3, 4}, {0, 0, 3}, {0, 3, 0}, {1, 4, 3}};
  const std::vector<Local> starts{0, 3};
  const auto shorter = without_loops(shifts, starts, 5, 5);
  ASSERT_EQ(shorter.size(), std::size_t{0}) << "the visit of agent 0 is a loop, then that of 1 too";
  EXPECT_EQ(without_loops(shifts, starts, 5, 1).size(), std::size_t{0});
  const std::vector<Shift> needed{{1, 3, 4}, {0, 0, 3}, {0, 3, 2}, {1, 4, 3}};
  EXPECT_EQ(without_loops(needed, starts, 5, 5).size(), needed.size());
}

TEST(Shorten, AsEarlyAsTheOrderAtEachVertexAllows) {
  // 1 makes room for 0, which follows at the same time; 2 goes where 0 was; a rotation of 3 and 4
  // would wait for both.
  const std::vector<Shift> shifts{{1, 1, 2}, {0, 0, 1}, {2, 3, 0}, {2, 0, 3}};
  EXPECT_EQ(earliest_times(shifts, 3, 4), (std::vector<Timestep>{1, 1, 1, 2}));
  const std::vector<Shift> turned{
      {0, 0, 5}, {0, 5, 0}, {0, 0, 1, true}, {1, 1, 2, true}, {2, 2, 0, false}};
  EXPECT_EQ(earliest_times(turned, 3, 6), (std::vector<Timestep>{1, 2, 3, 3, 3}));
}

TEST(Shorten, TightenedPlansAreNeverDearer) {
  support::Random random(9);
  std::size_t num_cheaper = 0;
  for (std::size_t round = 0; round < scaled(300); ++round) {
    const Instance instance = support::random_grid(random, {2, 6, 30, 2, 30});
    const auto plan = settled(instance);
    if (!plan) continue;
    // Slower: everybody stays for a timestep after each move, now and then.
    Plan slow;
    slow.paths.resize(plan->paths.size());
    const Cost makespan = plan->cost(Objective::makespan);
    for (Timestep t = 0; t <= makespan; ++t) {
      const std::uint64_t times = 1 + random.below(2);
      for (std::uint64_t k = 0; k < times; ++k)
        for (const AgentId i : instance.agent_ids())
          slow.paths[i].push_back(position(plan->paths[i], t));
    }
    trim(slow);
    LimitMonitor limits{Limits{}};
    const Plan tight = tightened(instance, slow, limits).value();
    ASSERT_EQ(replay(instance, tight), "") << instance_text(instance);
    ASSERT_LE(tight.cost(Objective::sum_of_costs), plan->cost(Objective::sum_of_costs));
    ASSERT_LE(tight.cost(Objective::makespan), plan->cost(Objective::makespan));
    num_cheaper += tight.cost(Objective::sum_of_costs) < slow.cost(Objective::sum_of_costs) ? 1 : 0;
  }
  EXPECT_GE(num_cheaper, scaled(50));
  Limits none;
  none.memory_mib = 0;
  LimitMonitor limits(none);
  const Instance instance = crowd(12, 130, 1);
  EXPECT_EQ(tightened(instance, settled(instance).value(), limits), std::nullopt);
}

TEST(Board, ATimestepIsMadeByShifts) {
  // A row of three into a free vertex, a rotation of four, and one who stays.
  const std::vector<Local> starts{0, 1, 2, 4, 5, 6, 7, 8}, to{1, 2, 3, 5, 6, 7, 4, 8};
  Board board(9, starts);
  board.step(to);
  for (Local agent = 0; agent < to.size(); ++agent) EXPECT_EQ(board.vertex_of(agent), to[agent]);
  EXPECT_EQ(board.shifts().size(), 7U);
  EXPECT_EQ(earliest_times(board.shifts(), 8, 9), (std::vector<Timestep>(7, 1)));
  EXPECT_TRUE(board.is_free(0));
}

TEST(TimeWindows, MakeALongPlanShorterAndKeepItValid) {
  std::size_t num_cheaper = 0;
  for (std::uint64_t seed = 0; seed < scaled(8); ++seed) {
    const Instance instance = crowd(10, 80 + seed % 20, seed);
    const Plan plan = settled(instance).value();
    const auto shortened = [&](std::int64_t slice) {
      LimitMonitor limits{Limits{}};
      TimeWindows windows(instance, plan, 0);
      Cost before = plan.cost(Objective::sum_of_costs);
      while (!windows.is_over()) {
        windows.advance(slice, limits);
        EXPECT_EQ(replay(instance, windows.plan()), "");
        EXPECT_EQ(windows.plan().cost(Objective::sum_of_costs), windows.cost());
        EXPECT_LE(windows.cost(), before);
        before = windows.cost();
      }
      return windows.plan();
    };
    const Plan shorter = shortened(20'000);
    num_cheaper +=
        shorter.cost(Objective::sum_of_costs) < plan.cost(Objective::sum_of_costs) ? 1U : 0U;
    EXPECT_EQ(shorter, shortened(200'000));
  }
  // Open boards leave little to gain.
  EXPECT_GE(num_cheaper, 1U);
}

TEST(TimeWindows, LeaveAPlanWithoutMovesAlone) {
  const Instance instance = crowd(3, 0, 1);
  const Plan plan = settled(instance).value();
  TimeWindows windows(instance, plan, 0);
  EXPECT_TRUE(windows.is_over());
  EXPECT_EQ(windows.plan(), plan);
}

TEST(TimeWindows, StopAtEachLookAtTheLimits) {
  const Instance instance = crowd(7, 45, 3);
  const Plan plan = settled(instance).value();
  for (std::int64_t looks = 1; looks < 40; ++looks) {
    Limits few;
    few.looks = looks;
    LimitMonitor limits(few);
    TimeWindows windows(instance, plan, 0);
    windows.advance(kNoEnd, limits);
    ASSERT_EQ(replay(instance, windows.plan()), "") << looks;
    ASSERT_LE(windows.cost(), plan.cost(Objective::sum_of_costs)) << looks;
    LimitMonitor none{Limits{}};
    windows.advance(kNoEnd, none);
    ASSERT_TRUE(windows.is_over()) << looks;
  }
}

}  // namespace
}  // namespace quadrille::discrete::primal_test
