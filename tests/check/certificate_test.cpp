// SPDX-License-Identifier: MIT
// Certificates of small instances: each is verified, proves what the solver says, and cannot be
// broken in a way that proves more than what is true.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "check/cases.hpp"
#include "check/support.hpp"
#include "quadrille/discrete/solver.hpp"
#include "solve/tuning.hpp"
#include "support/environment.hpp"
#include "support/generators.hpp"
#include "support/joint_search.hpp"

namespace quadrille::discrete {
namespace {

using quadrille::support::Random;
using quadrille::support::scaled;
using quadrille_check::Int;
using quadrille_check::Record;
using quadrille_check::support::Answer;
using quadrille_check::support::ask;
using quadrille_check::support::bytes_of;
using quadrille_check::support::checked;
using quadrille_check::support::Interpretation;
using quadrille_check::support::mutate;
using quadrille_check::support::places;
using quadrille_check::support::records_of;
using quadrille_check::support::text_of;
using support::Case;
using support::draw;
using support::joint_search;
using support::Pace;
using support::random_grid;
using support::solve_at;

/// Of the certificate's clauses, those that are false in a plan.
std::string find_false_clause(const quadrille_check::Instance& instance,
                              const std::string& certificate,
                              const std::vector<std::vector<int>>& paths) {
  quadrille_check::Checker checker(instance);
  const Interpretation plan(checker.meanings(), paths);
  Int clause = 0;
  for (const Record& record : records_of(certificate)) {
    checker.check(record);
    if (record.tag != 'a' && record.tag != 'l') continue;
    ++clause;
    if (!plan.is_true(record.tag == 'a' ? record.literals() : record.derived()))
      return record.text(clause);
  }
  return "";
}

std::vector<std::vector<int>> paths_of(const Instance& instance, const Plan& plan) {
  std::vector<std::vector<int>> paths;
  for (const AgentId i : instance.agent_ids()) paths.push_back(places(instance, plan.paths[i]));
  return paths;
}

TEST(Certificate, ProvesEachAnswerOnRandomInstances) {
  std::map<System, std::size_t> by_system;
  std::size_t proved = 0, with_swap = 0, with_excess = 0;
  for (std::uint64_t seed = 0; seed < scaled(600); ++seed) {
    SCOPED_TRACE(seed);
    const Case c = draw(seed);
    const SolveOutcome outcome = solve_at(c.instance, c.options, c.pace);
    if (outcome.status == Status::infeasible) continue;  // infeasible_test.cpp
    ASSERT_EQ(outcome.status, Status::optimal);
    ASSERT_TRUE(outcome.certificate) << outcome.no_certificate;
    const auto instance = checked(c.instance);
    const Answer answer = ask(instance, outcome.certificate->bytes);
    ASSERT_TRUE(answer.is_verified) << answer.reason;
    EXPECT_EQ(answer.verdict.bound, *outcome.cost);
    EXPECT_EQ(answer.verdict.cost, *outcome.cost);
    EXPECT_EQ(outcome.certificate->claim, *outcome.cost);
    const auto oracle = joint_search(c.instance, c.options.objective, 200'000);
    if (oracle.status == Status::optimal) {
      ASSERT_EQ(oracle.cost, answer.verdict.bound);
      EXPECT_EQ(find_false_clause(instance, outcome.certificate->bytes,
                                  paths_of(c.instance, oracle.plan)),
                "");
    }
    ++proved;
    ++by_system[c.options.system];
    for (const Record& record : records_of(outcome.certificate->bytes)) {
      with_swap += record.tag == 'a' && record.values[0] == 3 ? 1 : 0;
      with_excess += record.tag == 'e' ? 1 : 0;
    }
  }
  EXPECT_GT(proved, 0U);
  if (scaled(100) < 100) return;
  EXPECT_EQ(by_system.size(), 4U);
  EXPECT_GT(with_swap, 0U);
  EXPECT_GT(with_excess, 0U);  // claims from above
}

/// Small crowds with long ways round: few of their cores raise the bound by more than one, so
/// there are many of them.
TEST(Certificate, ProvesCoresThatRaiseTheBoundByMoreThanOne) {
  std::size_t with_levels = 0;
  for (std::uint64_t seed = 3000; seed < 3000 + scaled(300); ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Instance instance = random_grid(random, {3, 5, 60, 5, 6});
    SolveOptions options;
    options.proof = true;
    options.seed = static_cast<std::uint32_t>(random.below(3));
    const Pace pace{static_cast<std::int64_t>(random.between(1, 60)), 3};
    const SolveOutcome outcome = solve_at(instance, options, pace);
    if (outcome.status == Status::infeasible) continue;
    ASSERT_EQ(outcome.status, Status::optimal);
    ASSERT_TRUE(outcome.certificate) << outcome.no_certificate;
    const Answer answer = ask(checked(instance), outcome.certificate->bytes);
    ASSERT_TRUE(answer.is_verified) << answer.reason;
    EXPECT_EQ(answer.verdict.bound, *outcome.cost);
    EXPECT_EQ(answer.verdict.cost, *outcome.cost);
    const auto records = records_of(outcome.certificate->bytes);
    with_levels += std::ranges::any_of(
        records, [](const Record& record) { return record.tag == 'n' && record.values[1] == 4; });
  }
  RecordProperty("with_levels", static_cast<int>(with_levels));
  if (scaled(100) < 100) return;
  EXPECT_GT(with_levels, 0U);
}

TEST(Certificate, LeavesTheSearchAsItIsAndIsTheSameEachTime) {
  for (std::uint64_t seed = 1000; seed < 1000 + scaled(150); ++seed) {
    SCOPED_TRACE(seed);
    const Case c = draw(seed);
    SolveOptions without = c.options;
    without.proof = false;
    const SolveOutcome a = solve_at(c.instance, c.options, c.pace);
    const SolveOutcome b = solve_at(c.instance, without, c.pace);
    const SolveOutcome again = solve_at(c.instance, c.options, c.pace);
    EXPECT_FALSE(b.certificate);
    EXPECT_EQ(a.status, b.status);
    EXPECT_EQ(a.cost, b.cost);
    EXPECT_EQ(a.lower_bound, b.lower_bound);
    EXPECT_EQ(a.statistics.conflicts, b.statistics.conflicts);
    EXPECT_EQ(a.statistics.decisions, b.statistics.decisions);
    EXPECT_EQ(a.statistics.sat_calls, b.statistics.sat_calls);
    EXPECT_EQ(a.statistics.clauses, b.statistics.clauses);
    if (a.plan) {
      EXPECT_EQ(a.plan->paths, b.plan->paths);
      EXPECT_EQ(a.certificate->bytes, again.certificate->bytes);
    }
  }
}

TEST(Certificate, ProvesTheBoundThatALimitLeaves) {
  std::size_t below = 0;
  for (std::uint64_t seed = 2000; seed < 2000 + scaled(60); ++seed) {
    const Case c = draw(seed);
    for (const std::int64_t conflicts : {0, 1, 2, 3, 5, 8, 13, 21}) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", conflicts " << conflicts);
      SolveOptions options = c.options;
      options.limits.conflicts = conflicts;
      const SolveOutcome outcome = solve_at(c.instance, options, c.pace);
      if (outcome.status == Status::infeasible) break;
      ASSERT_TRUE(outcome.certificate) << outcome.no_certificate;
      const Answer answer = ask(checked(c.instance), outcome.certificate->bytes);
      ASSERT_TRUE(answer.is_verified) << answer.reason;
      EXPECT_EQ(answer.verdict.bound, outcome.lower_bound);
      EXPECT_EQ(answer.verdict.cost.has_value(), outcome.plan.has_value());
      below += outcome.status == Status::optimal ? 0 : 1;
    }
  }
  EXPECT_GT(below, 0U);
}

TEST(Certificate, DoesNotProveWhatTheUserClaims) {
  int claims = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    const Case c = draw(seed);
    SolveOptions options = c.options;
    options.objective = Objective::sum_of_costs;
    options.limits.conflicts = 0;
    const SolveOutcome plain = solve_at(c.instance, options, {});
    if (plain.status == Status::infeasible) continue;
    options.known_lower_bound = plain.lower_bound + 1;
    const auto claimed = solve_tuned(c.instance, options, tuner_for(c.instance));
    if (!claimed) continue;  // the claim is refuted
    ++claims;
    EXPECT_LE(claimed->certificate->claim, plain.lower_bound);
    EXPECT_TRUE(ask(checked(c.instance), claimed->certificate->bytes).is_verified);
  }
  EXPECT_GT(claims, 0);
}

// Times and costs of certificates count from the moment at which the instance begins.
TEST(Certificate, IsThatOfTheInstanceBegunAt0) {
  for (std::uint64_t seed = 2000; seed < 2000 + scaled(100); ++seed) {
    SCOPED_TRACE(seed);
    const Case c = draw(seed);
    const Instance later = c.instance.with_now(1'000'000 + static_cast<Timestep>(seed)).value();
    const SolveOutcome a = solve_at(c.instance, c.options, c.pace);
    const SolveOutcome b = solve_at(later, c.options, c.pace);
    ASSERT_EQ(a.status, b.status);
    ASSERT_TRUE(b.certificate);
    EXPECT_EQ(a.certificate->claim, b.certificate->claim);
    EXPECT_EQ(a.certificate->bytes, b.certificate->bytes);
    EXPECT_TRUE(ask(checked(later), b.certificate->bytes).is_verified);
  }
}

TEST(Certificate, KnowsOneGoalForEachAgent) {
  Random random(1);
  const Instance sets = support::with_more_goals(random, draw(0).instance);
  ASSERT_TRUE(sets.has_goal_sets());
  SolveOptions options;
  options.proof = true;
  EXPECT_EQ(solve(sets, options).error().code, ErrorCode::out_of_range);
}

// ---- mutations ----------------------------------------------------------------------------------

TEST(Certificate, CannotBeBrokenToProveTooMuch) {
  std::size_t accepted = 0, tried = 0;
  for (std::uint64_t seed = 3000; seed < 3000 + scaled(120); ++seed) {
    SCOPED_TRACE(seed);
    const Case c = draw(seed);
    const SolveOutcome outcome = solve_at(c.instance, c.options, c.pace);
    if (!outcome.plan) continue;
    const auto instance = checked(c.instance);
    const auto records = records_of(outcome.certificate->bytes);
    ASSERT_EQ(bytes_of(records), outcome.certificate->bytes);
    ASSERT_TRUE(ask(instance, text_of(records)).is_verified);
    Random random(seed);
    for (int k = 0; k < 150; ++k) {
      std::vector<Record> broken = records;
      for (std::size_t n = random.between(1, 3); n > 0 && !broken.empty(); --n)
        mutate(broken, random);
      const Answer answer = ask(instance, bytes_of(broken));
      ++tried;
      if (!answer.is_verified) continue;
      ++accepted;
      const Objective about =
          answer.verdict.is_makespan ? Objective::makespan : Objective::sum_of_costs;
      // Of the other objective the plan is as good as any.
      const Cost most = about == c.options.objective ? *outcome.cost : outcome.plan->cost(about);
      ASSERT_LE(answer.verdict.bound, most) << text_of(broken);
    }
  }
  EXPECT_LT(accepted, tried);
}

TEST(Certificate, IsRejectedWithoutWhatItNeeds) {
  for (std::uint64_t seed = 5000; seed < 5000 + scaled(60); ++seed) {
    SCOPED_TRACE(seed);
    const Case c = draw(seed);
    const SolveOutcome outcome = solve_at(c.instance, c.options, c.pace);
    if (!outcome.plan) continue;
    const auto instance = checked(c.instance);
    const auto records = records_of(outcome.certificate->bytes);
    for (std::size_t at = 0; at < records.size(); ++at) {
      std::vector<Record> broken = records;
      if (broken[at].tag == 'q') {
        ++broken[at].values[0];
        EXPECT_FALSE(ask(instance, bytes_of(broken)).is_verified) << "a larger claim";
      }
      if (broken[at].tag == 'k' && broken[at].values[1] != -1) {
        broken.insert(broken.begin() + static_cast<std::ptrdiff_t>(at), Record(broken[at]));
        EXPECT_FALSE(ask(instance, bytes_of(broken)).is_verified) << "a core that is paid twice";
      }
      if (broken[at].tag == 'a') {
        // Without what is true in the plan it excludes a plan.
        quadrille_check::Checker checker(instance);
        for (std::size_t k = 0; k < at; ++k) checker.check(records[k]);
        const Interpretation plan(checker.meanings(), paths_of(c.instance, *outcome.plan));
        Record& axiom = broken[at];
        const auto first = axiom.values.begin() + 2 + static_cast<std::ptrdiff_t>(axiom.values[1]);
        axiom.values.erase(
            std::remove_if(first, axiom.values.end(), [&](Int lit) { return plan.is_true(lit); }),
            axiom.values.end());
        EXPECT_THROW(checker.check(axiom), quadrille_check::Rejected) << axiom.text(0);
      }
    }
    const std::string& whole = outcome.certificate->bytes;
    Random random(seed);
    for (int k = 0; k < 20; ++k) {
      const Answer cut = ask(instance, whole.substr(0, random.below(whole.size())));
      EXPECT_FALSE(cut.is_verified && cut.verdict.cost == *outcome.cost);
      std::string flipped = whole;
      flipped[random.below(whole.size())] ^= static_cast<char>(1 << random.below(8));
      const Answer answer = ask(instance, flipped);
      EXPECT_TRUE(!answer.is_verified || answer.verdict.bound <= *outcome.cost ||
                  answer.verdict.is_makespan != (c.options.objective == Objective::makespan));
    }
  }
}

}  // namespace
}  // namespace quadrille::discrete
