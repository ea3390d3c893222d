// SPDX-License-Identifier: MIT
#include "quadrille/core/reasons.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace quadrille {
namespace {

using testing::ElementsAre;

constexpr AgentId kA(0), kB(1), kC(2), kD(3);
using Agents = std::vector<AgentId>;

/// Four agents that cost 10 each when alone.
Attribution four(Cost lower_bound, std::vector<Raise> raises) {
  Attribution attribution;
  attribution.agents = IdVector<AgentId, AgentCharge>(4, {10, {}});
  attribution.free_bound = 40;
  attribution.lower_bound = lower_bound;
  attribution.raises = std::move(raises);
  return attribution;
}

CollisionSite site(AgentId first, AgentId second, std::int64_t num_lemmas) {
  return {first, second, {}, {}, 0, 1, num_lemmas};
}

bool has_both(const Agents& agents, AgentId a, AgentId b) {
  return std::count(agents.begin(), agents.end(), a) +
             std::count(agents.begin(), agents.end(), b) ==
         2;
}

TEST(Reasons, NoneForFreeCosts) { EXPECT_TRUE(find_reasons(four(40, {}), {}).empty()); }

TEST(Reasons, AgentsThatShareRaisesBelongTogether) {
  const auto reasons = find_reasons(four(44, {{RaiseKind::core, 1, {kA, kB}, {}},
                                              {RaiseKind::core, 1, {kC, kD}, {kA}},
                                              {RaiseKind::core, 2, {kA, kB}, {}}}),
                                    {});
  ASSERT_EQ(reasons.size(), 2U);
  EXPECT_THAT(reasons[0].agents, ElementsAre(kA, kB));
  EXPECT_EQ(reasons[0].amount, 3);
  EXPECT_FALSE(reasons[0].is_checked);
  // What is not checked again may need its bystanders.
  EXPECT_THAT(reasons[1].agents, ElementsAre(kA, kC, kD));
  EXPECT_EQ(reasons[1].amount, 1);
}

TEST(Reasons, PairsThatAmountToAsMuchAreReasonsOfTheirOwn) {
  Attribution attribution = four(43, {{RaiseKind::total, 3, {kA, kB, kC, kD}, {}}});
  attribution.sites = {site(kA, kB, 1), site(kB, kC, 9), site(kC, kD, 2)};
  const Recheck recheck = [](const Agents& agents) {
    return Cost{10} * static_cast<Cost>(agents.size()) + (has_both(agents, kA, kB) ? 2 : 0) +
           (has_both(agents, kC, kD) ? 1 : 0);
  };
  const auto reasons = find_reasons(attribution, recheck);
  ASSERT_EQ(reasons.size(), 2U);
  EXPECT_THAT(reasons[0].agents, ElementsAre(kA, kB));
  EXPECT_EQ(reasons[0].amount, 2);
  EXPECT_TRUE(reasons[0].is_checked);
  EXPECT_THAT(reasons[0].sites, ElementsAre(0U));
  EXPECT_THAT(reasons[1].agents, ElementsAre(kC, kD));
  EXPECT_EQ(reasons[1].amount, 1);
}

TEST(Reasons, WhoIsNotNeededIsLeftOut) {
  Attribution attribution = four(43, {{RaiseKind::core, 3, {kA, kB, kC}, {kD}}});
  attribution.sites = {site(kA, kC, 1), site(kA, kC, 5)};
  // Three of them are needed, and it takes a search to say so.
  const Recheck recheck = [](const Agents& agents) {
    return Cost{10} * static_cast<Cost>(agents.size()) +
           (has_both(agents, kA, kC) && std::count(agents.begin(), agents.end(), kD) > 0 ? 3 : 0);
  };
  const auto reasons = find_reasons(attribution, recheck);
  ASSERT_EQ(reasons.size(), 1U);
  EXPECT_THAT(reasons[0].agents, ElementsAre(kA, kC, kD));
  EXPECT_TRUE(reasons[0].is_checked);
  EXPECT_THAT(reasons[0].sites, ElementsAre(1U, 0U));
}

TEST(Reasons, NothingIsClaimedThatASearchDoesNotConfirm) {
  const Attribution attribution = four(43, {{RaiseKind::core, 3, {kA, kB, kC}, {kD}}});
  const auto reasons =
      find_reasons(attribution, [](const Agents&) { return std::optional<Cost>(); });
  ASSERT_EQ(reasons.size(), 1U);
  EXPECT_THAT(reasons[0].agents, ElementsAre(kA, kB, kC, kD));
  EXPECT_FALSE(reasons[0].is_checked);
}

TEST(Reasons, TheMakespanHasItsLastRaise) {
  Attribution attribution =
      four(13, {{RaiseKind::core, 1, {kA, kB}, {}}, {RaiseKind::core, 2, {kB, kC, kD}, {}}});
  attribution.objective = Objective::makespan;
  attribution.free_bound = 10;
  const auto reasons = find_reasons(attribution, [](const Agents& agents) {
    return has_both(agents, kC, kD) ? Cost{13} : Cost{10};
  });
  ASSERT_EQ(reasons.size(), 1U);
  EXPECT_THAT(reasons[0].agents, ElementsAre(kC, kD));
  EXPECT_EQ(reasons[0].amount, 3);
}

TEST(Reasons, SearchesAreCounted) {
  std::size_t num_calls = 0;
  const Attribution attribution = four(43, {{RaiseKind::core, 3, {kA, kB, kC, kD}, {}}});
  const auto reasons = find_reasons(
      attribution,
      [&](const Agents&) {
        ++num_calls;
        return std::optional<Cost>(43);
      },
      1);
  EXPECT_EQ(num_calls, 1U);
  EXPECT_EQ(reasons.at(0).agents.size(), 4U);
}

}  // namespace
}  // namespace quadrille
