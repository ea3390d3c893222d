// SPDX-License-Identifier: MIT
// Every way to place a few agents on every small connected graph, through every system.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <ostream>

#include "support/environment.hpp"
#include "support/solver_cases.hpp"

namespace quadrille::discrete::support {
namespace {

using quadrille::support::nightly;
using quadrille::support::scaled;
using Order = std::vector<std::size_t>;

struct Size {
  std::size_t vertices, agents;
};

std::ostream& operator<<(std::ostream& out, Size size) {
  return out << size.agents << "AgentsOn" << size.vertices;
}

/// Calls `visit` for one representative of the instances that differ in the agents' order only.
/// Which order the representative has changes from case to case.
template <class Visit>
void for_each_instance(Size size, const Visit& visit) {
  std::vector<Order> orders = arrangements(size.agents, size.agents);
  std::size_t number = 0;
  for (const Graph& graph : connected_graphs(size.vertices)) {
    const auto shared = std::make_shared<const Graph>(graph);
    for (const Order& starts : arrangements(size.vertices, size.agents)) {
      if (!std::is_sorted(starts.begin(), starts.end())) continue;
      for (const Order& goals : arrangements(size.vertices, size.agents)) {
        std::vector<Agent> tasks;
        for (const std::size_t i : orders[number % orders.size()])
          tasks.push_back({VertexId(starts[i]), VertexId(goals[i])});
        visit(Instance::make(shared, std::move(tasks)).value(), number++);
      }
    }
  }
}

class SolverExhaustive : public testing::TestWithParam<Size> {};

TEST_P(SolverExhaustive, AllSystemsAgreeWithTheJointSearch) {
  if (GetParam().vertices > 4 && !nightly()) GTEST_SKIP() << "only with QUADRILLE_NIGHTLY=1";
  // Below scale 1 (slow builds), every n-th instance; all of them otherwise.
  const std::size_t stride = 1000 / std::min<std::size_t>(1000, scaled(1000));
  std::size_t compared = 0, infeasible = 0;
  for_each_instance(GetParam(), [&](const Instance& instance, std::size_t number) {
    if (number % stride != 0 || HasFailure()) return;
    for (const Objective objective : {Objective::sum_of_costs, Objective::makespan}) {
      const JointAnswer expected = joint_search(instance, objective);
      ASSERT_NE(expected.status, Status::unknown);
      infeasible += expected.status == Status::infeasible ? 1 : 0;
      for (const TunedOptions& options : all_systems(objective)) {
        const std::string fault = solve_and_compare(instance, options, expected,
                                                    "exhaustive case " + std::to_string(number));
        ASSERT_EQ(fault, "") << fault;
        ++compared;
      }
    }
  });
  RecordProperty("solved", static_cast<int>(compared));
  RecordProperty("infeasible", static_cast<int>(infeasible));
  EXPECT_GT(compared, 0U);
}

std::string size_name(const testing::TestParamInfo<Size>& info) {
  return testing::PrintToString(info.param);
}

INSTANTIATE_TEST_SUITE_P(Graphs, SolverExhaustive,
                         testing::Values(Size{1, 1}, Size{2, 1}, Size{2, 2}, Size{3, 1}, Size{3, 2},
                                         Size{3, 3}, Size{4, 1}, Size{4, 2}, Size{4, 3},
                                         Size{4, 4}),
                         size_name);
INSTANTIATE_TEST_SUITE_P(Nightly, SolverExhaustive,
                         testing::Values(Size{5, 2}, Size{5, 3}, Size{5, 4}, Size{5, 5}),
                         size_name);

}  // namespace
}  // namespace quadrille::discrete::support
