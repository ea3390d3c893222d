// SPDX-License-Identifier: MIT
#include "cost/core_counter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <vector>

namespace quadrille::sat {
namespace {

/// Unary numbers of a solver: `most` of number i are its literals.
class Numbers {
 public:
  Numbers(Engine& engine, const std::vector<int>& most) {
    for (const int m : most) {
      lits_.emplace_back();
      for (int k = 0; k < m; ++k) lits_.back().push_back(engine.new_lit());
    }
  }
  [[nodiscard]] std::vector<Lit> level(int level) const {
    std::vector<Lit> lits;
    for (const auto& number : lits_)
      if (number.size() >= static_cast<std::size_t>(level))
        lits.push_back(number[static_cast<std::size_t>(level) - 1]);
    return lits;
  }
  [[nodiscard]] std::vector<Lit> equal_to(const std::vector<int>& values) const {
    std::vector<Lit> lits;
    for (std::size_t i = 0; i < values.size(); ++i)
      for (std::size_t k = 0; k < lits_[i].size(); ++k)
        lits.push_back(k < static_cast<std::size_t>(values[i]) ? lits_[i][k] : ~lits_[i][k]);
    return lits;
  }

 private:
  std::vector<std::vector<Lit>> lits_;
};

void for_all_values(const std::vector<int>& most,
                    const std::function<void(const std::vector<int>&)>& visit) {
  std::vector<int> values(most.size(), 0);
  while (true) {
    visit(values);
    std::size_t i = 0;
    while (i < most.size() && values[i] == most[i]) values[i++] = 0;
    if (i == most.size()) return;
    ++values[i];
  }
}

/// Asks in different orders, because what is there already is used again.
void expect_that_ranks_are_implied(const std::vector<int>& most, int height, bool top_first) {
  Engine engine(nullptr);
  const Numbers numbers(engine, most);
  CoreCounter counter(engine, height, [&](int level) { return numbers.level(level); });
  const int size = static_cast<int>(most.size());
  if (top_first)
    for (int count = size; count >= 1; --count) static_cast<void>(counter.at_least(height, count));
  EXPECT_FALSE(counter.at_least(height + 1, 1).valid());
  LimitMonitor limits{Limits{}};
  for_all_values(most, [&](const std::vector<int>& values) {
    std::vector<int> sorted = values;
    std::sort(sorted.rbegin(), sorted.rend());
    std::vector<Lit> assumptions = numbers.equal_to(values);
    for (int count = 1; count <= size; ++count)
      for (int level = 1; level <= height; ++level) {
        const Lit lit = counter.at_least(level, count);
        const bool holds = sorted[static_cast<std::size_t>(count) - 1] >= level;
        if (!lit.valid()) {
          EXPECT_FALSE(holds);
          continue;
        }
        assumptions.push_back(~lit);
        EXPECT_EQ(engine.solve(assumptions, limits), holds ? Verdict::unsat : Verdict::sat);
        assumptions.pop_back();
        // Assumed to be low, all above is low as well.
        if (level > 1) {
          const Lit below = counter.at_least(level - 1, count);
          EXPECT_EQ(engine.solve(std::vector<Lit>{lit, ~below}, limits), Verdict::unsat);
        }
      }
  });
}

TEST(CoreCounter, SaysHowLargeTheSecondAndTheThirdLargestNumberAre) {
  for (const bool top_first : {false, true}) {
    expect_that_ranks_are_implied({3, 3}, 3, top_first);
    expect_that_ranks_are_implied({3, 1, 2}, 3, top_first);
    expect_that_ranks_are_implied({2, 3, 3, 1}, 2, top_first);
    expect_that_ranks_are_implied({1, 1, 1}, 1, top_first);
  }
}

TEST(CoreCounter, SaysNothingOnceItIsRetired) {
  Engine engine(nullptr);
  const std::vector<int> most{2, 2, 2};
  const Numbers numbers(engine, most);
  CoreCounter counter(engine, 2, [&](int level) { return numbers.level(level); });
  for (int count = 2; count <= 3; ++count) static_cast<void>(counter.at_least(2, count));
  counter.retire();
  LimitMonitor limits{Limits{}};
  for_all_values(most, [&](const std::vector<int>& values) {
    EXPECT_EQ(engine.solve(numbers.equal_to(values), limits), Verdict::sat);
  });
}

}  // namespace
}  // namespace quadrille::sat
