// SPDX-License-Identifier: MIT
// Solutions of packings against the definitions of the two linear programs, which prove each other
// optimal, and against all covers by whole rows.
#include "cover/packing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <initializer_list>
#include <limits>
#include <numeric>

#include "support/environment.hpp"
#include "support/random.hpp"

namespace quadrille::continuous::test {
namespace {

using quadrille::support::Random;
using quadrille::support::scaled;

Packing packing_of(std::vector<double> capacity,
                   const std::vector<std::vector<std::uint32_t>>& columns) {
  Packing packing{std::move(capacity), {0}, {}};
  for (const auto& rows : columns) {
    packing.column_rows.insert(packing.column_rows.end(), rows.begin(), rows.end());
    packing.column_begins.push_back(packing.column_rows.size());
  }
  return packing;
}

double sum(const std::vector<double>& items) {
  return std::accumulate(items.begin(), items.end(), 0.0);
}

double price(const Packing& packing, const std::vector<double>& dual) {
  return std::inner_product(dual.begin(), dual.end(), packing.capacity.begin(), 0.0);
}

double largest(const Packing& packing) {
  double result = 1;
  for (const double c : packing.capacity) result = std::max(result, c);
  return result;
}

/// Both are feasible, and of one value: then neither can be better.
void expect_optimal(const Packing& packing, const PackingSolution& solution) {
  const double in_capacity = 1e-7 * largest(packing), in_price = 1e-7;
  ASSERT_EQ(solution.primal.size(), packing.num_columns());
  ASSERT_EQ(solution.dual.size(), packing.capacity.size());
  std::vector<double> used(packing.capacity.size(), 0);
  for (std::size_t c = 0; c < packing.num_columns(); ++c) {
    EXPECT_GE(solution.primal[c], -in_capacity);
    double prices = 0;
    for (const std::uint32_t r : packing.rows_of(c)) {
      used[r] += solution.primal[c];
      prices += solution.dual[r];
    }
    EXPECT_GE(prices, 1 - in_price) << "column " << c;
  }
  for (std::size_t r = 0; r < used.size(); ++r) {
    EXPECT_LE(used[r], packing.capacity[r] + in_capacity) << "row " << r;
    EXPECT_GE(solution.dual[r], -in_price);
  }
  EXPECT_NEAR(sum(solution.primal), price(packing, solution.dual), in_capacity);
}

/// The cheapest set of rows that has one of each column.
double least_cover(const Packing& packing) {
  double best = std::numeric_limits<double>::infinity();
  for (std::uint32_t set = 0; set < std::uint32_t{1} << packing.capacity.size(); ++set) {
    bool is_cover = true;
    for (std::size_t c = 0; c < packing.num_columns(); ++c) {
      const auto rows = packing.rows_of(c);
      is_cover &= std::any_of(rows.begin(), rows.end(),
                              [&](std::uint32_t r) { return (set >> r & 1) != 0; });
    }
    double cost = 0;
    for (std::size_t r = 0; r < packing.capacity.size(); ++r)
      if ((set >> r & 1) != 0) cost += packing.capacity[r];
    if (is_cover) best = std::min(best, cost);
  }
  return best;
}

/// Capacities 0 and equal ones too: there the simplex method stands still, and may go in circles.
Packing random_packing(Random& random) {
  const std::size_t num_rows = random.between(1, 8), num_columns = random.below(9);
  const double scale = random.percent(50) ? 1 : 3e8;
  const std::size_t num_capacities = random.between(1, 6);
  std::vector<double> capacity;
  for (std::size_t r = 0; r < num_rows; ++r)
    capacity.push_back(scale * static_cast<double>(random.below(num_capacities)));
  std::vector<std::vector<std::uint32_t>> columns(num_columns);
  const std::size_t density = random.between(10, 90);
  for (auto& rows : columns) {
    for (std::uint32_t r = 0; r < num_rows; ++r)
      if (random.percent(density)) rows.push_back(r);
    if (rows.empty()) rows.push_back(static_cast<std::uint32_t>(random.below(num_rows)));
  }
  return packing_of(std::move(capacity), columns);
}

TEST(Packing, IsOptimal) {
  for (std::size_t seed = 0; seed < scaled(3000); ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Packing packing = random_packing(random);
    const PackingSolution solution = solve_packing(packing);
    expect_optimal(packing, solution);
    const PackingSolution again = solve_packing(packing);
    EXPECT_EQ(again.primal, solution.primal);
    EXPECT_EQ(again.dual, solution.dual);
    EXPECT_LE(sum(solution.primal), least_cover(packing) + 1e-7 * largest(packing));
    if (testing::Test::HasFailure()) return;
  }
}

// As many rows and columns as groups of agents in congestion have.
TEST(Packing, IsOptimalWhereItIsLarge) {
  for (std::size_t seed = 0; seed < scaled(10); ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    std::vector<double> capacity;
    for (int r = 0; r < 60; ++r) capacity.push_back(static_cast<double>(random.below(4)));
    std::vector<std::vector<std::uint32_t>> columns(150);
    for (auto& rows : columns)
      for (std::uint32_t r = static_cast<std::uint32_t>(random.below(60)); r < 60;
           r += static_cast<std::uint32_t>(random.between(1, 40)))
        rows.push_back(r);
    const Packing packing = packing_of(std::move(capacity), columns);
    expect_optimal(packing, solve_packing(packing));
  }
}

TEST(Packing, TakesHalves) {
  // Three rows, each two of which have a column: one half of each row covers all.
  const Packing packing = packing_of({1, 1, 1}, {{0, 1}, {1, 2}, {0, 2}});
  const PackingSolution solution = solve_packing(packing);
  for (const double u : solution.primal) EXPECT_NEAR(u, 0.5, 1e-9);
  for (const double price : solution.dual) EXPECT_NEAR(price, 0.5, 1e-9);
}

TEST(Packing, OfNothing) {
  const PackingSolution empty = solve_packing(packing_of({}, {}));
  EXPECT_TRUE(empty.primal.empty());
  EXPECT_TRUE(empty.dual.empty());
  const PackingSolution no_column = solve_packing(packing_of({5, 0}, {}));
  EXPECT_TRUE(no_column.primal.empty());
  EXPECT_EQ(no_column.dual, (std::vector<double>{0, 0}));
}

TEST(Packing, ARowWithoutRoomIsFree) {
  const Packing packing = packing_of({0, 7}, {{0, 1}, {1}});
  const PackingSolution solution = solve_packing(packing);
  EXPECT_NEAR(solution.primal[0], 0, 1e-9);
  EXPECT_NEAR(solution.primal[1], 7, 1e-9);
}

}  // namespace
}  // namespace quadrille::continuous::test
