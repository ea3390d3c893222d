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
        engine.add_clause({LemmaKind::order, clause, {}, false});
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

}  // namespace
}  // namespace quadrille::sat
