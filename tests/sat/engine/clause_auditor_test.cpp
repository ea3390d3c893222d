// SPDX-License-Identifier: MIT
#include "quadrille/sat/clause_auditor.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace quadrille::sat {
namespace {

Lit lit(int dimacs) { return Lit::from_dimacs(dimacs); }

/// Of a domain that believes every lemma. In its known plan the variables 1 and 2 are true, 3 and 4
/// are false, and all others are auxiliary.
class PlainAuditor final : public ClauseAuditor {
 public:
  PlainAuditor(bool derive, bool has_known_plan) : ClauseAuditor(derive, has_known_plan) {}
  void tell(const Why& why, const std::vector<int>& clause) {
    on_lemma({why, lits(clause), {}, false});
  }
  void tell_core(const std::vector<int>& clause) { on_core(lits(clause)); }
  void tell_learned(const std::vector<int>& clause) { on_learned(lits(clause)); }

 private:
  std::span<const Lit> lits(const std::vector<int>& clause) {
    lits_.clear();
    for (const int l : clause) lits_.push_back(lit(l));
    return lits_;
  }
  std::string audit(const Lemma&) override { return ""; }
  std::optional<bool> find_in_plan(Lit l) const override {
    if (l.variable() > 4) return std::nullopt;
    return (l.variable() <= 2) == l.positive();
  }
  std::string describe(Clause clause) const override {
    std::string text;
    for (const Lit l : clause) text += " " + std::to_string(l.dimacs());
    return text;
  }

  std::vector<Lit> lits_;
};

constexpr bool kDerives = true, kHasPlan = true;

TEST(ClauseAuditor, ProvesTheCoresOfRefutations) {
  PlainAuditor auditor(kDerives, !kHasPlan);
  auditor.tell(why::Path{}, {1, 2});
  auditor.tell(why::Vertex{}, {-1, 3});
  auditor.tell_core({2, 3});
  EXPECT_EQ(auditor.complaint(), std::nullopt);
  auditor.tell_core({3});
  EXPECT_EQ(auditor.complaint(), "a core does not follow from the clauses: 3");
  auditor.tell_core({2});
  EXPECT_EQ(auditor.complaint(), "a core does not follow from the clauses: 3") << "the first one";
}

TEST(ClauseAuditor, ProvesCoresWithoutLiterals) {
  PlainAuditor auditor(kDerives, !kHasPlan), other(kDerives, !kHasPlan);
  for (PlainAuditor* a : {&auditor, &other}) {
    a->tell(why::Path{}, {1, 2});
    a->tell(why::Vertex{}, {-1});
  }
  auditor.tell(why::Vertex{}, {-2});
  auditor.tell_core({});
  EXPECT_EQ(auditor.complaint(), std::nullopt);
  other.tell_core({});
  EXPECT_EQ(other.complaint(), "a core does not follow from the clauses:");
}

TEST(ClauseAuditor, HoldsAllAgainstTheKnownPlan) {
  for (int what = 0; what < 4; ++what) {
    SCOPED_TRACE(what);
    PlainAuditor auditor(!kDerives, kHasPlan);
    const auto tell = [&](const std::vector<int>& clause) {
      if (what == 0) auditor.tell(why::Path{}, clause);
      if (what == 1) auditor.tell(why::Core{}, clause);
      if (what == 2) auditor.tell_learned(clause);
      if (what == 3) auditor.tell_core(clause);
    };
    tell({3, 2});
    tell({-4});
    EXPECT_EQ(auditor.complaint(), std::nullopt);
    tell({3, -2});
    ASSERT_TRUE(auditor.complaint());
    EXPECT_NE(auditor.complaint()->find("excludes the known plan: 3 -2"), std::string::npos);
  }
}

TEST(ClauseAuditor, TheKnownPlanExcludesThatThereIsNone) {
  PlainAuditor auditor(!kDerives, kHasPlan);
  auditor.tell_core({});
  EXPECT_EQ(auditor.complaint(), "a core excludes the known plan:");
}

TEST(ClauseAuditor, CountersAreAsLowAsTheirDefinitionsAllow) {
  PlainAuditor auditor(!kDerives, kHasPlan);
  auditor.tell(why::Counter{}, {-1, -3, 5});  // input 3 is false: 5 may be false
  auditor.tell(why::Counter{}, {-1, -2, 6});  // both inputs are true
  auditor.tell(why::Counter{}, {-6, 7});
  auditor.tell_core({-5});
  auditor.tell_core({6});
  auditor.tell_core({7});
  EXPECT_EQ(auditor.complaint(), std::nullopt);
  auditor.tell_core({5, -6, -7});
  EXPECT_EQ(auditor.complaint(), "a core excludes the known plan: 5 -6 -7");
}

}  // namespace
}  // namespace quadrille::sat
