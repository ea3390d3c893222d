// SPDX-License-Identifier: MIT
#include "cost/core_minimiser.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "quadrille/core/random.hpp"

namespace quadrille::sat {
namespace {

/// Nothing but literals: the minimiser needs of a problem only to hear of its solves.
class NoProblem final : public CostProblem {
 public:
  std::size_t num_agents() const override { return 0; }
  Cost free_cost(AgentId) const override { return 0; }
  bool grow_to(AgentId, Cost, LimitMonitor&) override { return true; }
  Lit cost_above(AgentId, Cost) override { return {}; }
  Cost lower_bound() const override { return 0; }
  bool assume_at_most(Cost, LimitMonitor&, std::vector<Lit>&) override { return false; }
  Cost next_bound(Cost, std::span<const Lit>) override { return 0; }
  void on_solve(bool all_present) override {
    EXPECT_FALSE(all_present) << "agents of dropped assumptions are absent";
    ++num_solves;
  }
  bool accept_model() override {
    ADD_FAILURE() << "models of parts are no plans";
    return false;
  }
  int num_solves = 0;
};

class NoBounds final : public Bounds {
 public:
  std::optional<Cost> upper() const override { return std::nullopt; }
  Cost incumbent_cost_of(AgentId) const override { return 0; }
  void offer_accepted() override {}
};

const Settings kSettings;

class Nobody final : public YieldPoint {
 public:
  void yield() override { ++num_yields; }
  int num_yields = 0;
};

class CoreMinimiserTest : public testing::Test {
 protected:
  /// The set of these assumptions cannot hold. Hidden behind two auxiliary variables, so that unit
  /// propagation alone does not find it.
  void forbid(const std::vector<std::size_t>& set) {
    const Lit a = engine.new_lit(), b = engine.new_lit();
    for (const Lit c : {a, ~a})
      for (const Lit d : {b, ~b}) {
        std::vector<Lit> clause{c, d};
        for (const std::size_t k : set) clause.push_back(~assumptions[k]);
        engine.add_clause({why::Vertex{}, clause, {}, false});
      }
  }
  std::vector<std::size_t> minimise(std::int64_t searched = 1000) {
    CoreMinimiser minimiser({engine, problem, bounds, limits, nobody, kSettings});
    std::vector<std::size_t> found;
    for (const Lit lit : minimiser.minimise(assumptions, searched))
      found.push_back(static_cast<std::size_t>(
          std::find(assumptions.begin(), assumptions.end(), lit) - assumptions.begin()));
    std::sort(found.begin(), found.end());
    return found;
  }
  void make_assumptions(std::size_t count) {
    while (assumptions.size() < count) assumptions.push_back(engine.new_lit());
  }

  Engine engine{nullptr};
  NoProblem problem;
  NoBounds bounds;
  Nobody nobody;
  LimitMonitor limits{Limits{}};
  std::vector<Lit> assumptions;
};

/// Takes part in the search, and says that it takes so much whenever it is asked.
class SlowTheory final : public Theory {
 public:
  explicit SlowTheory(Effort each) : each_(each) {}
  void on_assign(std::span<const Lit>) override {}
  void on_retract(std::size_t) override {}
  void check(Extent, TheoryContext&) override { effort_ += each_; }
  Lemma explain(Lit, std::vector<Lit>&) override { return {}; }
  Effort effort() const noexcept override { return effort_; }

 private:
  const Effort each_;
  Effort effort_;
};

/// Tries to make a core smaller of which all but one literal can be dropped, one after the other.
int tries_with(Effort of_theory) {
  SlowTheory theory(of_theory);
  Engine engine(&theory);
  NoProblem problem;
  NoBounds bounds;
  Nobody nobody;
  LimitMonitor limits{Limits{}};
  std::vector<Lit> lits;
  for (int k = 0; k < 40; ++k) lits.push_back(engine.new_lit());
  // Refuted with any two, but no single one.
  for (std::size_t a = 0; a < lits.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      engine.add_clause({why::Vertex{}, std::vector<Lit>{~lits[a], ~lits[b]}, {}, false});
  CoreMinimiser minimiser({engine, problem, bounds, limits, nobody, kSettings});
  for (int round = 0; round < 40; ++round)
    EXPECT_GE(minimiser.minimise({lits[0], lits[1]}, 1'000'000).size(), 2u);
  return problem.num_solves;
}

TEST(CoreMinimiserBudget, WhatTheTheoryTakesCounts) {
  EXPECT_EQ(tries_with({}), 80);
  const int few = tries_with(Effort::microseconds(1'250'000));
  EXPECT_GE(few, 1) << "some are free";
  EXPECT_LE(few, 10);
}

using Set = std::vector<std::size_t>;

TEST_F(CoreMinimiserTest, DropsWhatIsNotNeeded) {
  make_assumptions(8);
  forbid({2, 5, 6});
  EXPECT_EQ(minimise(), (Set{2, 5, 6}));
  EXPECT_EQ(nobody.num_yields, problem.num_solves) << "others have their turn after each try";
}

TEST_F(CoreMinimiserTest, StopsWhenTheLimitsAreMet) {
  make_assumptions(6);
  forbid({3, 4});
  limits.stop(StopReason::interrupt);
  EXPECT_EQ(minimise().size(), 6u);
}

TEST_F(CoreMinimiserTest, WhatIsLeftIsACoreAndMinimal) {
  Random random(7);
  for (int round = 0; round < 60; ++round) {
    Engine fresh(nullptr);
    std::vector<Lit> lits;
    for (int k = 0; k < 9; ++k) lits.push_back(fresh.new_lit());
    std::vector<std::vector<Lit>> clauses;
    for (int c = 0; c < 4; ++c) {
      std::vector<Lit> clause;
      for (const Lit lit : lits)
        if (random.below(3) == 0) clause.push_back(~lit);
      if (clause.empty()) clause.push_back(~lits[0]);
      fresh.add_clause({why::Vertex{}, clause, {}, false});
      clauses.push_back(clause);
    }
    const auto is_core = [&](const std::vector<Lit>& part) {
      return std::any_of(clauses.begin(), clauses.end(), [&](const std::vector<Lit>& clause) {
        return std::all_of(clause.begin(), clause.end(), [&](Lit lit) {
          return std::find(part.begin(), part.end(), ~lit) != part.end();
        });
      });
    };
    CoreMinimiser minimiser({fresh, problem, bounds, limits, nobody, kSettings});
    const std::vector<Lit> core = minimiser.minimise(lits, 1000);
    ASSERT_TRUE(is_core(core)) << round;
    for (std::size_t at = 0; at < core.size(); ++at) {
      std::vector<Lit> part = core;
      part.erase(part.begin() + static_cast<std::ptrdiff_t>(at));
      EXPECT_FALSE(is_core(part)) << round;
    }
  }
}

}  // namespace
}  // namespace quadrille::sat
