// SPDX-License-Identifier: MIT
// The answers to tests/regressions and to all small instances, of all systems, have certificates
// that prove them.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <sstream>
#include <utility>
#include <vector>

#include "check/support.hpp"
#include "support/case_text.hpp"
#include "support/environment.hpp"
#include "support/solver_cases.hpp"

namespace quadrille::discrete::support {
namespace {

using quadrille::support::nightly;
using quadrille_check::support::Answer;
using quadrille_check::support::ask;
using quadrille_check::support::checked;

/// Of all systems, with a certificate that proves it. `expected`: if the cost is known.
void check(const Instance& instance, Objective objective, bool is_infeasible,
           const std::optional<Cost>& expected) {
  const auto own = checked(instance);
  for (const System system : {System::dpll, System::dpll_mdd, System::smt_cbs, System::mdd_sat}) {
    SCOPED_TRACE(to_string(system));
    SolveOptions options;
    options.objective = objective;
    options.system = system;
    options.proof = true;
    const SolveOutcome outcome = solve(instance, options).value();
    ASSERT_TRUE(outcome.certificate) << outcome.no_certificate;
    const Answer answer = ask(own, outcome.certificate->bytes);
    ASSERT_TRUE(answer.is_verified) << answer.reason;
    ASSERT_EQ(answer.verdict.is_infeasible, is_infeasible);
    if (is_infeasible) continue;
    EXPECT_EQ(answer.verdict.bound, outcome.cost);
    EXPECT_EQ(answer.verdict.cost, outcome.cost);
    if (expected) {
      EXPECT_EQ(answer.verdict.bound, *expected);
    }
  }
}

TEST(CertificateRegressions, AllSystemsProveTheirAnswers) {
  std::size_t optimal = 0, infeasible = 0;
  for (const auto& entry : std::filesystem::directory_iterator(QUADRILLE_REGRESSIONS)) {
    if (entry.path().extension() != ".txt") continue;
    SCOPED_TRACE(entry.path().string());
    std::ostringstream text;
    text << std::ifstream(entry.path()).rdbuf();
    const Case read = parse_case(text.str(), entry.path().string()).value();
    if (!read.instance.is_plain() || read.instance.has_goal_sets()) continue;
    ++(read.infeasible ? infeasible : optimal);
    check(read.instance, Objective::sum_of_costs, read.infeasible, read.sum_of_costs);
    check(read.instance, Objective::makespan, read.infeasible, read.makespan);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(optimal, 0U);
  EXPECT_GT(infeasible, 0U);
}

TEST(CertificateRegressions, AllSmallInstancesHaveCertificates) {
  std::size_t number = 0, infeasible = 0;
  // At night all, else one of ten.
  const std::size_t stride = nightly() ? 1 : 10;
  for (const auto& [vertices, agents] : {std::pair<std::size_t, std::size_t>{4, 2}, {4, 3}, {4, 4}})
    for (const Graph& graph : connected_graphs(vertices)) {
      const auto shared = std::make_shared<const Graph>(graph);
      for (const auto& starts : arrangements(vertices, agents))
        for (const auto& goals : arrangements(vertices, agents)) {
          if (!std::is_sorted(starts.begin(), starts.end()) || number++ % stride != 0) continue;
          std::vector<Agent> tasks;
          for (std::size_t i = 0; i < agents; ++i)
            tasks.push_back({VertexId(starts[i]), VertexId(goals[i])});
          const Instance instance = Instance::make(shared, std::move(tasks)).value();
          SCOPED_TRACE(instance_text(instance));
          for (const Objective objective : {Objective::sum_of_costs, Objective::makespan}) {
            const JointAnswer expected = joint_search(instance, objective);
            const bool is_infeasible = expected.status == Status::infeasible;
            infeasible += is_infeasible ? 1 : 0;
            check(instance, objective, is_infeasible, expected.cost);
            if (HasFatalFailure()) return;
          }
        }
    }
  EXPECT_GT(number, 0U);
  EXPECT_GT(infeasible, 0U);
}

}  // namespace
}  // namespace quadrille::discrete::support
