// SPDX-License-Identifier: MIT
#include "quadrille/lazy/recorder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace quadrille::lazy {
namespace {

using sat::Lit;
using testing::ElementsAre;
using testing::IsEmpty;

constexpr AgentId kA(0), kB(1), kC(2), kD(3);
constexpr std::size_t kNumAgents = 4;

class Words final : public Vocabulary {
 public:
  Words() : Vocabulary(kNumAgents, Costs::positive) {}
  [[nodiscard]] Cost free_cost(AgentId /*agent*/) const override { return 0; }
  void keep_off(AgentId agent, AgentId resident, FormulaWriter& writer) {
    static_cast<void>(goal_obstacle(agent, {resident, VertexId(3), 5}, writer,
                                    [](Lit) { return ObstacleId(std::size_t{9}); }));
  }
};

class NumberingWriter final : public FormulaWriter {
 public:
  [[nodiscard]] Lit new_lit() override { return Lit::from_dimacs(++last_); }
  void add(const sat::Lemma& /*lemma*/) override {}

 private:
  int last_ = 0;
};

class RecorderTest : public testing::Test {
 protected:
  void tell(const sat::Why& why, const std::vector<AgentId>& agents,
            const std::vector<Lit>& clause = {}) {
    std::vector<sat::Usage> usages;
    for (const AgentId i : agents) usages.push_back({i, 0});
    recorder_.on_lemma({why, clause, usages, false});
  }
  [[nodiscard]] std::vector<AgentId> bystanders(std::vector<AgentId> agents,
                                                bool has_plan = true) const {
    Raise raise{RaiseKind::core, 1, std::move(agents), {}};
    recorder_.dependence(has_plan).add_bystanders(raise);
    return raise.bystanders;
  }

  Words words_;
  NumberingWriter writer_;
  Recorder recorder_{words_, kNumAgents, nullptr};
};

TEST_F(RecorderTest, WhoIsLetOffForAHighCostDoesNotCount) {
  tell(sat::why::Vertex{}, {kA, kB});
  tell(sat::why::Path{kB}, {kB}, {words_.at_least(kB, 3, writer_)});
  EXPECT_THAT(bystanders({kA}), IsEmpty());
  // The cost of somebody else is none of its own.
  tell(sat::why::Path{kB}, {kB}, {words_.at_least(kA, 3, writer_)});
  EXPECT_THAT(bystanders({kA}), ElementsAre(kB));
  EXPECT_THAT(bystanders({kC}), IsEmpty());
}

TEST_F(RecorderTest, CollisionsLinkWhomeverTheyAreAbout) {
  for (const AgentId i : {kA, kB, kC, kD}) tell(sat::why::ExplicitPath{i}, {});
  EXPECT_THAT(bystanders({kA}), IsEmpty());
  tell(sat::why::Rectangle{kA, kB}, {kA, kB, kA});
  EXPECT_THAT(bystanders({kA}), ElementsAre(kB));
  tell(sat::why::Pair{kC, kD}, {});
  EXPECT_THAT(bystanders({kC}), ElementsAre(kD));
  words_.keep_off(kB, kC, writer_);
  EXPECT_THAT(bystanders({kA}), ElementsAre(kB, kC, kD));
}

TEST_F(RecorderTest, WhoIsSilentInARectangleCountsForTheOther) {
  tell(sat::why::Rectangle{kB, kA}, {kA, kA});
  EXPECT_THAT(bystanders({kA}), ElementsAre(kB));
  EXPECT_THAT(bystanders({kB}), IsEmpty());
  EXPECT_THAT(bystanders({kC}), IsEmpty());
}

TEST_F(RecorderTest, CeilingsCountEverywhere) {
  tell(sat::why::Ceiling{kD}, {});
  EXPECT_THAT(bystanders({kA}), ElementsAre(kD));
}

TEST_F(RecorderTest, WithoutAPlanAllCountWhoAreNotLetOff) {
  tell(sat::why::ExplicitPath{kC}, {});
  EXPECT_THAT(bystanders({kA}, true), IsEmpty());
  EXPECT_THAT(bystanders({kA}, false), ElementsAre(kC));
}

TEST_F(RecorderTest, CollisionsComeBackInTheirOrder) {
  tell(sat::why::Corridor{VertexId(4)}, {kA, kC});
  tell(sat::why::Order{kA}, {});
  tell(sat::why::Rectangle{kA, kB}, {kB, kA, kB});
  std::vector<std::size_t> kinds, sizes;
  recorder_.for_each_collision([&](const sat::Why& why, std::span<const sat::Usage> usages) {
    kinds.push_back(why.index());
    sizes.push_back(usages.size());
  });
  EXPECT_THAT(kinds, ElementsAre(sat::Why(sat::why::Corridor{}).index(),
                                 sat::Why(sat::why::Rectangle{}).index()));
  EXPECT_THAT(sizes, ElementsAre(2U, 3U));
}

}  // namespace
}  // namespace quadrille::lazy
