// SPDX-License-Identifier: MIT
// Solutions of packings against the definitions of the two linear programs, which prove each other
// optimal, and against all covers by whole rows; solved at once, and again and again while they
// grow.
#include "cover/packing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>

#include "support/environment.hpp"
#include "support/random.hpp"

namespace quadrille::continuous::test {
namespace {

using quadrille::support::Random;
using quadrille::support::scaled;

using Rows = std::vector<std::uint32_t>;

struct Program {
  std::vector<double> capacity;
  std::vector<Rows> columns;
  std::vector<double> worth;

  [[nodiscard]] double largest() const {
    double result = 1;
    for (const double c : capacity) result = std::max(result, c);
    return result;
  }
};

struct Solution {
  std::vector<double> primal, dual;
};

Program program_of(std::vector<double> capacity, std::vector<Rows> columns) {
  Program program{std::move(capacity), std::move(columns), {}};
  program.worth.assign(program.columns.size(), 1);
  return program;
}

Solution solve(const Program& program) {
  Packing packing(program.largest());
  for (std::size_t r = 0; r < program.capacity.size(); ++r)
    EXPECT_EQ(packing.add_row(program.capacity[r], {}), r);
  for (std::size_t c = 0; c < program.columns.size(); ++c)
    EXPECT_EQ(packing.add_column(program.columns[c], program.worth[c]), c);
  packing.solve();
  return {packing.primal(), packing.dual()};
}

double sum(const std::vector<double>& items) {
  return std::accumulate(items.begin(), items.end(), 0.0);
}

double product(const std::vector<double>& a, const std::vector<double>& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

/// Both are feasible, and of one value: then neither can be better.
void expect_optimal(const Program& program, const Solution& solution) {
  const double in_capacity = 1e-7 * program.largest(), in_price = 1e-7;
  ASSERT_EQ(solution.primal.size(), program.columns.size());
  ASSERT_EQ(solution.dual.size(), program.capacity.size());
  std::vector<double> used(program.capacity.size(), 0);
  for (std::size_t c = 0; c < program.columns.size(); ++c) {
    EXPECT_GE(solution.primal[c], -in_capacity);
    double prices = 0;
    for (const std::uint32_t r : program.columns[c]) {
      used[r] += solution.primal[c];
      prices += solution.dual[r];
    }
    EXPECT_GE(prices, program.worth[c] - in_price) << "column " << c;
  }
  for (std::size_t r = 0; r < used.size(); ++r) {
    EXPECT_LE(used[r], program.capacity[r] + in_capacity) << "row " << r;
    EXPECT_GE(solution.dual[r], -in_price);
  }
  EXPECT_NEAR(product(program.worth, solution.primal), product(program.capacity, solution.dual),
              10 * in_capacity);
}

/// The cheapest set of rows that has one of each column.
double least_cover(const Program& program) {
  double best = std::numeric_limits<double>::infinity();
  for (std::uint32_t set = 0; set < std::uint32_t{1} << program.capacity.size(); ++set) {
    bool is_cover = true;
    for (const Rows& rows : program.columns)
      is_cover &= std::any_of(rows.begin(), rows.end(),
                              [&](std::uint32_t r) { return (set >> r & 1) != 0; });
    double cost = 0;
    for (std::size_t r = 0; r < program.capacity.size(); ++r)
      if ((set >> r & 1) != 0) cost += program.capacity[r];
    if (is_cover) best = std::min(best, cost);
  }
  return best;
}

/// Capacities 0 and equal ones too: there the simplex method stands still, and may go in circles.
Program random_program(Random& random) {
  const std::size_t num_rows = random.between(1, 8), num_columns = random.below(9);
  const double scale = random.percent(50) ? 1 : 3e8;
  const std::size_t num_capacities = random.between(1, 6);
  std::vector<double> capacity;
  for (std::size_t r = 0; r < num_rows; ++r)
    capacity.push_back(scale * static_cast<double>(random.below(num_capacities)));
  std::vector<Rows> columns(num_columns);
  const std::size_t density = random.between(10, 90);
  for (Rows& rows : columns) {
    for (std::uint32_t r = 0; r < num_rows; ++r)
      if (random.percent(density)) rows.push_back(r);
    if (rows.empty()) rows.push_back(static_cast<std::uint32_t>(random.below(num_rows)));
  }
  return program_of(std::move(capacity), std::move(columns));
}

/// Some columns are worth more, and are in some rows more than once.
void make_heavy(Random& random, Program& program) {
  for (std::size_t c = 0; c < program.columns.size(); ++c) {
    program.worth[c] = static_cast<double>(random.between(1, 3));
    Rows& rows = program.columns[c];
    const std::size_t distinct = rows.size();
    for (std::size_t k = 0; k < distinct; ++k)
      if (random.percent(30)) rows.push_back(rows[k]);
  }
}

TEST(Packing, IsOptimal) {
  for (std::size_t seed = 0; seed < scaled(3000); ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    Program program = random_program(random);
    const Solution solution = solve(program);
    expect_optimal(program, solution);
    const Solution again = solve(program);
    EXPECT_EQ(again.primal, solution.primal);
    EXPECT_EQ(again.dual, solution.dual);
    EXPECT_LE(sum(solution.primal), least_cover(program) + 1e-7 * program.largest());
    make_heavy(random, program);
    expect_optimal(program, solve(program));
    if (testing::Test::HasFailure()) return;
  }
}

// Rows and columns come in portions, after each of which it is solved. As the leaves of a cover do
// it, a row has what the row before it has, and no less room.
TEST(Packing, GrowsFromItsSolutions) {
  std::size_t num_moved = 0;
  for (std::size_t seed = 0; seed < scaled(3000); ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    Program program = random_program(random);
    make_heavy(random, program);
    const std::size_t num_first = program.columns.size() - random.below(program.columns.size() + 1);
    Packing packing(program.largest());
    for (const double c : program.capacity) static_cast<void>(packing.add_row(c, {}));
    for (std::size_t c = 0; c < num_first; ++c)
      static_cast<void>(packing.add_column(program.columns[c], program.worth[c]));
    packing.solve();
    // A row that asks for no more than another one.
    const auto like = static_cast<std::uint32_t>(random.below(program.capacity.size()));
    const auto added = static_cast<std::uint32_t>(program.capacity.size());
    std::vector<std::uint32_t> listed;
    for (std::uint32_t c = 0; c < program.columns.size(); ++c) {
      const Rows rows = program.columns[c];
      for (const std::uint32_t r : rows)
        if (r == like) program.columns[c].push_back(added);
      if (c >= num_first && program.columns[c].size() == rows.size() && random.percent(50))
        program.columns[c].push_back(added);
      if (c < num_first) listed.insert(listed.end(), program.columns[c].size() - rows.size(), c);
    }
    program.capacity.push_back(program.capacity[like] +
                               static_cast<double>(random.below(2)) * program.largest());
    EXPECT_EQ(packing.add_row(program.capacity.back(), listed), added);
    const std::vector<double> before = packing.primal();
    for (std::size_t c = num_first; c < program.columns.size(); ++c) {
      EXPECT_EQ(packing.add_column(program.columns[c], program.worth[c]), c);
      if (random.percent(50)) packing.solve();
    }
    packing.solve();
    const Solution solution{packing.primal(), packing.dual()};
    const double value = product(program.worth, solution.primal);
    expect_optimal(program, solution);
    EXPECT_NEAR(value, product(program.worth, solve(program).primal), 1e-6 * program.largest());
    for (std::size_t c = 0; c < num_first; ++c)
      if (std::abs(before[c] - solution.primal[c]) > 1e-3) {
        ++num_moved;
        break;
      }
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GE(num_moved, scaled(3000) / 20);
}

// As many rows and columns as groups of agents in congestion have.
TEST(Packing, IsOptimalWhereItIsLarge) {
  for (std::size_t seed = 0; seed < scaled(10); ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    std::vector<double> capacity;
    for (int r = 0; r < 60; ++r) capacity.push_back(static_cast<double>(random.below(4)));
    std::vector<Rows> columns(150);
    for (Rows& rows : columns)
      for (std::uint32_t r = static_cast<std::uint32_t>(random.below(60)); r < 60;
           r += static_cast<std::uint32_t>(random.between(1, 40)))
        rows.push_back(r);
    const Program program = program_of(std::move(capacity), std::move(columns));
    expect_optimal(program, solve(program));
  }
}

TEST(Packing, TakesHalves) {
  // Three rows, each two of which have a column: one half of each row covers all.
  const Solution solution = solve(program_of({1, 1, 1}, {{0, 1}, {1, 2}, {0, 2}}));
  for (const double u : solution.primal) EXPECT_NEAR(u, 0.5, 1e-9);
  for (const double price : solution.dual) EXPECT_NEAR(price, 0.5, 1e-9);
}

TEST(Packing, OfNothing) {
  const Solution empty = solve(program_of({}, {}));
  EXPECT_TRUE(empty.primal.empty());
  EXPECT_TRUE(empty.dual.empty());
  const Solution no_column = solve(program_of({5, 0}, {}));
  EXPECT_TRUE(no_column.primal.empty());
  EXPECT_EQ(no_column.dual, (std::vector<double>{0, 0}));
}

TEST(Packing, ARowWithoutRoomIsFree) {
  const Solution solution = solve(program_of({0, 7}, {{0, 1}, {1}}));
  EXPECT_NEAR(solution.primal[0], 0, 1e-9);
  EXPECT_NEAR(solution.primal[1], 7, 1e-9);
}

}  // namespace
}  // namespace quadrille::continuous::test
