// SPDX-License-Identifier: MIT
// Sums in the linear programs of leaves, against all integer solutions of the leaf.
#include <gtest/gtest.h>

#include <optional>

#include "continuous/cover/leaf_cases.hpp"
#include "cover/leaf_program.hpp"
#include "support/environment.hpp"

namespace quadrille::continuous::test {
namespace {

using quadrille::support::scaled;

// A leaf that is solved again and again: sums raise its bound, never above the least price; they
// hold whatever the leaf is, and serve other leaves.
TEST(LeafProgramSums, RaiseBoundsAndHold) {
  std::size_t num_tightened = 0, num_served = 0;
  for (std::size_t seed = 0; seed < scaled(3000); ++seed) {
    SCOPED_TRACE(seed);
    const LeafCase c = LeafCase::draw(seed);
    Random random(seed);
    const CoreTable table(c.input.pointers());
    LeafProgram program(c.input.free_costs);
    program.set_cores(table);
    CoverLeaf leaf = c.leaf, plain = c.leaf;
    Costs costs;
    const std::optional<Cost> least = least_price(c.input, c.leaf);
    ASSERT_EQ(program.solve(plain, costs), least.has_value());
    std::vector<CoverSum> sums;
    program.set_sums(sums);
    for (int k = 0; k < 30; ++k) {
      ASSERT_EQ(program.solve(leaf, costs), least.has_value());
      if (!least) break;
      ASSERT_LE(leaf.bound, *least);
      if (program.is_integral()) {
        ASSERT_TRUE(hit_all(costs, c.input.cores));
        ASSERT_EQ(c.input.price(costs), *least);
      }
    }
    num_tightened += static_cast<std::size_t>(leaf.bound > plain.bound);
    program.set_cores(table);
    program.set_sums(sums);  // without those of no use
    for (int k = 0; k < 5; ++k) {
      const CoverLeaf drawn = draw_leaf(random, c.input);
      CoverLeaf with = drawn, without = drawn;
      const std::optional<Cost> price = least_price(c.input, drawn);
      const bool has_solution = program.solve(with, costs);
      // Sums may see it where cores do not: then there is none.
      ASSERT_TRUE(has_solution || !price);
      LeafProgram other(c.input.free_costs);
      other.set_cores(table);
      ASSERT_EQ(other.solve(without, costs), price.has_value());
      if (!price) continue;
      ASSERT_LE(with.bound, *price);
      ASSERT_GE(static_cast<double>(with.bound), static_cast<double>(without.bound) - c.loss() - 1);
      num_served += static_cast<std::size_t>(with.bound > without.bound);
      expect_form(c.input, with);
      ASSERT_EQ(with.branch.has_value(), !hit_all(low_ends(c.input, with), c.input.cores));
    }
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GE(num_tightened, scaled(3000) / 200);
  EXPECT_GE(num_served, scaled(3000) / 200);
}

TEST(LeafProgramSums, GoWithTheirLevels) {
  const LevelCores input{{0, 0}, {{{AgentId(0), 2}, {AgentId(1), 3}}}};
  const CoreTable table(input.pointers());
  LeafProgram program(input.free_costs);
  program.set_cores(table);
  const LevelSum known{{{AgentId(0), 2}, {AgentId(1), 3}}, 1};
  std::vector<CoverSum> sums{{known, true}, {known, false}, {{{{AgentId(0), 1}}, 1}, true}};
  program.set_sums(sums);
  ASSERT_EQ(sums.size(), 1u);
  EXPECT_EQ(sums.front().sum, known);
}

}  // namespace
}  // namespace quadrille::continuous::test
