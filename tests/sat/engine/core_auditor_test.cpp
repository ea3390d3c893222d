// SPDX-License-Identifier: MIT
#include "quadrille/sat/core_auditor.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace quadrille::sat {
namespace {

Lit lit(int dimacs) { return Lit::from_dimacs(dimacs); }

void tell(CoreAuditor& auditor, const Why& why, const std::vector<Lit>& clause) {
  auditor.on_lemma({why, clause, {}, false});
}

TEST(CoreAuditor, ProvesWhatFollowsAndNothingElse) {
  CoreAuditor auditor;
  tell(auditor, why::Path{}, {lit(1), lit(2)});
  tell(auditor, why::Vertex{}, {lit(-2), lit(3)});
  tell(auditor, why::Core{}, {lit(1), lit(3)});
  EXPECT_EQ(auditor.complaint(), std::nullopt);
  EXPECT_EQ(auditor.num_proved(), 1);
  tell(auditor, why::Core{}, {lit(-2), lit(4)});
  EXPECT_EQ(auditor.complaint(), "a core does not follow from the clauses: -2 4");
  EXPECT_EQ(auditor.num_proved(), 1);
}

TEST(CoreAuditor, ClausesThatComeLaterProveNothing) {
  CoreAuditor auditor;
  tell(auditor, why::Core{}, {lit(1)});
  tell(auditor, why::Path{}, {lit(1)});
  EXPECT_TRUE(auditor.complaint());
}

TEST(CoreAuditor, CoresHoldUnderWhatIsAssumed) {
  CoreAuditor auditor;
  tell(auditor, why::Path{}, {lit(1), lit(2), lit(3)});
  auditor.assume({lit(-3)});
  tell(auditor, why::Core{}, {lit(1), lit(2)});
  EXPECT_EQ(auditor.complaint(), std::nullopt);
  auditor.assume({});
  auditor.audit({});  // nothing contradicts
  EXPECT_TRUE(auditor.complaint());
}

TEST(CoreAuditor, CoresOfRefutationsHoldWithNothingAssumed) {
  CoreAuditor auditor;
  tell(auditor, why::Path{}, {lit(1), lit(2), lit(3)});
  auditor.assume({lit(-3)});
  auditor.on_core(std::vector<Lit>{lit(1), lit(2), lit(3)});
  EXPECT_EQ(auditor.complaint(), std::nullopt);
  EXPECT_EQ(auditor.num_proved(), 1);
  auditor.on_core(std::vector<Lit>{lit(1), lit(2)});
  EXPECT_EQ(auditor.complaint(), "a core does not follow from the clauses: 1 2");
}

TEST(CoreAuditor, LeavesOpenWhatTakesLong) {
  // Five pigeons, four holes: pigeon p is in hole h if 4 p + h + 1 is true.
  for (const int max_conflicts : {1, CoreAuditor::kMaxConflicts}) {
    CoreAuditor auditor(max_conflicts);
    for (int p = 0; p < 5; ++p)
      tell(auditor, why::Path{}, {lit(4 * p + 1), lit(4 * p + 2), lit(4 * p + 3), lit(4 * p + 4)});
    for (int h = 1; h <= 4; ++h)
      for (int p = 0; p < 5; ++p)
        for (int q = 0; q < p; ++q)
          tell(auditor, why::Vertex{}, {lit(-4 * p - h), lit(-4 * q - h)});
    auditor.audit({});
    EXPECT_EQ(auditor.complaint(), std::nullopt);
    EXPECT_EQ(auditor.num_open(), max_conflicts == 1 ? 1 : 0);
    EXPECT_EQ(auditor.num_proved(), max_conflicts == 1 ? 0 : 1);
  }
}

}  // namespace
}  // namespace quadrille::sat
