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
  const auto error_of = [](std::size_t vertices, System system) -> std::optional<Error> {
    auto graph = std::make_shared<const Graph>(Graph::make(vertices, {}).value());
    TunedOptions options;
    options.system = system;
    auto outcome = solve(Instance::make(graph, {{VertexId(0), VertexId(0)}}).value(), options);
    if (outcome.has_value()) return std::nullopt;
    return outcome.error();
  };
  for (const System system : {System::dpll, System::dpll_mdd, System::smt_cbs, System::mdd_sat}) {
    const std::size_t most = std::size_t{1} << (system == System::dpll ? 23 : 21);
    const auto error = error_of(most + 1, system);
    ASSERT_TRUE(error);
    EXPECT_EQ(error->code, ErrorCode::out_of_range);
    EXPECT_NE(error->message.find(std::to_string(most)), std::string::npos);
    EXPECT_FALSE(error_of(most, system)) << to_string(system);
  }
}

}  // namespace
}  // namespace quadrille::discrete::support
