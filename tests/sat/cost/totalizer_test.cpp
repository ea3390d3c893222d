// SPDX-License-Identifier: MIT
#include "quadrille/sat/totalizer.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace quadrille::sat {
namespace {

/// Unary numbers of up to `max` each, with their order clauses.
struct Numbers {
  Numbers(Engine& engine, std::size_t count, int max) : digits(count) {
    for (auto& number : digits) {
      for (int k = 1; k <= max; ++k) number.push_back(engine.new_lit());
      for (std::size_t k = 1; k < number.size(); ++k) {
        const Lit clause[] = {~number[k], number[k - 1]};
        engine.add_clause({why::Order{}, clause, {}, false});
      }
    }
  }
  std::vector<std::vector<Lit>> digits;
};

// Every assignment of the inputs, against every bound, with the bounds asked for in growing order
// as the searches do.
TEST(Totalizer, BoundsTheSumExactly) {
  constexpr int kMax = 3;
  for (std::size_t count = 1; count <= 4; ++count) {
    Engine engine(nullptr);
    Numbers numbers(engine, count, kMax);
    Totalizer total(engine, count, [&](std::size_t input, int k) {
      return k <= kMax ? numbers.digits[input][static_cast<std::size_t>(k) - 1] : Lit();
    });
    const int largest = kMax * static_cast<int>(count);
    for (int bound = 1; bound <= largest; ++bound) {
      const Lit too_much = total.at_least(bound);
      ASSERT_TRUE(too_much.valid());
      std::vector<int> value(count, 0);
      while (true) {
        int sum = 0;
        std::vector<Lit> assumptions{~too_much};
        for (std::size_t i = 0; i < count; ++i) {
          sum += value[i];
          for (int k = 1; k <= kMax; ++k) {
            const Lit digit = numbers.digits[i][static_cast<std::size_t>(k) - 1];
            assumptions.push_back(k <= value[i] ? digit : ~digit);
          }
        }
        LimitMonitor limits{Limits{}};
        ASSERT_EQ(engine.solve(assumptions, limits), sum < bound ? Verdict::sat : Verdict::unsat);
        std::size_t i = 0;
        while (i < count && value[i] == kMax) value[i++] = 0;
        if (i == count) break;
        ++value[i];
      }
    }
    EXPECT_FALSE(total.at_least(largest + 1).valid());
  }
}

TEST(Totalizer, AllowsAnySumOnceItIsRetired) {
  constexpr int kMax = 2;
  Engine engine(nullptr);
  Numbers numbers(engine, 3, kMax);
  Totalizer total(engine, 3, [&](std::size_t input, int k) {
    return k <= kMax ? numbers.digits[input][static_cast<std::size_t>(k) - 1] : Lit();
  });
  // An input of the next one, as counters of cores are.
  const Lit many = total.at_least(3);
  Totalizer next(engine, 2, [&](std::size_t input, int k) {
    if (k > 1) return Lit();
    return input == 0 ? many : numbers.digits[0][0];
  });
  const Lit both = next.at_least(2);
  std::vector<Lit> all;
  for (const auto& number : numbers.digits) all.push_back(number.back());
  LimitMonitor limits{Limits{}};
  std::vector<Lit> assumptions = all;
  assumptions.push_back(~both);
  ASSERT_EQ(engine.solve(assumptions, limits), Verdict::unsat);
  next.retire();
  total.retire();
  EXPECT_EQ(engine.solve(all, limits), Verdict::sat);
  for (Lit& lit : all) lit = ~lit;
  EXPECT_EQ(engine.solve(all, limits), Verdict::sat);
}

}  // namespace
}  // namespace quadrille::sat
