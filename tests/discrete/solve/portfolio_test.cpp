// SPDX-License-Identifier: MIT
#include "quadrille/core/portfolio.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <utility>
#include <vector>

#include "quadrille/discrete/solver.hpp"

namespace quadrille::discrete {
namespace {

SolveOutcome optimal(Cost cost) {
  SolveOutcome outcome;
  outcome.status = Status::optimal;
  outcome.cost = outcome.lower_bound = cost;
  return outcome;
}
SolveOutcome feasible(Cost cost, Cost bound) {
  SolveOutcome outcome;
  outcome.status = Status::feasible;
  outcome.stop = StopReason::wall_time;
  outcome.explanation = "stopped";
  outcome.cost = cost;
  outcome.lower_bound = bound;
  return outcome;
}
SolveOutcome only_bound(Cost bound) {
  SolveOutcome outcome;
  outcome.stop = StopReason::wall_time;
  outcome.lower_bound = bound;
  return outcome;
}
SolveOutcome broken() {
  SolveOutcome outcome;
  outcome.internal_error = Error{ErrorCode::internal, "a lemma is wrong", {}};
  outcome.lower_bound = 1000;
  return outcome;
}
std::vector<SolveOutcome> list(SolveOutcome first, SolveOutcome second) {
  std::vector<SolveOutcome> outcomes;
  outcomes.push_back(std::move(first));
  outcomes.push_back(std::move(second));
  return outcomes;
}

TEST(Portfolio, AnInternalErrorIsNoProof) {
  EXPECT_FALSE(is_proof(broken()));
  EXPECT_TRUE(is_proof(optimal(3)));
  EXPECT_FALSE(is_proof(feasible(5, 4)));
  SolveOutcome close = feasible(5, 4);
  close.stop = StopReason::gap;
  EXPECT_TRUE(is_proof(close));
}

TEST(Portfolio, AnInternalErrorIsSeenEvenBesideAProof) {
  const SolveOutcome answer = combine(list(broken(), optimal(7)), 1, std::nullopt);
  EXPECT_TRUE(answer.internal_error);
  EXPECT_EQ(answer.status, Status::unknown);
}

TEST(Portfolio, TheWinnerIsTheAnswer) {
  const SolveOutcome answer = combine(list(feasible(7, 5), optimal(7)), 1, std::nullopt);
  EXPECT_EQ(answer.status, Status::optimal);
  EXPECT_EQ(answer.cost, 7);
}

TEST(Portfolio, WithoutAProofAnInternalErrorIsSeen) {
  const SolveOutcome answer = combine(list(feasible(9, 5), broken()), std::nullopt, std::nullopt);
  EXPECT_TRUE(answer.internal_error);
  EXPECT_EQ(answer.status, Status::unknown);
}

TEST(Portfolio, BoundsAreMerged) {
  const SolveOutcome answer =
      combine(list(feasible(9, 5), only_bound(8)), std::nullopt, std::nullopt);
  EXPECT_EQ(answer.status, Status::feasible);
  EXPECT_EQ(answer.cost, 9);
  EXPECT_EQ(answer.lower_bound, 8);
  EXPECT_EQ(answer.stop, StopReason::wall_time);
}

TEST(Portfolio, MergedBoundsThatMeetAreAProofWithoutStop) {
  const SolveOutcome answer =
      combine(list(feasible(9, 5), only_bound(9)), std::nullopt, std::nullopt);
  EXPECT_EQ(answer.status, Status::optimal);
  EXPECT_EQ(answer.stop, StopReason::none);
  EXPECT_EQ(answer.explanation, "");
}

TEST(Portfolio, MergedBoundsAreTestedAgainstTheGap) {
  EXPECT_EQ(combine(list(feasible(10, 5), only_bound(8)), std::nullopt, 25).stop, StopReason::gap);
  EXPECT_EQ(combine(list(feasible(10, 5), only_bound(7)), std::nullopt, 25).stop,
            StopReason::wall_time);
}

TEST(Portfolio, TheCheapestPlanIsTaken) {
  const SolveOutcome answer =
      combine(list(feasible(10, 5), feasible(9, 4)), std::nullopt, std::nullopt);
  EXPECT_EQ(answer.cost, 9);
  EXPECT_EQ(answer.lower_bound, 5);
}

TEST(Portfolio, BoundsThatCrossAreAnInternalError) {
  const SolveOutcome answer =
      combine(list(feasible(10, 5), only_bound(11)), std::nullopt, std::nullopt);
  EXPECT_TRUE(answer.internal_error);
  EXPECT_EQ(answer.status, Status::unknown);
  EXPECT_FALSE(answer.cost);
}

}  // namespace
}  // namespace quadrille::discrete
