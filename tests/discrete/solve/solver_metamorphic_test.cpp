// SPDX-License-Identifier: MIT
// Instances beyond the joint search: what must hold between the answers to related instances.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <string>

#include "support/case_text.hpp"
#include "support/environment.hpp"
#include "support/solver_cases.hpp"

namespace quadrille::discrete::support {
namespace {

using quadrille::support::scaled;

constexpr Objective kObjectives[] = {Objective::sum_of_costs, Objective::makespan};

/// Status and cost of a completed search; -1 for infeasible.
Cost solve_checked(const Instance& instance, const TunedOptions& options) {
  const SolveOutcome outcome = solve(instance, options).value();
  EXPECT_NE(outcome.status, Status::unknown) << outcome.explanation << "\n"
                                             << instance_text(instance) << options_text(options);
  EXPECT_EQ(find_inconsistency(instance, options, outcome), "")
      << instance_text(instance) << options_text(options);
  return outcome.cost.value_or(-1);
}

/// A random instance, the cost of its optimum and random systems to solve its variants with.
struct Base {
  Instance instance;
  Random random;
  Objective objective;
  Cost cost;

  [[nodiscard]] Cost solve_variant(const Instance& variant) {
    return solve_checked(variant, random.pick(random_systems_without_plan()));
  }
  [[nodiscard]] std::vector<TunedOptions> random_systems_without_plan() {
    std::vector<TunedOptions> systems = random_systems(random, objective);
    for (TunedOptions& options : systems) {
      options.debug.known_plan.reset();
      options.initial_plan.reset();
    }
    return systems;
  }
};

Base make_base(std::uint64_t seed, Objective objective, std::size_t max_agents = 10) {
  Random random(seed);
  Instance instance = random_grid(random, {6, 8, 20, 6, max_agents});
  const Cost cost = solve_checked(instance, all_systems(objective)[0]);
  return {std::move(instance), random, objective, cost};
}

void for_each_base(std::size_t cases, std::uint64_t first_seed,
                   const std::function<void(Base&)>& check) {
  for (const Objective objective : kObjectives)
    for (std::uint64_t number = 0; number < scaled(cases); ++number) {
      Base base = make_base(first_seed + number, objective);
      SCOPED_TRACE("seed " + std::to_string(first_seed + number) + ", " +
                   std::string(to_string(objective)) + "\n" + instance_text(base.instance));
      check(base);
      if (testing::Test::HasFailure()) return;
    }
}

/// The instance on another map: `place` says where each cell goes; all others are blocked.
Instance moved(const Instance& instance, std::int32_t width, std::int32_t height,
               const std::function<Cell(Cell)>& place) {
  const GridLayout& layout = *instance.graph().layout();
  std::vector<bool> passable(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (const VertexId v : IdRange<VertexId>(layout.num_vertices())) {
    const Cell to = place(layout.cell_of(v));
    passable[static_cast<std::size_t>(to.y * width + to.x)] = true;
  }
  Graph graph = Graph::grid(width, height, passable);
  std::vector<Agent> tasks;
  for (const Agent& task : instance.agents())
    tasks.push_back({*graph.layout()->vertex_at(place(layout.cell_of(task.start))),
                     *graph.layout()->vertex_at(place(layout.cell_of(task.goal())))});
  return Instance::make(std::move(graph), std::move(tasks)).value();
}

TEST(SolverMetamorphic, MirroredAndRotatedMapsCostTheSame) {
  for_each_base(15, 10'000, [](Base& base) {
    const std::int32_t w = base.instance.graph().layout()->width();
    const std::int32_t h = base.instance.graph().layout()->height();
    const auto mirror = [w](Cell c) { return Cell{w - 1 - c.x, c.y}; };
    const auto turn = [h](Cell c) { return Cell{h - 1 - c.y, c.x}; };
    EXPECT_EQ(base.solve_variant(moved(base.instance, w, h, mirror)), base.cost);
    EXPECT_EQ(base.solve_variant(moved(base.instance, h, w, turn)), base.cost);
  });
}

TEST(SolverMetamorphic, TheOrderOfAgentsDoesNotMatter) {
  for_each_base(15, 20'000, [](Base& base) {
    std::vector<Agent> tasks = base.instance.agents().items();
    base.random.shuffle(tasks);
    const Instance variant = Instance::make(base.instance.shared_graph(), tasks).value();
    EXPECT_EQ(base.solve_variant(variant), base.cost);
  });
}

TEST(SolverMetamorphic, TheNumbersOfVerticesDoNotMatter) {
  for_each_base(15, 30'000, [](Base& base) {
    const Graph& graph = base.instance.graph();
    std::vector<VertexId> name;
    for (const VertexId v : IdRange<VertexId>(graph.num_vertices())) name.push_back(v);
    base.random.shuffle(name);
    std::vector<Graph::Edge> edges;
    for (const VertexId v : IdRange<VertexId>(graph.num_vertices()))
      for (const VertexId w : graph.neighbours(v))
        if (v < w) edges.emplace_back(name[v.index()], name[w.index()]);
    std::vector<Agent> tasks;
    for (const Agent& task : base.instance.agents())
      tasks.push_back({name[task.start.index()], name[task.goal().index()]});
    const Graph renamed = Graph::make(graph.num_vertices(), edges).value();
    EXPECT_EQ(base.solve_variant(Instance::make(renamed, tasks).value()), base.cost);
  });
}

TEST(SolverMetamorphic, AnUnreachableCellChangesNothing) {
  for_each_base(15, 40'000, [](Base& base) {
    const std::int32_t w = base.instance.graph().layout()->width();
    const std::int32_t h = base.instance.graph().layout()->height();
    // Two more rows below: a wall and, in it or under it, one free cell.
    const Instance shifted = moved(base.instance, w, h + 2, [](Cell c) {
      return Cell{c.x, c.y + 2};
    });
    const GridLayout& layout = *shifted.graph().layout();
    std::vector<bool> passable;
    for (std::int32_t y = 0; y < h + 2; ++y)
      for (std::int32_t x = 0; x < w; ++x)
        passable.push_back((x == 0 && y == 0) || layout.vertex_at({x, y}).has_value());
    const Graph graph = Graph::grid(w, h + 2, passable);
    std::vector<Agent> tasks;
    for (const Agent& task : shifted.agents())
      tasks.push_back({VertexId(task.start.index() + 1), VertexId(task.goal().index() + 1)});
    EXPECT_EQ(base.solve_variant(Instance::make(graph, tasks).value()), base.cost);
  });
}

TEST(SolverMetamorphic, RemovingAnAgentNeverRaisesTheCost) {
  for_each_base(15, 50'000, [](Base& base) {
    const AgentId gone(base.random.below(base.instance.num_agents()));
    const Cost cost = base.solve_variant(without_agent(base.instance, gone));
    if (base.cost < 0) return;  // infeasible may become anything
    ASSERT_GE(cost, 0);
    const Agent& task = base.instance.agents()[gone];
    const Cost alone = distances_from(base.instance.graph(), task.goal())[task.start];
    const bool sum = base.objective == Objective::sum_of_costs;
    EXPECT_GE(base.cost, sum ? cost + alone : std::max(cost, alone));
  });
}

TEST(SolverMetamorphic, OpeningACellNeverRaisesTheCost) {
  for_each_base(15, 60'000, [](Base& base) {
    const GridLayout& layout = *base.instance.graph().layout();
    std::vector<bool> passable;
    std::vector<std::size_t> blocked;
    for (std::int32_t y = 0; y < layout.height(); ++y)
      for (std::int32_t x = 0; x < layout.width(); ++x) {
        passable.push_back(layout.vertex_at({x, y}).has_value());
        if (!passable.back()) blocked.push_back(passable.size() - 1);
      }
    if (blocked.empty()) return;
    passable[base.random.pick(blocked)] = true;
    const Graph graph = Graph::grid(layout.width(), layout.height(), passable);
    std::vector<Agent> tasks;
    for (const Agent& task : base.instance.agents())
      tasks.push_back({*graph.layout()->vertex_at(layout.cell_of(task.start)),
                       *graph.layout()->vertex_at(layout.cell_of(task.goal()))});
    const Cost cost = base.solve_variant(Instance::make(graph, tasks).value());
    if (base.cost >= 0) {
      ASSERT_GE(cost, 0);
      EXPECT_LE(cost, base.cost);
    }
  });
}

// A plan read backwards takes every agent from its goal to its start in the same time and without a
// collision. Its sum of costs may differ: waiting is free at the end of a path only.
TEST(SolverMetamorphic, TheWayBackHasTheSameMakespan) {
  for (std::uint64_t seed = 70'000; seed < 70'000 + scaled(30); ++seed) {
    Base base = make_base(seed, Objective::makespan);
    std::vector<Agent> tasks;
    for (const Agent& task : base.instance.agents()) tasks.push_back({task.goal(), task.start});
    const Instance variant = Instance::make(base.instance.shared_graph(), tasks).value();
    ASSERT_EQ(base.solve_variant(variant), base.cost) << seed << "\n" << instance_text(variant);
  }
}

// Two maps with a wall between them do not know each other: the sums add up.
TEST(SolverMetamorphic, SeparateMapsAddUp) {
  for (const Objective objective : kObjectives)
    for (std::uint64_t seed = 80'000; seed < 80'000 + scaled(15); ++seed) {
      Base left = make_base(seed, objective, 7), right = make_base(seed + 500, objective, 7);
      const GridLayout& a = *left.instance.graph().layout();
      const GridLayout& b = *right.instance.graph().layout();
      const std::int32_t width = a.width() + 1 + b.width();
      const std::int32_t height = std::max(a.height(), b.height());
      std::vector<bool> passable;
      for (std::int32_t y = 0; y < height; ++y)
        for (std::int32_t x = 0; x < width; ++x)
          passable.push_back(a.vertex_at({x, y}) || b.vertex_at({x - a.width() - 1, y}));
      const Graph graph = Graph::grid(width, height, passable);
      std::vector<Agent> tasks;
      const auto add = [&](const Instance& part, std::int32_t shift) {
        const GridLayout& from = *part.graph().layout();
        const auto vertex = [&](VertexId v) {
          const Cell cell = from.cell_of(v);
          return *graph.layout()->vertex_at({cell.x + shift, cell.y});
        };
        for (const Agent& task : part.agents())
          tasks.push_back({vertex(task.start), vertex(task.goal())});
      };
      add(left.instance, 0);
      add(right.instance, a.width() + 1);
      const bool both = left.cost >= 0 && right.cost >= 0;
      const Cost expected = !both ? -1
                            : objective == Objective::sum_of_costs
                                ? left.cost + right.cost
                                : std::max(left.cost, right.cost);
      const Instance joined = Instance::make(graph, tasks).value();
      ASSERT_EQ(left.solve_variant(joined), expected) << seed << "\n" << instance_text(joined);
    }
}

// The objectives bound each other.
TEST(SolverMetamorphic, MakespanAndSumOfCostsBoundEachOther) {
  for (std::uint64_t seed = 90'000; seed < 90'000 + scaled(20); ++seed) {
    Base base = make_base(seed, Objective::sum_of_costs);
    const Cost makespan = solve_checked(base.instance, all_systems(Objective::makespan)[1]);
    ASSERT_EQ(makespan < 0, base.cost < 0) << seed << "\n" << instance_text(base.instance);
    EXPECT_LE(makespan, base.cost);
    EXPECT_LE(base.cost,
              std::max<Cost>(-1, makespan * static_cast<Cost>(base.instance.num_agents())));
  }
}

}  // namespace
}  // namespace quadrille::discrete::support
