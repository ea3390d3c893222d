// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "continuous/support/roads.hpp"
#include "theory/lemma_auditor.hpp"

namespace quadrille::continuous::test {
namespace {

using sat::Lit;
using testing::HasSubstr;

class NumberingWriter final : public FormulaWriter {
 public:
  [[nodiscard]] Lit new_lit() override { return Lit::from_dimacs(++last_); }
  void add(const sat::Lemma& /*lemma*/) override {}

 private:
  int last_ = 0;
};

/// Two agents on roads of their own. In the known plan agent 0 waits for 5 ticks and arrives at
/// 1005, agent 1 arrives at 1000.
class KnownPlanAudit : public testing::Test {
 protected:
  /// What is said of a single clause.
  std::optional<std::string> complaint(const std::vector<Lit>& clause) {
    LemmaAuditor auditor(model_, false, plan_);
    auditor.on_lemma({sat::why::Path{}, clause, {}, false});
    LemmaAuditor of_learned(model_, false, plan_);
    of_learned.on_learned(clause);
    EXPECT_EQ(auditor.complaint().has_value(), of_learned.complaint().has_value());
    return auditor.complaint();
  }
  Lit at_least(std::size_t agent, Cost cost) {
    return model_.at_least(AgentId(agent), cost, writer_);
  }
  Lit start_within(std::size_t agent, Ticks begin, Ticks end) {
    bool is_new = false;
    const ObstacleId id = model_.usage(AgentId(agent), {Ban::start(EdgeId(agent), {begin, end})},
                                       AgentId(1 - agent), writer_, is_new);
    return model_.obstacles()[id].allowed;
  }

  const Instance instance_ =
      Instance::make(roadmap({{0, 0}, {1000, 0}, {0, 90}, {1000, 90}}, {}, {{0, 1}, {2, 3}}),
                     {agent(0, 1, 3), agent(2, 3, 3)})
          .value();
  LimitMonitor limits_{{}};
  Scene scene_{instance_, limits_};
  Model model_{scene_};
  NumberingWriter writer_;
  const Plan plan_{{{{VertexId(0), 0, 5}, {VertexId(1), 1005, 1005}},
                    {{VertexId(2), 0, 0}, {VertexId(3), 1000, 1000}}}};
};

TEST_F(KnownPlanAudit, CostsAreThoseOfThePlan) {
  EXPECT_FALSE(complaint({at_least(0, 1005)}));
  EXPECT_FALSE(complaint({~at_least(0, 1006)}));
  EXPECT_TRUE(complaint({at_least(0, 1006)}));
  EXPECT_TRUE(complaint({~at_least(0, 1005)}));
  EXPECT_TRUE(complaint({at_least(1, 1005)}));
}

TEST_F(KnownPlanAudit, UsagesAreThoseOfThePlan) {
  EXPECT_FALSE(complaint({start_within(0, 5, 6)}));
  EXPECT_FALSE(complaint({~start_within(0, 6, 9)}));
  EXPECT_TRUE(complaint({~start_within(0, 5, 6)}));
  EXPECT_TRUE(complaint({start_within(0, 0, 5)}));
  EXPECT_TRUE(complaint({start_within(1, 5, 6)}));
}

TEST_F(KnownPlanAudit, OneTrueLiteralIsEnough) {
  EXPECT_FALSE(complaint({at_least(0, 1006), start_within(0, 5, 6)}));
  EXPECT_TRUE(complaint({at_least(0, 1006), start_within(0, 6, 9)}));
  EXPECT_TRUE(complaint({at_least(0, 1006), Lit::from_dimacs(999)}));  // not of the model
}

TEST_F(KnownPlanAudit, TheFirstWrongClauseIsNamed) {
  LemmaAuditor auditor(model_, false, plan_);
  const Lit wrong = at_least(0, 1006), other = at_least(1, 1001);
  auditor.on_learned(std::vector<Lit>{wrong, other});
  const auto first = auditor.complaint();
  ASSERT_TRUE(first);
  EXPECT_THAT(*first,
              HasSubstr("a learned clause excludes the known plan: " +
                        std::to_string(wrong.dimacs()) + " " + std::to_string(other.dimacs())));
  auditor.on_learned(std::vector<Lit>{other});
  EXPECT_EQ(auditor.complaint(), first);
}

}  // namespace
}  // namespace quadrille::continuous::test
