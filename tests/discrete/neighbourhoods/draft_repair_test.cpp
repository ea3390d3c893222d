// SPDX-License-Identifier: MIT
#include "neighbourhoods/draft_repair.hpp"

#include <gtest/gtest.h>

#include <utility>

#include "discrete/primal/primal_support.hpp"
#include "quadrille/discrete/verify.hpp"

namespace quadrille::discrete::primal_test {
namespace {

/// Agents that have to pass each other, and how they would go alone.
struct Meeting {
  explicit Meeting(const std::string& text) : Meeting(instance_of(text)) {}
  explicit Meeting(Instance crowd) : instance(std::move(crowd)) {
    for (const AgentId agent : instance.agent_ids()) {
      const VertexId start = instance.agents()[agent].start, goal = instance.agents()[agent].goal();
      Path path{start};
      while (path.back() != goal) {
        const auto near = instance.graph().neighbours(path.back());
        const auto ahead = distances_from(instance.graph(), goal);
        for (const VertexId v : near)
          if (ahead[v] < ahead[path.back()]) {
            path.push_back(v);
            break;
          }
      }
      draft.paths.push_back(path);
    }
  }
  Instance instance;
  Plan draft;
};

TEST(DraftRepair, TakesOneDraftAtATimeAndFewerWhenTheyAreOfNoUse) {
  const Meeting meeting("map\n.....\n@.@@@\ntask 0 0 -> 4 0\ntask 4 0 -> 0 0\n");
  DraftRepair repair(meeting.instance, distances_of(meeting.instance), 0);
  LimitMonitor limits{Limits{}};
  int taken[2] = {0, 0};
  for (const int useful : {1, 0})
    for (int k = 0; k < 100; ++k) {
      const bool wanted = repair.wants_draft();
      if (!wanted) {
        repair.let_pass();
        continue;
      }
      repair.begin(meeting.draft);
      ASSERT_TRUE(repair.is_at_work());
      ++taken[useful];
      EXPECT_FALSE(repair.wants_draft());
      while (!repair.advance(1, limits)) ASSERT_TRUE(repair.is_at_work());
      EXPECT_FALSE(repair.is_at_work());
      EXPECT_TRUE(verify(meeting.instance, repair.plan()).valid());
      repair.report(useful != 0);
    }
  EXPECT_EQ(taken[1], 100);
  EXPECT_EQ(taken[0], 14);  // After 1, 3 and then each time 7 others.
}

TEST(DraftRepair, DropsWhatResists) {
  // There is no plan.
  const Meeting meeting("map\n.....\ntask 0 0 -> 4 0\ntask 4 0 -> 0 0\n");
  DraftRepair repair(meeting.instance, distances_of(meeting.instance), 0);
  LimitMonitor limits{Limits{}};
  std::int64_t num_slices[2] = {0, 0};
  for (auto& count : num_slices) {
    while (!repair.wants_draft()) repair.let_pass();
    repair.begin(meeting.draft);
    for (; repair.is_at_work() && count < 100'000; ++count)
      ASSERT_FALSE(repair.advance(100, limits));
    EXPECT_FALSE(repair.wants_draft());
  }
  EXPECT_GT(num_slices[0], 20);
  EXPECT_GT(num_slices[1], num_slices[0] * 3 / 2);  // More patient.
  EXPECT_LT(num_slices[1], 2'000);
}

TEST(DraftRepair, GoesOnWhileMeetingsHalve) {
  const Meeting crowd(primal_test::crowd(20, 200, 3));
  std::int64_t length = 0;
  for (const Path& path : crowd.draft.paths) length += static_cast<std::int64_t>(path.size());
  DraftRepair repair(crowd.instance, distances_of(crowd.instance), 0);
  LimitMonitor limits{Limits{}};
  repair.begin(crowd.draft);
  while (!repair.advance(1000, limits)) ASSERT_TRUE(repair.is_at_work());
  EXPECT_EQ(repair.patience(), 1);
  // More than what two halvings may take.
  EXPECT_GT(repair.effort(), 2 * (20 * length + 20'000));
}

}  // namespace
}  // namespace quadrille::discrete::primal_test
