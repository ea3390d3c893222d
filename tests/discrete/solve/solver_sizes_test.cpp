// SPDX-License-Identifier: MIT
// Sizes at which resource numbers end: what is beyond is refused, with the reason.
#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "support/solver_cases.hpp"

namespace quadrille::discrete::support {
namespace {

SolveOutcome checked(const Instance& instance, const TunedOptions& options) {
  SolveOutcome outcome = solve(instance, options).value();
  EXPECT_FALSE(outcome.internal_error);
  return outcome;
}

/// One agent that goes the whole way.
Instance corridor(std::size_t length) {
  std::vector<Graph::Edge> edges;
  for (std::size_t v = 0; v + 1 < length; ++v) edges.emplace_back(VertexId(v), VertexId(v + 1));
  auto graph = std::make_shared<const Graph>(Graph::make(length, edges).value());
  return Instance::make(graph, {{VertexId(0), VertexId(length - 1)}}).value();
}

// Paths of the MDD systems have fewer than 2^20 timesteps.
TEST(SolverSizes, PathsThatAreTooLongForResourceNumbersAreNamed) {
  constexpr std::size_t kTooLong = (std::size_t{1} << 20) - 1;
  for (const System system : {System::mdd_sat, System::smt_cbs, System::dpll_mdd}) {
    TunedOptions options;
    options.system = system;
    options.first_plan = false;
    const SolveOutcome outcome = checked(corridor(kTooLong + 1), options);
    EXPECT_EQ(outcome.status, Status::unknown);
    EXPECT_EQ(outcome.stop, StopReason::none);
    EXPECT_EQ(outcome.lower_bound, Cost{kTooLong});
    EXPECT_NE(outcome.explanation.find("2^20 timesteps"), std::string::npos);
  }
}

TEST(SolverSizes, GraphsThatAreTooLargeAreAnError) {
  constexpr std::size_t kTooMany = (std::size_t{1} << 21) + 1;
  auto graph = std::make_shared<const Graph>(Graph::make(kTooMany, {}).value());
  const auto instance = Instance::make(graph, {{VertexId(0), VertexId(0)}}).value();
  const auto outcome = solve(instance, TunedOptions{});
  ASSERT_FALSE(outcome.has_value());
  EXPECT_EQ(outcome.error().code, ErrorCode::out_of_range);
}

}  // namespace
}  // namespace quadrille::discrete::support
