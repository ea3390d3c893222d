// SPDX-License-Identifier: MIT
#include "solve/second_chance.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "discrete/primal/primal_support.hpp"
#include "support/joint_search.hpp"

namespace quadrille::discrete {
namespace {

using primal_test::crowd;
using primal_test::distances_of;
using primal_test::searched;

// Steps: of an incumbent before the first look, and until the second.
constexpr std::int64_t kFirst = 2'000'000, kSecond = 3'000'000, kSlice = 20'000;

class SecondChanceTest : public testing::Test {
 protected:
  Instance instance_ = crowd(9, 50, 1);
  Plan first_ = searched(instance_).plan();
  Cost cost_ = first_.cost(Objective::sum_of_costs);
  LimitMonitor limits_{Limits{}};
  Settings settings_;
  SecondChance chance_{instance_,
                       distances_of(instance_),
                       Objective::sum_of_costs,
                       std::make_shared<const Plan>(first_),
                       0,
                       settings_};

  /// Until it is over. The cheapest plan.
  std::optional<Plan> finish(Cost cost) {
    std::optional<Plan> best;
    while (chance_.is_at_work())
      if (auto plan = chance_.advance(kSlice, limits_, cost)) {
        cost = plan->cost(Objective::sum_of_costs);
        best = std::move(plan);
      }
    return best;
  }
};

TEST_F(SecondChanceTest, BeginsWhereLittleIsGained) {
  chance_.watch(kFirst, 1000, 100);
  EXPECT_FALSE(chance_.is_at_work());
  chance_.watch(kFirst + 1, 1000, 100);  // too soon to tell
  EXPECT_FALSE(chance_.is_at_work());
  chance_.watch(kSecond, 990, 500);  // that was much
  EXPECT_FALSE(chance_.is_at_work());
  chance_.watch(2 * kSecond, 985, 500);
  EXPECT_TRUE(chance_.is_at_work()) << "a hundredth of the gap is little";
}

TEST_F(SecondChanceTest, FindsACheaperPlan) {
  chance_.watch(kFirst, cost_, cost_);
  chance_.watch(kSecond, cost_, cost_);
  ASSERT_TRUE(chance_.is_at_work());
  const auto plan = finish(cost_);
  ASSERT_TRUE(plan);
  EXPECT_EQ(support::replay(instance_, *plan), "");
  EXPECT_LT(plan->cost(Objective::sum_of_costs), cost_);
}

TEST_F(SecondChanceTest, GetsTwiceWhatWentBeforeAndThenLeavesAsMuchToTheIncumbent) {
  chance_.watch(kFirst, cost_, cost_);
  chance_.watch(kSecond, cost_, cost_);
  finish(cost_);
  const std::int64_t effort = chance_.effort();
  EXPECT_GE(effort, 2 * kSecond);
  EXPECT_LE(effort, 2 * kSecond + 2 * kSlice);
  // The incumbent gains nothing meanwhile.
  chance_.watch(2 * kSecond, cost_, cost_);
  EXPECT_FALSE(chance_.is_at_work());
  chance_.watch(3 * kSecond + kSlice, cost_, cost_);
  EXPECT_TRUE(chance_.is_at_work());
}

TEST_F(SecondChanceTest, EndsWhereItCannotCatchUp) {
  chance_.watch(kFirst, 1, 1);
  chance_.watch(kSecond, 1, 1);
  ASSERT_TRUE(chance_.is_at_work());
  EXPECT_FALSE(finish(1));
  EXPECT_LT(chance_.effort(), kSecond);
}

}  // namespace
}  // namespace quadrille::discrete
