// SPDX-License-Identifier: MIT
#include "quadrille/core/attribution.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace quadrille {
namespace {

using testing::ElementsAre;

constexpr AgentId kA(0), kB(1), kC(2);

CollisionSite at_vertex(std::size_t v, AgentId first, AgentId second, Cost begin, Cost end) {
  return {first, second, {Place::Kind::vertex, VertexId(v), VertexId(v)}, {}, begin, end, 1};
}

Attribution with_raises(Cost lower_bound, std::vector<Cost> amounts) {
  Attribution attribution;
  attribution.agents = IdVector<AgentId, AgentCharge>(3, {10, {}});
  attribution.free_bound = 30;
  attribution.lower_bound = lower_bound;
  for (const Cost amount : amounts)
    attribution.raises.push_back({RaiseKind::core, amount, {kA, kB}, {}});
  return attribution;
}

TEST(Attribution, SitesWhoseTimesMeetAreOne) {
  const auto sites =
      merged({at_vertex(7, kA, kB, 5, 6), at_vertex(7, kA, kB, 3, 5), at_vertex(7, kA, kB, 8, 9),
              at_vertex(7, kA, kC, 4, 5), at_vertex(2, kA, kB, 4, 5), at_vertex(7, kA, kB, 3, 4)});
  std::vector<std::pair<Cost, Cost>> times;
  for (const CollisionSite& site : sites) times.emplace_back(site.begin, site.end);
  EXPECT_THAT(times,
              ElementsAre(std::pair(4, 5), std::pair(3, 6), std::pair(8, 9), std::pair(4, 5)));
  EXPECT_EQ(sites[1].num_lemmas, 3);
  EXPECT_EQ(sites[0].place.from, VertexId(2));
  EXPECT_EQ(sites[3].second, kC);
}

TEST(Attribution, SitesWithOtherSecondEdgesStayApart) {
  CollisionSite crossing = at_vertex(1, kA, kB, 0, 5);
  crossing.place = {Place::Kind::crossing, VertexId(1), VertexId(2)};
  crossing.other = Place{Place::Kind::edge, VertexId(3), VertexId(4)};
  CollisionSite elsewhere = crossing;
  elsewhere.other->to = VertexId(5);
  EXPECT_EQ(merged({crossing, elsewhere, crossing}).size(), 2U);
}

TEST(Attribution, RaisesThatFitStay) {
  Attribution attribution = with_raises(35, {2, 3});
  fit_to_bound(attribution);
  EXPECT_EQ(attribution.raises.size(), 2U);
}

TEST(Attribution, WhatIsMissingIsOwedToAll) {
  Attribution attribution = with_raises(36, {2, 3});
  fit_to_bound(attribution);
  ASSERT_EQ(attribution.raises.size(), 3U);
  EXPECT_EQ(attribution.raises.back().kind, RaiseKind::total);
  EXPECT_EQ(attribution.raises.back().amount, 1);
  EXPECT_THAT(attribution.raises.back().agents, ElementsAre(kA, kB, kC));
}

TEST(Attribution, WhatIsTooMuchIsCutFromTheEnd) {
  Attribution attribution = with_raises(33, {2, 3, 4});
  fit_to_bound(attribution);
  ASSERT_EQ(attribution.raises.size(), 2U);
  EXPECT_EQ(attribution.raises[0].amount, 2);
  EXPECT_EQ(attribution.raises[1].amount, 1);
}

}  // namespace
}  // namespace quadrille
