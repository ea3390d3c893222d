// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <cstdint>

#include "quadrille/core/attribution.hpp"
#include "quadrille/core/outcome.hpp"

// Instances that begin later than at 0, in both domains: the answer is that of the same instance
// begun at 0, but for the times of the plan. What is asked, and how answers are compared.
namespace quadrille::support {

template <class Options>
Options options_for(std::uint32_t seed) {
  Options options;
  options.objective = seed % 3 == 0 ? Objective::makespan : Objective::sum_of_costs;
  options.limits.conflicts = 300;
  options.explain = seed % 2 == 0;
  options.debug.audit = seed % 4 == 0;
  return options;
}

template <class Outcome>
void expect_same(const Outcome& from_0, const Outcome& later, Cost now) {
  ASSERT_FALSE(later.internal_error) << later.internal_error->message;
  EXPECT_EQ(later.status, from_0.status);
  EXPECT_EQ(later.cost, from_0.cost);
  EXPECT_EQ(later.lower_bound, from_0.lower_bound);
  EXPECT_EQ(later.statistics.conflicts, from_0.statistics.conflicts);
  ASSERT_EQ(later.attribution.has_value(), from_0.attribution.has_value());
  if (!later.attribution) return;
  const auto &a = from_0.attribution->sites, &b = later.attribution->sites;
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) {
    EXPECT_EQ(b[k].begin, a[k].begin + now);
    EXPECT_EQ(b[k].end, a[k].end == CollisionSite::kForever ? a[k].end : a[k].end + now);
  }
}

}  // namespace quadrille::support
