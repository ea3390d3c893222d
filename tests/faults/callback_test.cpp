// SPDX-License-Identifier: MIT
// What a callback throws comes out of `solve`, whichever call it is, and does no harm.
#include <gtest/gtest.h>

#include "faults/instances.hpp"
#include "support/environment.hpp"

namespace quadrille::support {
namespace {

struct Thrown {
  int call;
};

/// Solves with a callback that throws at its k-th call. False if the search ended before that.
template <class Instance, class Options>
bool throws_at(const Instance& instance, Options options, int k) {
  int calls = 0;
  options.progress_interval_s = 0;
  options.limits.cpu_s = 5;
  options.on_progress = [&](const auto&) {
    if (++calls == k) throw Thrown{k};
    EXPECT_LT(calls, k) << "called after it had thrown";
  };
  try {
    static_cast<void>(solve(instance, options).value());
  } catch (const Thrown& thrown) {
    EXPECT_EQ(thrown.call, k);
    return true;
  }
  EXPECT_LT(calls, k) << "what was thrown was lost";
  return false;
}

template <class Instance, class Options>
void expect_thrown_at_each_call(const std::vector<Options>& systems, const Instance& hard,
                                const Instance& easy) {
  int num_thrown = 0, num_tried = 0;
  for (std::size_t i = 0; i < systems.size(); ++i) {
    SCOPED_TRACE(i);
    // Each of the first calls, and some of the later ones, from ever deeper inside.
    for (int k = 1; k <= 2000; k += k < 10 ? 1 : k / 3) {
      ++num_tried;
      if (!throws_at(hard, systems[i], k)) break;
      ++num_thrown;
    }
    EXPECT_EQ(solve(easy, systems[i]).value().status, Status::optimal);
  }
  EXPECT_GT(num_thrown, num_tried * 4 / 5);
}

TEST(Callback, ThrowsOutOfDiscreteSearches) {
  auto systems = discrete_systems();
  for (auto& options : systems)
    if (options.objective == Objective::makespan) options.first_plan = false;
  expect_thrown_at_each_call(systems, grid(12, 100, 1), grid(4, 3, 2));
}

TEST(Callback, ThrowsOutOfContinuousSearches) {
  expect_thrown_at_each_call(continuous_systems(), discs(25, 16, 4), discs(12, 3, 2));
}

}  // namespace
}  // namespace quadrille::support
