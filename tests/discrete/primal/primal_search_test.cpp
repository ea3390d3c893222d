// SPDX-License-Identifier: MIT
#include "primal/primal_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

#include "discrete/primal/primal_support.hpp"
#include "primal/beam_search.hpp"
#include "quadrille/discrete/verify.hpp"
#include "settle/settle.hpp"
#include "support/environment.hpp"
#include "support/joint_search.hpp"

namespace quadrille::discrete::primal_test {
namespace {

using State = PrimalSearch::State;
using quadrille::support::scaled;
using support::instance_text;

/// 2 x 3, with one cell free or none.
Instance random_full_board(support::Random& random) {
  return support::random_tasks(random, Graph::grid(3, 2, std::vector<bool>(6, true)),
                               5 + random.below(2));
}

TEST(PrimalSearch, FollowsTheSequenceOfLuby) {
  const std::vector<std::int64_t> expected{1, 1, 2, 1, 1, 2, 4, 1, 1, 2, 1, 1, 2, 4, 8, 1};
  for (std::uint32_t k = 1; k <= expected.size(); ++k) EXPECT_EQ(luby(k), expected[k - 1]) << k;
}

TEST(PrimalSearch, FindsAPlanIfAndOnlyIfThereIsOne) {
  support::Random random(3);
  std::size_t num_feasible = 0, num_infeasible = 0;
  for (std::size_t round = 0; round < scaled(1000); ++round) {
    const Instance instance = random_instance(random);
    const auto answer = support::joint_search(instance, Objective::makespan);
    if (answer.status == Status::unknown) continue;
    LimitMonitor limits{Limits{}};
    PrimalSearch search(instance, distances_of(instance), static_cast<std::uint32_t>(round));
    State state = State::searching;
    while (state == State::searching)
      state = search.advance(1 + static_cast<std::int64_t>(random.below(100'000)), limits);
    ASSERT_EQ(state, answer.status == Status::optimal ? State::found : State::exhausted)
        << instance_text(instance);
    ++(state == State::found ? num_feasible : num_infeasible);
    if (state == State::found) {
      ASSERT_TRUE(verify(instance, search.plan()).valid()) << instance_text(instance);
    }
  }
  EXPECT_GE(num_feasible, scaled(250));
  EXPECT_GE(num_infeasible, scaled(125));
}

// Boards of up to 97 % agents, thousands of them, each within a few megasteps.
TEST(PrimalSearch, FindsPlansForCrowds) {
  std::size_t num_without = 0;
  const std::size_t rounds = scaled(1500);
  for (std::size_t round = 0; round < rounds; ++round) {
    const auto side = static_cast<std::int32_t>(4 + round % 13);
    const auto cells = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
    const std::size_t agents = cells * (50 + round * 7 % 48) / 100;
    const Instance instance = crowd(side, agents, round);
    LimitMonitor limits{Limits{}};
    PrimalSearch search(instance, distances_of(instance), 0);
    // To the first plan, not to the best one.
    while (search.state() == State::searching && search.effort() < 20'000'000)
      static_cast<void>(search.advance(20'000, limits));
    if (search.state() != State::found) {
      ++num_without;
      continue;
    }
    ASSERT_TRUE(verify(instance, search.plan()).valid()) << side << " " << agents;
  }
  EXPECT_EQ(num_without, 0);
}

TEST(PrimalSearch, TheSameEffortsGiveTheSamePlan) {
  const Instance instance = crowd(9, 70, 5);
  const auto found = [&] {
    LimitMonitor limits{Limits{}};
    PrimalSearch search(instance, distances_of(instance), 3);
    while (search.advance(1000, limits) == State::searching) {
    }
    return search.plan();
  };
  const Plan plan = found();
  EXPECT_EQ(found(), plan);
}

TEST(PrimalSearch, GoesOnToACheaperPlan) {
  std::size_t num_cheaper = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const Instance instance = crowd(12, 60, seed);
    LimitMonitor limits{Limits{}};
    PrimalSearch search(instance, distances_of(instance), 0);
    while (search.advance(100, limits) == State::searching) {
    }
    const Cost first = search.plan().cost(Objective::sum_of_costs);
    while (!search.is_over()) ASSERT_EQ(search.advance(100, limits), State::found);
    const Plan last = search.plan();
    ASSERT_TRUE(verify(instance, last).valid());
    ASSERT_LE(last.cost(Objective::sum_of_costs), first);
    num_cheaper += last.cost(Objective::sum_of_costs) < first ? 1 : 0;
  }
  EXPECT_GE(num_cheaper, 5);
  EXPECT_LE(num_cheaper, 35);  // Both guides are of use.
}

TEST(PrimalSearch, IsSharedByTwo) {
  using Part = PrimalSearch::Part;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const Instance instance = crowd(12, 60, seed);
    LimitMonitor limits{Limits{}};
    const auto found = [&](Part part) {
      PrimalSearch search(instance, distances_of(instance), 0, part);
      while (!search.is_over()) search.advance(100, limits);
      EXPECT_FALSE(search.is_at_guides());
      EXPECT_EQ(search.state(), State::found);
      return search.plan().cost(Objective::sum_of_costs);
    };
    const Cost first = found(Part::first_guide), rest = found(Part::rest);
    ASSERT_LE(std::min(first, rest), found(Part::all));
  }
}

TEST(PrimalSearch, OneOfTwoFindsAPlanIfAndOnlyIfThereIsOne) {
  support::Random random(11);
  for (std::size_t k = 0; k < scaled(300); ++k) {
    const Instance instance = random_instance(random);
    const State whole = searched(instance).state();
    LimitMonitor limits{Limits{}};
    PrimalSearch first(instance, distances_of(instance), 0, PrimalSearch::Part::first_guide);
    while (!first.is_over()) first.advance(10, limits);
    PrimalSearch rest(instance, distances_of(instance), 0, PrimalSearch::Part::rest);
    ASSERT_EQ(rest.advance(kNoEnd, limits), whole) << instance_text(instance);
    if (first.state() != State::searching) {
      ASSERT_EQ(first.state(), whole) << instance_text(instance);
    }
  }
}

TEST(PrimalSearch, TellsWhatFoundTheFirstPlan) {
  LimitMonitor limits{Limits{}};
  PrimalSearch search(crowd(4, 4, 1), distances_of(crowd(4, 4, 1)), 0);
  EXPECT_EQ(search.origin(), "");
  EXPECT_EQ(searched(crowd(6, 9, 1)).origin(), "lacam");
  EXPECT_EQ(searched(crowd(4, 14, 1)).origin(), "beam search");
  EXPECT_EQ(searched(crowd(16, 240, 1)).origin(), "settling");
}

/// A comb: a spine, and a corridor that hangs on each of its vertices. Every vertex but a few is on
/// no cycle, and a quarter is taken.
Instance comb(std::size_t corridors, std::size_t length, std::uint64_t seed) {
  std::vector<Graph::Edge> edges;
  const std::size_t n = corridors * (length + 1);
  for (std::size_t c = 0; c < corridors; ++c) {
    if (c > 0) edges.emplace_back(VertexId(c - 1), VertexId(c));
    for (std::size_t k = 0; k < length; ++k) {
      const std::size_t v = corridors + c * length + k;
      edges.emplace_back(VertexId(k == 0 ? c : v - 1), VertexId(v));
    }
  }
  support::Random random(seed);
  const auto drawn = [&] {
    std::vector<std::size_t> all(n);
    for (std::size_t v = 0; v < n; ++v) all[v] = v;
    random.shuffle(all);
    return all;
  };
  const auto starts = drawn(), goals = drawn();
  std::vector<Agent> agents;
  for (std::size_t i = 0; i < n / 4; ++i)
    agents.push_back({VertexId(starts[i]), VertexId(goals[i])});
  return Instance::make(Graph::make(n, edges).value(), std::move(agents)).value();
}

TEST(PrimalSearch, SettlesAgentsAsSoonAsTheFirstGuideHasFailed) {
  const Instance instance = comb(20, 15, 1);
  LimitMonitor limits{Limits{}};
  PrimalSearch search(instance, distances_of(instance), 0);
  while (search.state() == State::searching) static_cast<void>(search.advance(1000, limits));
  EXPECT_EQ(search.origin(), "settling");
  // A turn of the second guide alone would be more.
  EXPECT_LE(search.effort(), 200'000);
  const Cost settled = search.cost();
  while (!search.is_over()) static_cast<void>(search.advance(1000, limits));
  EXPECT_LE(3 * search.cost(), settled);
}

TEST(PrimalSearch, CrowdedBoardsGetPlansThatAreNoDearerThanSettledOnes) {
  for (std::uint64_t seed = 0; seed < scaled(6); ++seed) {
    const auto side = static_cast<std::int32_t>(4 + seed % 8);
    const auto cells = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
    const Instance instance = crowd(side, cells - seed % 4, seed);
    LimitMonitor limits{Limits{}};
    Settling settling(instance);
    ASSERT_EQ(settling.advance(kNoEnd, limits), Settling::State::found);
    PrimalSearch search(instance, distances_of(instance), 0);
    std::optional<Cost> before;
    while (!search.is_over()) {
      if (search.advance(500'000, limits) != State::found) continue;
      ASSERT_TRUE(verify(instance, search.plan()).valid()) << instance_text(instance);
      ASSERT_EQ(search.plan().cost(Objective::sum_of_costs), search.cost());
      ASSERT_LE(search.cost(), before.value_or(search.cost()));
      before = search.cost();
    }
    ASSERT_LE(search.cost(), settling.plan(limits)->cost(Objective::sum_of_costs));
  }
}

// The optimum comes from search over the joint positions.
TEST(BeamSearch, IsCloseToTheOptimumOnFullBoards) {
  support::Random random(17);
  Cost optimal = 0, found = 0;
  std::size_t num_found = 0;
  for (std::size_t round = 0; round < scaled(40); ++round) {
    const Instance instance = random_full_board(random);
    const auto answer = support::joint_search(instance, Objective::sum_of_costs);
    if (answer.status != Status::optimal) continue;
    LimitMonitor limits{Limits{}};
    BeamSearch search(instance, distances_of(instance), static_cast<std::uint32_t>(round));
    while (!search.is_over())
      search.advance(1 + static_cast<std::int64_t>(random.below(100'000)), limits);
    if (!search.plan()) continue;
    ++num_found;
    ASSERT_TRUE(verify(instance, *search.plan()).valid()) << instance_text(instance);
    const Cost cost = search.plan()->cost(Objective::sum_of_costs);
    ASSERT_GE(cost, answer.cost);
    optimal += answer.cost;
    found += cost;
  }
  EXPECT_GE(num_found, scaled(20));
  EXPECT_LE(10 * found, 13 * optimal);
}

TEST(BeamSearch, TheSamePlanInSlicesOfAnySize) {
  const Instance instance = crowd(5, 24, 2);
  const auto found = [&](std::int64_t slice) {
    LimitMonitor limits{Limits{}};
    BeamSearch search(instance, distances_of(instance), 0);
    while (!search.is_over()) search.advance(slice, limits);
    return search.plan();
  };
  const auto whole = found(kNoEnd);
  ASSERT_TRUE(whole.has_value());
  EXPECT_EQ(found(1), whole);
  EXPECT_EQ(found(10'000), whole);
}

}  // namespace
}  // namespace quadrille::discrete::primal_test
