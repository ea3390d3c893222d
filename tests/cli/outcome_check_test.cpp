// SPDX-License-Identifier: MIT
#include "answers/outcome_check.hpp"

#include <gtest/gtest.h>

#include "quadrille/discrete/solver.hpp"
#include "quadrille/discrete/verify.hpp"

namespace quadrille::cli {
namespace {

using discrete::Graph;
using discrete::Instance;
using discrete::SolveOutcome;

/// One agent that walks from 0 to 2 on a path of three vertices.
Instance instance() {
  auto graph = Graph::make(3, {{VertexId(0), VertexId(1)}, {VertexId(1), VertexId(2)}});
  return Instance::make(std::move(graph.value()), {{VertexId(0), VertexId(2)}}).value();
}

SolveOutcome good() {
  SolveOutcome outcome;
  outcome.status = Status::optimal;
  outcome.plan = discrete::Plan{{{VertexId(0), VertexId(1), VertexId(2)}}};
  outcome.cost = 2;
  outcome.lower_bound = 2;
  return outcome;
}

void expect_caught(SolveOutcome outcome, const char* what) {
  SCOPED_TRACE(what);
  (void)check_outcome(instance(), Objective::sum_of_costs, outcome);
  EXPECT_TRUE(outcome.internal_error.has_value());
  EXPECT_EQ(outcome.status, Status::unknown);
  EXPECT_FALSE(outcome.plan.has_value());
  EXPECT_FALSE(outcome.cost.has_value());
  EXPECT_EQ(outcome.lower_bound, 0);
}

TEST(OutcomeCheck, PassesTrueClaims) {
  for (const Objective objective : {Objective::sum_of_costs, Objective::makespan}) {
    SolveOutcome outcome = good();
    EXPECT_TRUE(check_outcome(instance(), objective, outcome).valid());
    EXPECT_FALSE(outcome.internal_error.has_value());
    EXPECT_EQ(outcome.status, Status::optimal);
  }
  SolveOutcome unknown;
  (void)check_outcome(instance(), Objective::makespan, unknown);
  EXPECT_FALSE(unknown.internal_error.has_value());
}

TEST(OutcomeCheck, CatchesFalseClaims) {
  SolveOutcome outcome = good();
  outcome.plan->paths[AgentId(0)].pop_back();
  expect_caught(outcome, "does not reach the goal");
  outcome = good();
  outcome.plan->paths[AgentId(0)] = {VertexId(0), VertexId(2)};
  expect_caught(outcome, "no edge");
  outcome = good();
  outcome.cost = 1;
  expect_caught(outcome, "wrong cost");
  outcome = good();
  outcome.lower_bound = 3;
  expect_caught(outcome, "bound above the cost");
  outcome = good();
  outcome.lower_bound = 1;
  expect_caught(outcome, "optimal without a tight bound");
  outcome = good();
  outcome.status = Status::feasible;
  expect_caught(outcome, "a tight bound is a proof");
  outcome = good();
  outcome.status = Status::infeasible;
  expect_caught(outcome, "infeasible with a plan");
  outcome = good();
  outcome.plan.reset();
  expect_caught(outcome, "optimal without a plan");
  outcome = good();
  outcome.internal_error = Error{ErrorCode::internal, "found by the search", {}};
  expect_caught(outcome, "an error of the search");
}

TEST(OutcomeCheck, KeepsTheViolationsForTheMessage) {
  SolveOutcome outcome = good();
  outcome.plan->paths[AgentId(0)] = {VertexId(0), VertexId(2)};
  EXPECT_EQ(check_outcome(instance(), Objective::makespan, outcome).violations.size(), 1u);
}

TEST(OutcomeCheck, AFileThatSaysFeasibleOfABoundThatIsMetStatesWhatIsWrong) {
  StatedOutcome stated;
  stated.status = Status::feasible;
  stated.lower_bound = 7;
  EXPECT_EQ(find_false_statements(stated, 7, 4),
            std::vector<std::string>{"the file states that the plan is no more than feasible, but "
                                     "the lower bound is 7 and the cost 7"});
  EXPECT_TRUE(find_false_statements(stated, 8, 4).empty());
  stated.status = Status::optimal;
  EXPECT_TRUE(find_false_statements(stated, 7, 4).empty());
}

}  // namespace
}  // namespace quadrille::cli
