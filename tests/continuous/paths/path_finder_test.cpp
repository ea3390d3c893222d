// SPDX-License-Identifier: MIT
// The search in safe intervals, and its explanations, against a search tick by tick.
#include "paths/path_finder.hpp"

#include <gtest/gtest.h>

#include "continuous/support/least_arrival.hpp"
#include "continuous/support/random_bans.hpp"
#include "support/environment.hpp"
#include "theory/explanation.hpp"
#include "traffic/scene.hpp"

namespace quadrille::continuous::test {
namespace {

constexpr AgentId kAgent(0);

/// An agent, its bans, and when it can arrive.
struct Trial {
  explicit Trial(std::uint32_t seed) : instance(small_instance(seed)) {
    Draw draw(seed);
    slots = random_slots(draw, instance.roadmap(), 16, 40);
    if (draw.chance(40) && !slots.empty()) {
      standing = slots.back();
      slots.pop_back();
    }
    bans.clear(standing);
    for (const auto& slot : slots) bans.add(slot);
    arrival = least([](std::size_t) { return true; });
  }
  template <class Choice>
  [[nodiscard]] std::optional<Ticks> least(const Choice& is_on) const {
    std::vector<Ban> all = bans_of(slots, is_on);
    all.insert(all.end(), standing.begin(), standing.end());
    return least_arrival(instance, kAgent, all);
  }
  /// Some bounds on the arrival.
  [[nodiscard]] std::vector<Ticks> bounds() const {
    const Ticks free = as_ticks(scene.free_cost(kAgent));
    std::vector<Ticks> bounds{free + 1, free + 10};
    if (arrival) bounds.insert(bounds.end(), {*arrival, *arrival + 1});
    bounds.push_back(kForever);
    return bounds;
  }

  Instance instance;
  LimitMonitor limits{Limits{}};
  Scene scene{instance, limits};
  Slots slots;
  std::vector<Ban> standing;  // belong to no slot
  BanTable bans{instance.roadmap()};
  std::optional<Ticks> arrival;
};

void expect_good_path(const Trial& trial, const TimedPath& path) {
  const Instance& instance = trial.instance;
  VertexId at = instance.agent(kAgent).start;
  Ticks since = 0;
  for (const Move& move : path.moves) {
    ASSERT_EQ(instance.roadmap().edge(move.edge).from, at);
    ASSERT_GE(move.start, std::max(since, instance.agent(kAgent).release));
    at = instance.roadmap().edge(move.edge).to;
    since = move.start + instance.duration(instance.class_of(kAgent), move.edge);
  }
  EXPECT_EQ(at, instance.agent(kAgent).goal());
  EXPECT_EQ(since, path.arrival);
  EXPECT_LE(since, instance.agent(kAgent).deadline.value_or(since));
  PathUses uses;
  uses.assign(instance, kAgent, path);
  for (const auto& bans : trial.slots) EXPECT_FALSE(uses.breaks(bans));
  EXPECT_FALSE(uses.breaks(trial.standing));
}

TEST(PathFinder, FindsTheLeastArrivalOrAnyBeforeTheBound) {
  int found = 0, delayed = 0, refused = 0, dearer = 0;
  for (std::uint32_t seed = 0; seed < support::scaled(1500) && !testing::Test::HasFailure();
       ++seed) {
    Trial trial(seed);
    SCOPED_TRACE(testing::Message() << "seed " << seed << ": " << describe(trial.instance));
    PathFinder finder(trial.instance);  // of all bounds
    for (const Ticks bound : trial.bounds()) {
      TimedPath path;
      const auto arrival = finder.find(trial.scene.task(kAgent), trial.bans, bound, &path);
      ASSERT_EQ(arrival.has_value(), trial.arrival && *trial.arrival < bound) << bound;
      if (arrival) {
        EXPECT_EQ(*arrival, *trial.arrival);
        EXPECT_EQ(path.arrival, *arrival);
        expect_good_path(trial, path);
        ++found;
        delayed += as_cost(*arrival) > trial.scene.free_cost(kAgent) ? 1 : 0;
      } else {
        ++refused;
      }
      TimedPath some;
      ASSERT_EQ(finder.find_any(trial.scene.task(kAgent), trial.bans, bound, &some),
                arrival.has_value());
      if (!arrival) continue;
      EXPECT_LT(some.arrival, bound);
      expect_good_path(trial, some);
      dearer += some.arrival > *arrival ? 1 : 0;
    }
  }
  if (support::scaled(1500) < 1500) return;  // too few to count on chance
  EXPECT_GT(found, 1000);
  EXPECT_GT(delayed, 200);
  EXPECT_GT(refused, 200);
  EXPECT_GT(dearer, 30);
}

TEST(FirstBroken, IsTheFirstSlotWithABanThatThePathBreaks) {
  int broken = 0, kept = 0, later = 0;
  for (std::uint32_t seed = 0; seed < support::scaled(1000) && !testing::Test::HasFailure();
       ++seed) {
    Trial trial(4'000'000 + seed);
    SCOPED_TRACE(testing::Message()
                 << "seed " << 4'000'000 + seed << ": " << describe(trial.instance));
    for (std::size_t slot = 0; slot < trial.slots.size(); ++slot) trial.bans.enable(slot, false);
    PathFinder finder(trial.instance);
    TimedPath path;
    if (!finder.find(trial.scene.task(kAgent), trial.bans, kForever, &path)) continue;
    PathUses uses;
    uses.assign(trial.instance, kAgent, path);
    const auto at = std::find_if(trial.slots.begin(), trial.slots.end(),
                                 [&](const auto& bans) { return uses.breaks(bans); });
    std::optional<std::size_t> expected;
    if (at != trial.slots.end()) expected = static_cast<std::size_t>(at - trial.slots.begin());
    EXPECT_EQ(first_broken(trial.instance, kAgent, path, trial.bans), expected);
    ++(expected ? broken : kept);
    later += expected.value_or(0) > 0 ? 1 : 0;
  }
  if (support::scaled(1000) < 1000) return;
  EXPECT_GT(broken, 300);
  EXPECT_GT(kept, 50);
  EXPECT_GT(later, 100);
}

TEST(ContinuousExplainer, NamesBansThatPreventAnArrivalAndNoneToSpare) {
  int explained = 0;
  for (std::uint32_t seed = 0; seed < support::scaled(1500) && !testing::Test::HasFailure();
       ++seed) {
    Trial trial(2'000'000 + seed);
    SCOPED_TRACE(testing::Message()
                 << "seed " << 2'000'000 + seed << ": " << describe(trial.instance));
    PathFinder finder(trial.instance);
    Explainer explainer(finder);
    for (const Ticks bound : trial.bounds()) {
      if (trial.arrival.value_or(kForever) < bound) continue;
      std::vector<std::size_t> blamed;
      explainer.explain(trial.scene.task(kAgent), trial.bans, bound, blamed);
      const auto least_without = [&](std::optional<std::size_t> left_out) {
        return trial
            .least([&](std::size_t slot) {
              return slot != left_out &&
                     std::find(blamed.begin(), blamed.end(), slot) != blamed.end();
            })
            .value_or(kForever);
      };
      EXPECT_GE(least_without(std::nullopt), bound);
      EXPECT_TRUE(std::is_sorted(blamed.begin(), blamed.end()));
      for (const std::size_t slot : blamed)
        EXPECT_LT(least_without(slot), bound) << "slot " << slot << " is not needed";
      for (std::size_t slot = 0; slot < trial.slots.size(); ++slot)
        EXPECT_TRUE(trial.bans.is_enabled(slot));
      ++explained;
    }
  }
  if (support::scaled(1500) == 1500) {
    EXPECT_GT(explained, 200);
  }
}

}  // namespace
}  // namespace quadrille::continuous::test
