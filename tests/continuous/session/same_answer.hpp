// SPDX-License-Identifier: MIT
//
// Whether a session and a solve that knows nothing say the same.
#pragma once

#include <gtest/gtest.h>

#include "quadrille/continuous/solver.hpp"
#include "quadrille/continuous/verify.hpp"

namespace quadrille::continuous::test {

struct Tally {
  int optimal = 0, infeasible = 0, refused = 0, open = 0, without_search = 0;
  /// Solves with lemmas about collisions that never looked for any.
  int from_lemmas = 0;
};

inline void expect_equal(const Instance& instance, const SolveOptions& options,
                         const SolveOutcome& warm, const SolveOutcome& cold, Tally& tally) {
  ASSERT_FALSE(warm.internal_error) << warm.internal_error->message;
  ASSERT_FALSE(cold.internal_error) << cold.internal_error->message;
  if (warm.plan) {
    ASSERT_TRUE(verify(instance, *warm.plan).valid());
    ASSERT_EQ(cost(*warm.plan, options.objective), *warm.cost);
  }
  const bool are_proofs = [](Status a, Status b) {
    const auto is_proof = [](Status s) { return s == Status::optimal || s == Status::infeasible; };
    return is_proof(a) && is_proof(b);
  }(warm.status, cold.status);
  if (!are_proofs) {  // a limit
    ++tally.open;
    if (warm.cost) {
      ASSERT_GE(*warm.cost, cold.lower_bound);
    }
    if (cold.cost) {
      ASSERT_LE(warm.lower_bound, *cold.cost);
    }
    return;
  }
  ASSERT_EQ(warm.status, cold.status) << warm.explanation << cold.explanation;
  ASSERT_EQ(warm.cost, cold.cost);
  ++(warm.status == Status::optimal ? tally.optimal : tally.infeasible);
  if (warm.statistics.sat_calls < cold.statistics.sat_calls) ++tally.without_search;
  if (warm.statistics.collision_clauses > 0 && warm.statistics.checks == 0) ++tally.from_lemmas;
}

}  // namespace quadrille::continuous::test
