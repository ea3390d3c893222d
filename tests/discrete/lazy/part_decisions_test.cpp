// SPDX-License-Identifier: MIT
#include "lazy/part_decisions.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace quadrille::discrete {
namespace {

using sat::Lit;

Lit lit(int dimacs) { return Lit::from_dimacs(dimacs); }

Lit choose(const PartDecisions& decisions, const std::vector<Lit>& candidates) {
  return decisions.choose(candidates);
}

void tell(PartDecisions& decisions, const std::vector<Lit>& clause) {
  decisions.on_path_lemma(clause);
}

TEST(PartDecisions, TheFirstOfEqualsIsChosen) {
  PartDecisions decisions;
  EXPECT_FALSE(choose(decisions, {}).valid());
  EXPECT_EQ(choose(decisions, {lit(-7), lit(3)}), lit(-7));
  tell(decisions, {lit(3), lit(-7), lit(5)});
  EXPECT_EQ(choose(decisions, {lit(5), lit(-7), lit(3)}), lit(5));
}

TEST(PartDecisions, WhatLemmasMentionIsChosen) {
  PartDecisions decisions;
  tell(decisions, {lit(4)});
  EXPECT_EQ(choose(decisions, {lit(900), lit(4)}), lit(4));
  EXPECT_EQ(choose(decisions, {lit(900), lit(-4)}), lit(-4));  // the variable counts
}

TEST(PartDecisions, ALaterLemmaWeighsMore) {
  PartDecisions decisions;
  tell(decisions, {lit(1)});
  tell(decisions, {lit(2)});
  EXPECT_EQ(choose(decisions, {lit(1), lit(2)}), lit(2));
  tell(decisions, {lit(1)});
  EXPECT_EQ(choose(decisions, {lit(1), lit(2)}), lit(1));
}

// 1.05^14 < 2 < 1.05^15: two old mentions outweigh one that is 14 lemmas younger.
TEST(PartDecisions, AFewLemmasDoNotOutweighMoreMentions) {
  for (const int age : {14, 16}) {
    PartDecisions decisions;
    tell(decisions, {lit(1), lit(1)});
    for (int n = 1; n < age; ++n) tell(decisions, {});
    tell(decisions, {lit(2)});
    EXPECT_EQ(choose(decisions, {lit(1), lit(2)}), lit(age < 15 ? 1 : 2)) << age;
  }
}

// 1.05^14514 is more than any double: weights have to be scaled down together.
TEST(PartDecisions, RemembersOrderOverManyLemmas) {
  PartDecisions decisions;
  for (int n = 0; n < 20'000; ++n) tell(decisions, {lit(1 + n % 3)});
  tell(decisions, {lit(4)});
  EXPECT_EQ(choose(decisions, {lit(1), lit(2), lit(3)}), lit(2));  // told last
  // Sum of every third weight against the weight of the next lemma: 1 / (1.05^3 - 1) is more.
  EXPECT_EQ(choose(decisions, {lit(4), lit(2)}), lit(2));
}

}  // namespace
}  // namespace quadrille::discrete
