// SPDX-License-Identifier: MIT
// The lazy path theory under every callback sequence that the protocol allows. At each callback,
// what the theory says is compared with what follows from the stack of literals alone.
#include "lazy/lazy_theory.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "discrete/lazy/watched_theory.hpp"
#include "lazy/lazy_auditor.hpp"
#include "support/distances.hpp"
#include "support/environment.hpp"
#include "support/generators.hpp"
#include "support/joint_search.hpp"
#include "support/patience.hpp"
#include "support/theory_driver.hpp"

namespace quadrille::discrete {
namespace {

using sat::Lit;
using support::Count;
using support::Random;
using support::WatchedTheory;
using VariableKind = LazyModel::VariableKind;

// ---- the solver's side --------------------------------------------------------------------------

/// An instance all of whose goals can be reached. Small: the audit of one lemma is a joint search.
Instance random_instance(Random& random) {
  while (true) {
    Instance instance = random.percent(65) ? support::random_grid(random, {2, 4, 25, 2, 5})
                                           : support::random_graph(random, 9, 4);
    if (random.percent(40)) instance = support::with_more_goals(random, instance);
    const bool all_reach =
        std::all_of(instance.agents().begin(), instance.agents().end(), [&](const Agent& task) {
          return distances_to_nearest(instance.graph(), task.goals)[task.start] != kUnreachable;
        });
    if (all_reach && instance.num_agents() > 1) return instance;
  }
}

class Session final : private FormulaWriter {
 public:
  Session(Random& random, Count& count)
      : random_(random),
        instance_(random_instance(random)),
        count_(count),
        model_(instance_, support::distances_of(instance_)),
        theory_(model_, count),
        auditor_(model_, true, some_plan(instance_)),
        driver_(theory_, random,
                {[this](const sat::Lemma& lemma) { auditor_.on_lemma(lemma); },
                 [this] { begin_solve(); }, [this] { return draw(VariableKind::usage); },
                 [this] { return draw(VariableKind::cost); }}) {}

  void run_sequence(std::uint64_t seed) {
    count_.dead += driver_.run_sequence(seed) ? 1 : 0;
    EXPECT_EQ(auditor_.complaint().value_or(""), "");
    theory_.forget();
  }
  /// Whether an agent has got explicit paths.
  [[nodiscard]] bool has_explicit_paths() { return draw(VariableKind::own).valid(); }

 private:
  static std::optional<Plan> some_plan(const Instance& instance) {
    auto answer = support::joint_search(instance, Objective::makespan);
    return answer.status == Status::optimal ? std::optional(std::move(answer.plan)) : std::nullopt;
  }
  [[nodiscard]] Lit new_lit() override { return driver_.new_lit(); }
  void add(const sat::Lemma& lemma) override { driver_.add(lemma); }

  /// Between solves: cost literals are made, then assumed.
  void begin_solve() {
    const bool all_present = random_.percent(50);
    theory_.on_solve(all_present);
    for (const AgentId i : instance_.agent_ids()) {
      const auto delay = static_cast<Timestep>(random_.below(5));
      const Lit above = model_.cost_above(i, model_.distances(i).free_cost() + delay, *this);
      if (all_present || random_.percent(60)) driver_.assume(~above);
    }
  }
  /// A literal at random; those of kind `usage` and `cost` do something.
  [[nodiscard]] Lit draw(VariableKind kind) {
    std::vector<Lit> fitting;
    for (int v = 1; v < driver_.end(); ++v)
      if (model_.variable(Lit::from_dimacs(v)).kind == kind) fitting.push_back(Lit::from_dimacs(v));
    return fitting.empty() ? Lit() : random_.pick(fitting);
  }

  Random& random_;
  const Instance instance_;
  Count& count_;
  LazyModel model_;
  WatchedTheory theory_;
  LazyAuditor auditor_;
  quadrille::support::TheoryDriver driver_;
};

class LazyTheoryCallbacks : public testing::TestWithParam<int> {};

TEST_P(LazyTheoryCallbacks, AgreeWithARecomputation) {
  const std::size_t num_sessions = quadrille::support::scaled(50);
  std::size_t sequences = 0, num_explicit = 0;
  Count count;
  for (std::size_t s = 0; s < num_sessions && !HasFailure(); ++s) {
    const std::uint64_t seed = static_cast<std::uint64_t>(GetParam()) * 1'000'000 + s;
    const quadrille::support::AbortNote note("session " + std::to_string(seed) + "\n");
    const quadrille::support::Patience patience(20);
    Random random(seed);
    Session session(random, count);
    // Some go on until agents get explicit paths.
    const std::size_t length = s % 10 == 0 ? 500 : 60;
    for (std::size_t n = 0; n < length && !HasFailure(); ++n, ++sequences) {
      SCOPED_TRACE(testing::Message() << "session " << seed << " sequence " << n);
      session.run_sequence(n);
    }
    num_explicit += session.has_explicit_paths() ? 1 : 0;
  }
  if (HasFailure() || num_sessions < 50) return;  // too few to count on chance
  EXPECT_GT(count.silent, sequences);
  EXPECT_GT(count.conflicts, sequences / 20);
  EXPECT_GT(count.accepted, sequences / 4);
  EXPECT_GT(count.rejected, sequences / 20);
  EXPECT_GT(count.decisions, sequences / 50);
  EXPECT_GT(count.stops, sequences / 4);
  EXPECT_GT(count.told, sequences / 20);
  EXPECT_LT(count.dead, sequences / 2);
  EXPECT_GT(num_explicit, 0u);
}

INSTANTIATE_TEST_SUITE_P(Shard, LazyTheoryCallbacks, testing::Range(0, 4));

}  // namespace
}  // namespace quadrille::discrete
