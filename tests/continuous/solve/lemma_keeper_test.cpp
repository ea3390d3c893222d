// SPDX-License-Identifier: MIT
// Lemmas go from one model to another and back, and say the same.
#include "solve/lemma_keeper.hpp"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "continuous/support/roads.hpp"
#include "theory/lemma_auditor.hpp"

namespace quadrille::continuous::test {
namespace {

using Kind = LemmaStock::Kind;

constexpr AgentId kA(0), kB(1);
constexpr EdgeId kThere(0);

/// Tells an observer what a solver would be told.
class Teller final : public FormulaWriter {
 public:
  explicit Teller(sat::ClauseObserver& observer) : observer_(observer) {}
  [[nodiscard]] sat::Lit new_lit() override { return sat::Lit::from_dimacs(++last_); }
  void add(const sat::Lemma& lemma) override { observer_.on_lemma(lemma); }

 private:
  sat::ClauseObserver& observer_;
  int last_ = 0;
};

/// Vertices in a row, and a way round from the first to the last one. Two that want to change
/// places, 2,000 ticks apart; the way round takes 2,828.
Instance swap() {
  return Instance::make(roadmap({{0, 0}, {1000, 0}, {2000, 0}, {1000, 1000}},
                                {{0, 1}, {1, 2}, {0, 3}, {3, 2}}),
                        {agent(0, 2, 100), agent(2, 0, 100)})
      .value();
}

/// A model whose lemmas are kept and audited.
struct Bench {
  explicit Bench(Instance of = swap()) : instance(std::move(of)) {}
  Instance instance;
  LimitMonitor limits{{}};
  Scene scene{instance, limits};
  Model model{scene};
  LemmaAuditor auditor{model, true, std::nullopt};
  LemmaKeeper keeper{model, &auditor};
  Teller teller{keeper};
};

/// Of each kind one. The first agent may not set out along the row for long.
LemmaStock stock() {
  LemmaStock stock;
  const auto back = swap().roadmap().out_edges(VertexId(1)).front();
  stock.obstacles = {{kA, {Ban::start(kThere, {100, 101}), Ban::start(kThere, {0, 9000})}, {kB}},
                     {kB, {Ban::start(back, {100, 101})}, {kA}},
                     {kA, {}, {}, LemmaStock::Obstacle::Goal{kB, VertexId(0), 2001}}};
  stock.lemmas = {{Kind::path, {{kA, 2828}}, {0}},
                  {Kind::path, {{kA, 2300}}, {0, 2}},
                  {Kind::pair, {{kA, 2101}, {kB, 2101}}, {1}}};
  return stock;
}

TEST(LemmaKeeper, LemmasSayTheSameInAnotherModel) {
  Bench bench;
  ASSERT_EQ(take_up(stock(), bench.model, bench.teller), 3U);
  EXPECT_FALSE(bench.auditor.complaint()) << *bench.auditor.complaint();
  const LemmaStock left = bench.keeper.stock(), given = stock();
  ASSERT_EQ(left.lemmas.size(), 3U);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(left.lemmas[k].kind, given.lemmas[k].kind);
    EXPECT_EQ(left.lemmas[k].levels, given.lemmas[k].levels);
    ASSERT_EQ(left.lemmas[k].obstacles.size(), given.lemmas[k].obstacles.size());
    for (std::size_t o = 0; o < left.lemmas[k].obstacles.size(); ++o) {
      const auto& one = left.obstacles[left.lemmas[k].obstacles[o]];
      const auto& other = given.obstacles[given.lemmas[k].obstacles[o]];
      EXPECT_EQ(one.agent, other.agent);
      EXPECT_EQ(one.partners, other.partners);
      EXPECT_EQ(one.goal.has_value(), other.goal.has_value());
      ASSERT_EQ(one.bans.size(), other.bans.size());
      // The cause stays the first one.
      if (!one.bans.empty()) {
        EXPECT_EQ(one.bans.front(), other.bans.front());
      }
      if (one.goal && other.goal) {
        EXPECT_EQ(one.goal->resident, other.goal->resident);
        EXPECT_EQ(one.goal->vertex, other.goal->vertex);
        EXPECT_EQ(one.goal->from, other.goal->from);
      }
    }
  }
}

TEST(LemmaKeeper, WhereSomebodyWithAChoiceRestsIsKept) {
  std::vector<Agent> agents{agent(0, 2, 100), agent(2, 0, 100)};
  agents[1].goals = Goals({VertexId(0), VertexId(1)});
  Bench bench(Instance::make(swap().shared_roadmap(), std::move(agents)).value());
  LemmaStock given = stock();
  given.lemmas = {{Kind::path, {{kA, 2300}}, {0, 2}}};
  ASSERT_EQ(take_up(given, bench.model, bench.teller), 1U);
  EXPECT_FALSE(bench.auditor.complaint()) << *bench.auditor.complaint();
  const LemmaStock left = bench.keeper.stock();
  ASSERT_EQ(left.lemmas.size(), 1U);
  EXPECT_EQ(left.lemmas[0].levels, given.lemmas[0].levels);
  const auto& goal = left.obstacles[left.lemmas[0].obstacles[1]].goal;
  ASSERT_TRUE(goal);
  EXPECT_EQ(goal->resident, kB);
  EXPECT_EQ(goal->vertex, VertexId(0));
  EXPECT_EQ(goal->from, Ticks{2001});
}

TEST(LemmaKeeper, WhatIsDoubtfulIsLookedAtAgain) {
  LemmaStock doubtful = stock();
  doubtful.lemmas = {{Kind::path, {}, {0}, true}, {Kind::path, {}, {1}, true}};
  Bench bench;
  // The other agent loses nothing by a ban of one tick at which it cannot be there.
  EXPECT_EQ(take_up(doubtful, bench.model, bench.teller), 1U);
  EXPECT_FALSE(bench.auditor.complaint()) << *bench.auditor.complaint();
  const LemmaStock left = bench.keeper.stock();
  ASSERT_EQ(left.lemmas.size(), 1U);
  EXPECT_EQ(left.lemmas[0].levels, (std::vector<Level>{{kA, 2828}}));
  EXPECT_FALSE(left.lemmas[0].is_doubtful);
}

TEST(LemmaKeeper, WhoCannotCostLessNeedsNoLemma) {
  LemmaStock plain = stock();
  plain.lemmas = {{Kind::path, {{kA, 2000}}, {0}}, {Kind::pair, {{kA, 2101}, {kB, 1900}}, {1}}};
  Bench bench;
  EXPECT_EQ(take_up(plain, bench.model, bench.teller), 0U);
  plain = stock();
  plain.obstacles[2].goal->from = 2000;
  EXPECT_EQ(take_up(plain, bench.model, bench.teller), 2U);
}

TEST(LemmaKeeper, TheOldestGoFirst) {
  Bench bench;
  LemmaStock many = stock();
  many.lemmas.assign(1, many.lemmas[1]);
  many.lemmas.resize(2 * LemmaKeeper::kMostLemmas + 10, stock().lemmas[0]);
  take_up(many, bench.model, bench.teller);
  const LemmaStock left = bench.keeper.stock();
  EXPECT_EQ(left.lemmas.size(), LemmaKeeper::kMostLemmas);
  EXPECT_EQ(left.obstacles.size(), 1U);
}

}  // namespace
}  // namespace quadrille::continuous::test
