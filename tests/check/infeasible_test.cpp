// SPDX-License-Identifier: MIT
// Certificates of instances without a plan: each is verified, and no instance with a plan has one.
#include "rules/infeasible.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <string>

#include "check/cases.hpp"
#include "check/support.hpp"
#include "quadrille/discrete/feasibility.hpp"
#include "support/environment.hpp"
#include "support/generators.hpp"

namespace quadrille_check {
namespace {

using quadrille::support::Random;
using quadrille::support::scaled;
namespace discrete = quadrille::discrete;
using discrete::support::draw_crowded;
using support::accepts;
using support::ask;
using support::checked;
using support::grid;

TEST(Infeasible, EachAnswerHasAReasonThatIsVerified) {
  std::map<Int, std::size_t> reasons;
  for (std::uint64_t seed = 0; seed < scaled(6000); ++seed) {
    SCOPED_TRACE(seed);
    const discrete::Instance drawn = draw_crowded(seed);
    if (discrete::check_feasibility(drawn).feasible) continue;
    discrete::SolveOptions options;
    options.proof = true;
    if (seed % 2 == 0) options.system = discrete::System::mdd_sat;
    const auto outcome = discrete::solve(drawn, options);
    ASSERT_TRUE(outcome.value().certificate);
    EXPECT_FALSE(outcome.value().certificate->claim);
    const std::string& bytes = outcome.value().certificate->bytes;
    const auto answer = ask(checked(drawn), bytes);
    ASSERT_TRUE(answer.is_verified)
        << answer.reason << support::text_of(support::records_of(bytes));
    EXPECT_TRUE(answer.verdict.is_infeasible);
    ++reasons[support::records_of(bytes).at(1).values[0]];
  }
  if (scaled(100) >= 100) {
    EXPECT_EQ(reasons.size(), 5U);
  }
}

/// Places in an order in which each is next to the one before it, as far as that goes.
Ints walk(const Instance& instance, Random& random) {
  Ints places{static_cast<Int>(random.below(static_cast<std::size_t>(instance.num_places())))};
  const std::size_t size = random.between(1, static_cast<std::size_t>(instance.num_places()));
  while (places.size() < size) {
    Ints next;
    for (const int place : instance.neighbours(static_cast<int>(places.back())))
      if (std::find(places.begin(), places.end(), place) == places.end()) next.push_back(place);
    if (next.empty()) break;
    places.push_back(random.pick(next));
  }
  return places;
}

bool holds(const Instance& instance, const Ints& values) {
  try {
    return is_infeasible(instance, values);
  } catch (const Rejected&) {
    return false;
  }
}

TEST(Infeasible, NoReasonHoldsWhereThereIsAPlan) {
  std::size_t feasible = 0;
  for (std::uint64_t seed = 10'000; seed < 10'000 + scaled(6000); ++seed) {
    SCOPED_TRACE(seed);
    const discrete::Instance drawn = draw_crowded(seed);
    if (!discrete::check_feasibility(drawn).feasible) continue;
    ++feasible;
    const Instance instance = checked(drawn);
    const auto num_agents = static_cast<Int>(instance.agents().size());
    Random random(seed);
    for (int k = 0; k < 60; ++k) {
      const Ints places = walk(instance, random);
      for (Int kind = 1; kind <= 5; ++kind) {
        Ints values{kind};
        if (kind != 3 && kind != 4)
          values.push_back(static_cast<Int>(random.below(static_cast<std::size_t>(num_agents))));
        if (kind == 5)
          values.push_back(
              static_cast<Int>(random.below(static_cast<std::size_t>(instance.num_places()) + 1)) -
              1);
        values.insert(values.end(), places.begin(), places.end());
        ASSERT_FALSE(holds(instance, values)) << kind << testing::PrintToString(places);
      }
      // All places, in any order.
      Ints all(static_cast<std::size_t>(instance.num_places()) + 1);
      std::iota(all.begin(), all.end(), -1);
      all[0] = 4;
      ASSERT_FALSE(holds(instance, all));
    }
  }
  EXPECT_GT(feasible, 0U);
}

TEST(Infeasible, ReasonsHaveFalseNeighbours) {
  // Two agents on a path change their order, or do not.
  const Instance path = grid("...", {{0, 1}, {2, 0}}), same = grid("...", {{0, 1}, {1, 2}});
  EXPECT_TRUE(accepts(path, "z 5 0 -1 0 1 2"));
  EXPECT_FALSE(accepts(same, "z 5 0 -1 0 1 2"));
  EXPECT_TRUE(accepts(path, "z 5 0 -1 0 1"));
  EXPECT_FALSE(accepts(grid("....", {{0, 1}, {3, 0}}), "z 5 0 -1 0"));  // two vertices are free
  EXPECT_FALSE(accepts(path, "z 5 0 -1 0 2 1"));
  EXPECT_FALSE(accepts(path, "z 1 0"));
  // With a pocket they can.
  EXPECT_FALSE(accepts(grid(".../@.@", {{0, 1}, {2, 0}}), "z 5 0 -1 0 1 2"));
  // A wall.
  EXPECT_TRUE(accepts(grid(".@.", {{0, 2}}), "z 1 0"));
  // Three on a square keep their cyclic order, also with a free vertex.
  EXPECT_TRUE(accepts(grid("../..", {{0, 1}, {1, 0}, {2, 2}}), "z 3 0 1 3 2"));
  EXPECT_FALSE(accepts(grid("../..", {{0, 1}, {1, 3}, {2, 0}}), "z 3 0 1 3 2"));
  EXPECT_FALSE(accepts(grid("../..", {{0, 1}, {1, 0}, {2, 2}}), "z 3 0 1 3"));
  EXPECT_FALSE(accepts(grid("../..", {{0, 1}, {1, 0}, {2, 2}}), "z 4 0 1 3 2"));  // it is even
  // Where no vertex is free nobody crosses a bridge.
  const Instance full = grid("...", {{0, 2}, {1, 0}, {2, 1}});
  EXPECT_TRUE(accepts(full, "z 2 0 1 2"));
  EXPECT_FALSE(accepts(full, "z 2 1 1 2"));
  EXPECT_FALSE(accepts(full, "z 2 0 0 2"));
  EXPECT_FALSE(accepts(grid("...", {{0, 2}, {1, 0}}), "z 2 0 1 2"));
  // Nothing follows.
  EXPECT_FALSE(accepts(path, "z 5 0 -1 0 1 2\nq 3 0"));
}

TEST(Infeasible, OddCyclesMakeEvenPermutationsOnly) {
  // Two triangles that share a vertex.
  const auto butterfly = [](const std::vector<int>& goals) {
    Instance made = Instance::on_graph(5, {{0, 1}, {1, 2}, {0, 2}, {2, 3}, {3, 4}, {2, 4}});
    for (int k = 0; k < 5; ++k) made.add_agent({k, goals[static_cast<std::size_t>(k)]});
    return made;
  };
  EXPECT_TRUE(accepts(butterfly({1, 0, 2, 3, 4}), "z 4 0 1 2 3 4"));
  EXPECT_FALSE(accepts(butterfly({1, 0, 2, 4, 3}), "z 4 0 1 2 3 4"));
  EXPECT_FALSE(accepts(butterfly({1, 0, 2, 3, 4}), "z 4 0 1 2"));
  EXPECT_FALSE(accepts(butterfly({1, 0, 2, 3, 4}), "z 3 0 1 2"));
}

}  // namespace
}  // namespace quadrille_check
