// SPDX-License-Identifier: MIT
#include "quadrille/solve/knowledge.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <new>
#include <optional>
#include <utility>
#include <vector>

namespace quadrille::solve {
namespace {

using Plan = int;  // What it is does not matter here.
using Known = Knowledge<Plan>;

Known with(Cost bound, std::optional<Cost> cost) {
  Known known;
  known.raise(bound);
  if (cost) known.take(std::make_shared<const Plan>(), *cost);
  known.stop = StopReason::wall_time;
  return known;
}
Known broken() {
  Known known = with(1000, std::nullopt);
  known.fail("a lemma is wrong");
  return known;
}
std::vector<Known> list(Known first, Known second) {
  std::vector<Known> all;
  all.push_back(std::move(first));
  all.push_back(std::move(second));
  return all;
}

TEST(Merged, AnInternalErrorIsSeenEvenBesideAProof) {
  EXPECT_TRUE(merged(list(broken(), with(7, 7)), 1).error);
  EXPECT_TRUE(merged(list(with(5, 9), broken()), std::nullopt).error);
}

TEST(Merged, TheWinnerIsTheAnswerAsItIs) {
  const Known answer = merged(list(with(6, 6), with(5, 7)), 1);
  EXPECT_EQ(answer.cost, 7);
  EXPECT_EQ(answer.lower(), 5);
}

TEST(Merged, TheCheapestPlanAndTheLargestBoundAreTaken) {
  Known first = with(5, 10);
  first.prove(6);
  const Known answer = merged(list(std::move(first), with(4, 9)), std::nullopt);
  EXPECT_EQ(answer.cost, 9);
  EXPECT_EQ(answer.raised, 5);
  EXPECT_EQ(answer.floor, 6);
  EXPECT_EQ(merged(list(with(9, 9), with(8, std::nullopt)), std::nullopt).lower(), 9);
}

// Who makes plans ends because the others do: what ended these ended the solve.
TEST(Merged, SomebodySaysWhatEndedIt) {
  Known second = with(4, 9);
  second.stop = StopReason::none;
  Known first = with(5, 10);
  first.why_open = "too far";
  const Known answer = merged(list(std::move(first), std::move(second)), std::nullopt);
  EXPECT_EQ(answer.cost, 9);
  EXPECT_EQ(answer.stop, StopReason::wall_time);
  EXPECT_EQ(answer.why_open, "too far");
}

TEST(Merged, StatisticsAreOfTheFirstUnlessTheWinnerSearched) {
  for (const bool has_searched : {false, true}) {
    Known first = with(5, 9), second = with(7, 7);
    first.statistics.sat_calls = 3;
    second.statistics.sat_calls = has_searched ? 4 : 0;
    const Known answer = merged(list(std::move(first), std::move(second)), 1);
    EXPECT_EQ(answer.statistics.sat_calls, has_searched ? 4 : 3);
  }
}

TEST(Merged, APlanThatRefutesAClaimComesFirst) {
  Known first = broken(), second = with(5, 7);
  second.claimed = 8;
  const Known answer = merged(list(std::move(first), std::move(second)), std::nullopt);
  EXPECT_FALSE(answer.error);
  EXPECT_EQ(answer.cost, 7);
}

TEST(RunGuarded, WhatEndsAPartOfASolveIsKnown) {
  LimitMonitor limits{Limits{}};
  Known known = with(5, 9);
  known.stop = StopReason::none;
  run_guarded(known, limits, [] {});
  EXPECT_EQ(known.stop, StopReason::none);
  run_guarded(known, limits, [&] {
    limits.stop(StopReason::conflicts);
    throw LimitReached{};
  });
  EXPECT_EQ(known.stop, StopReason::conflicts);
  run_guarded(known, limits, [] { throw std::bad_alloc(); });
  EXPECT_EQ(known.stop, StopReason::memory);
  EXPECT_EQ(known.cost, 9);
  EXPECT_THROW(run_guarded(known, limits, [] { throw 7; }), int);
}

}  // namespace
}  // namespace quadrille::solve
