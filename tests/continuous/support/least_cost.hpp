// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include "quadrille/continuous/solver.hpp"
#include "quadrille/continuous/verify.hpp"

namespace quadrille::continuous::test {

/// What the system finds to be the optimal cost, with the searches that come first and without, by
/// a valid plan; -1, and a failure, if it does not.
inline Cost least_cost(const Instance& instance, System system, Objective objective) {
  SolveOptions options;
  options.system = system;
  options.objective = objective;
  options.limits.cpu_s = 20;
  const SolveOutcome outcome = solve(instance, options).value();
  EXPECT_EQ(outcome.status, Status::optimal) << outcome.explanation;
  if (!outcome.plan) return -1;
  EXPECT_TRUE(verify(instance, *outcome.plan).valid());
  options.joint_work = 0;
  EXPECT_EQ(solve(instance, options).value().cost, outcome.cost);
  options.route_work = 0;
  EXPECT_EQ(solve(instance, options).value().cost, outcome.cost);
  return *outcome.cost;
}

}  // namespace quadrille::continuous::test
