// SPDX-License-Identifier: MIT
// The theory of continuous time under every callback sequence that the protocol allows. At each
// callback, what it says is compared with what follows from the stack of literals alone.
#include "theory/theory.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

#include "continuous/routes/order_search.hpp"
#include "continuous/support/random_instance.hpp"
#include "continuous/theory/judge.hpp"
#include "support/environment.hpp"
#include "support/patience.hpp"
#include "support/theory_driver.hpp"
#include "theory/lemma_auditor.hpp"

namespace quadrille::continuous::test {
namespace {

using sat::Lit;
using support::Random;

/// With plans, for those clauses that are not derived again.
struct Case {
  Instance instance;
  std::vector<Plan> plans;
};
Case draw_case(std::uint32_t seed) {
  RandomOptions options;
  options.num_vertices = 5;
  options.num_agents = 2 + seed % 2;
  options.size = 30;
  options.edge_percent = 55;
  for (std::uint32_t n = 0;; ++n) {
    Instance instance = random_instance(100 * seed + n, options);
    std::vector<Plan> plans = known_plans(instance, 3);
    if (!plans.empty() || n == 99) return {std::move(instance), std::move(plans)};
  }
}

/// Derives path lemmas again, and compares all with known plans.
class Auditor {
 public:
  Auditor(const Model& model, const std::vector<Plan>& plans, Count& count)
      : model_(model), count_(count) {
    for (const Plan& plan : plans) of_plans_.emplace_back(model, false, plan);
  }
  void on_lemma(const sat::Lemma& lemma) {
    for (LemmaAuditor& auditor : of_plans_) {
      auditor.on_lemma(lemma);
      EXPECT_EQ(auditor.complaint().value_or(""), "");
    }
    if (lemma.is<sat::why::Path>()) derive_path_lemma(lemma);
  }

 private:
  /// "i costs this or more, or breaks a ban of one of these obstacles."
  void derive_path_lemma(const sat::Lemma& lemma) {
    ++count_.audited;
    std::optional<AgentId> agent;
    std::vector<Ban> bans;
    std::vector<Lit> rest(lemma.clause.begin(), lemma.clause.end());
    for (const sat::Usage& usage : lemma.usages) {
      EXPECT_TRUE(!agent || *agent == usage.agent);
      agent = usage.agent;
      const Obstacle& obstacle = model_.obstacles()[ObstacleId(usage.resource)];
      EXPECT_EQ(obstacle.agent, usage.agent);
      EXPECT_TRUE(std::count(lemma.clause.begin(), lemma.clause.end(), obstacle.allowed) == 1);
      std::erase(rest, obstacle.allowed);
      bans.insert(bans.end(), obstacle.bans.begin(), obstacle.bans.end());
    }
    ASSERT_LE(rest.size(), 1u);
    Cost bound = kAnyCost;
    if (!rest.empty()) {
      const auto meaning = model_.variable(rest[0]);
      EXPECT_TRUE(meaning.kind == Model::VariableKind::cost && rest[0].positive());
      EXPECT_TRUE(!agent || *agent == meaning.agent);
      agent = meaning.agent;
      bound = meaning.cost;
    }
    ASSERT_TRUE(agent);
    const std::vector<Ban>& standing = model_.standing_bans(*agent);
    bans.insert(bans.end(), standing.begin(), standing.end());
    EXPECT_GE(least_arrival(model_.instance(), *agent, bans).value_or(kForever), as_ticks(bound));
  }

  const Model& model_;
  Count& count_;
  std::deque<LemmaAuditor> of_plans_;
};

class Session final : private FormulaWriter {
 public:
  Session(Random& random, std::uint32_t seed, Count& count)
      : random_(random),
        case_(draw_case(seed)),
        count_(count),
        scene_(case_.instance, limits_),
        model_(scene_),
        theory_(model_, count),
        auditor_(model_, case_.plans, count),
        driver_(theory_, random,
                {[this](const sat::Lemma& lemma) { auditor_.on_lemma(lemma); },
                 [this] { begin_solve(); }, [this] { return draw(Model::VariableKind::usage); },
                 [this] { return draw(Model::VariableKind::cost); }}) {}

  void run_sequence(std::uint64_t seed) {
    count_.dead += driver_.run_sequence(seed) ? 1 : 0;
    theory_.forget();
  }

 private:
  [[nodiscard]] Lit new_lit() override { return driver_.new_lit(); }
  void add(const sat::Lemma& lemma) override { driver_.add(lemma); }

  /// Between solves: bounds on some agents, which are assumed.
  void begin_solve() {
    ContinuousTheory::Question question;
    if (random_.percent(20)) question.mode = ContinuousTheory::Question::Mode::complete;
    theory_.ask(question);
    for (const AgentId i : model_.instance().agent_ids())
      if (random_.percent(50)) {
        const Cost cap = model_.free_cost(i) + static_cast<Cost>(random_.below(40));
        driver_.assume(~model_.above(i, cap, *this));
      }
  }
  /// A literal that forbids something, or caps a cost; or now and then the opposite.
  [[nodiscard]] Lit draw(Model::VariableKind kind) {
    std::vector<Lit> fitting;
    for (const Lit lit : model_.literals())
      if (model_.variable(lit).kind == kind) fitting.push_back(lit);
    if (fitting.empty()) return {};
    const Lit lit = random_.pick(fitting);
    const bool is_usual = random_.percent(75);
    return is_usual == (kind == Model::VariableKind::usage) ? lit : ~lit;
  }

  Random& random_;
  const Case case_;
  Count& count_;
  LimitMonitor limits_{Limits{}};
  Scene scene_;
  Model model_;
  JudgedTheory theory_;
  Auditor auditor_;
  support::TheoryDriver driver_;
};

class ContinuousTheoryCallbacks : public testing::TestWithParam<int> {};

TEST_P(ContinuousTheoryCallbacks, AgreeWithARecomputation) {
  const std::size_t num_sessions = support::scaled(40);
  std::size_t sequences = 0;
  Count count;
  for (std::size_t s = 0; s < num_sessions && !HasFailure(); ++s) {
    const auto seed =
        static_cast<std::uint32_t>(GetParam()) * 1'000'000 + static_cast<std::uint32_t>(s);
    const support::AbortNote note("session " + std::to_string(seed) + "\n");
    const support::Patience patience(60);
    Random random(seed);
    Session session(random, seed, count);
    for (std::size_t n = 0; n < 30 && !HasFailure(); ++n, ++sequences) {
      SCOPED_TRACE(testing::Message() << "session " << seed << " sequence " << n);
      session.run_sequence(n);
    }
  }
  if (HasFailure() || num_sessions < 40) return;  // too few to count on chance
  EXPECT_GT(count.silent, sequences);
  EXPECT_GT(count.conflicts, sequences / 20);
  EXPECT_GT(count.accepted, sequences / 10);
  EXPECT_GT(count.rejected, sequences / 20);
  EXPECT_GT(count.told, sequences / 20);
  EXPECT_GT(count.audited, sequences / 2);
  EXPECT_LT(count.dead, sequences / 2);
}

INSTANTIATE_TEST_SUITE_P(Shard, ContinuousTheoryCallbacks, testing::Range(0, 4));

}  // namespace
}  // namespace quadrille::continuous::test
