// SPDX-License-Identifier: MIT
// Memory that runs out anywhere in a search ends it with what is known so far.
#include <gtest/gtest.h>

#include <new>
#include <optional>

#include "faults/failing_allocator.hpp"
#include "faults/instances.hpp"
#include "support/environment.hpp"

namespace quadrille::support {
namespace {

constexpr std::int64_t kForGood = INT64_MAX / 2;

struct Tally {
  int ended = 0;     // as if nothing had happened
  int stopped = 0;   // by StopReason::memory
  int had_plan = 0;  // among these
  int threw = 0;
};

/// Solves while some allocations fail, and holds what is claimed against the truth.
template <class Instance, class Options>
void solve_starved(const Instance& instance, const Options& options, Cost optimum, std::int64_t n,
                   std::int64_t length, Tally& tally) {
  SCOPED_TRACE("allocation " + std::to_string(n) + ", " + std::to_string(length));
  std::optional<std::decay_t<decltype(solve(instance, options).value())>> outcome;
  fail_allocations(n, length);
  try {
    outcome.emplace(solve(instance, options).value());
  } catch (const std::bad_alloc&) {
  }
  stop_failing();
  if (!outcome) {
    ++tally.threw;
    return;
  }
  const auto value = [&] { return std::move(*outcome); }();
  ASSERT_FALSE(value.internal_error) << value.internal_error->message;
  ASSERT_LE(value.lower_bound, optimum);
  if (value.cost) {
    ASSERT_GE(*value.cost, optimum);
  }
  if (value.status == Status::optimal) {
    ASSERT_EQ(value.cost, optimum);
    ++tally.ended;
    return;
  }
  ASSERT_NE(value.status, Status::infeasible);
  ASSERT_EQ(value.stop, StopReason::memory);
  ASSERT_EQ(value.status, value.plan ? Status::feasible : Status::unknown);
  ++tally.stopped;
  tally.had_plan += value.plan ? 1 : 0;
}

template <class Instance, class Options>
Tally starve_everywhere(const Instance& instance, const Options& options, std::uint64_t seed) {
  Tally tally;
  fail_allocations(0, 0);
  const auto free = solve(instance, options).value();
  const std::int64_t all = stop_failing();
  EXPECT_EQ(free.status, Status::optimal);
  Random random(seed);
  const auto num_random = static_cast<int>(scaled(60));
  for (int round = 0; round < 30 + num_random; ++round) {
    const std::int64_t n =
        round < 30 ? 1 + round * 3
                   : 1 + static_cast<std::int64_t>(random.below(static_cast<std::uint64_t>(all)));
    for (const std::int64_t length : {std::int64_t{1}, std::int64_t{20}, kForGood}) {
      solve_starved(instance, options, *free.cost, n, length, tally);
      if (testing::Test::HasFatalFailure()) return tally;
    }
  }
  EXPECT_EQ(solve(instance, options).value().cost, free.cost);
  return tally;
}

void expect_stopped(const Tally& tally) {
  EXPECT_GT(tally.stopped, 20);
  std::printf("%d ended, %d stopped (%d with a plan), %d threw\n", tally.ended, tally.stopped,
              tally.had_plan, tally.threw);
}

TEST(Allocation, FailsInDiscreteSearches) {
  const auto instance = grid(6, 12, 5);
  for (const auto& options : discrete_systems())
    expect_stopped(starve_everywhere(instance, options, 1));
}

TEST(Allocation, FailsInContinuousSearches) {
  const auto instance = discs(10, 3, 3);
  for (const auto& options : continuous_systems())
    expect_stopped(starve_everywhere(instance, options, 2));
}

}  // namespace
}  // namespace quadrille::support
