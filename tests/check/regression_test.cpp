// SPDX-License-Identifier: MIT
// The answers to tests/regressions, of all systems, have certificates that prove them.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "check/support.hpp"
#include "support/case_text.hpp"

namespace quadrille::discrete::support {
namespace {

using quadrille_check::support::Answer;
using quadrille_check::support::ask;
using quadrille_check::support::checked;

TEST(CertificateRegressions, AllSystemsProveTheirAnswers) {
  std::size_t optimal = 0, infeasible = 0;
  for (const auto& entry : std::filesystem::directory_iterator(QUADRILLE_REGRESSIONS)) {
    if (entry.path().extension() != ".txt") continue;
    SCOPED_TRACE(entry.path().string());
    std::ostringstream text;
    text << std::ifstream(entry.path()).rdbuf();
    const Case read = parse_case(text.str(), entry.path().string()).value();
    if (!read.instance.is_plain() || read.instance.has_goal_sets()) continue;
    for (const Objective objective : {Objective::sum_of_costs, Objective::makespan})
      for (const System system :
           {System::dpll, System::dpll_mdd, System::smt_cbs, System::mdd_sat}) {
        SCOPED_TRACE(to_string(system));
        SolveOptions options;
        options.objective = objective;
        options.system = system;
        options.proof = true;
        const SolveOutcome outcome = solve(read.instance, options).value();
        ASSERT_TRUE(outcome.certificate) << outcome.no_certificate;
        const Answer answer = ask(checked(read.instance), outcome.certificate->bytes);
        ASSERT_TRUE(answer.is_verified) << answer.reason;
        ASSERT_EQ(answer.verdict.is_infeasible, outcome.status == Status::infeasible);
        EXPECT_EQ(answer.verdict.is_infeasible, read.infeasible);
        ++(answer.verdict.is_infeasible ? infeasible : optimal);
        if (answer.verdict.is_infeasible) continue;
        EXPECT_EQ(answer.verdict.bound, outcome.cost);
        EXPECT_EQ(answer.verdict.cost, outcome.cost);
        const auto& expected = objective == Objective::makespan ? read.makespan : read.sum_of_costs;
        if (expected) {
          EXPECT_EQ(answer.verdict.bound, *expected);
        }
      }
  }
  EXPECT_GT(optimal, 0U);
  EXPECT_GT(infeasible, 0U);
  RecordProperty("optimal", static_cast<int>(optimal));
  RecordProperty("infeasible", static_cast<int>(infeasible));
}

}  // namespace
}  // namespace quadrille::discrete::support
