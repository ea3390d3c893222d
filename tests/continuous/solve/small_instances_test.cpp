// SPDX-License-Identifier: MIT
//
// Small instances that were published with their answers; QUADRILLE_DATA says where.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

#include "quadrille/continuous/instance_json.hpp"
#include "quadrille/continuous/solver.hpp"

namespace quadrille::continuous::test {
namespace {

struct Entry {
  const char* name;
  std::optional<Cost> sum_of_costs, makespan;  // if known
};
const Entry kSolvable[] = {{"solvable_20003", 41, 16},
                           {"solvable_20008", 37, {}},
                           {"solvable_20071", 101, {}},
                           {"solvable_20109", 143, 42},
                           {"solvable_40179", 89, 33}};

std::optional<std::filesystem::path> folder() {
  const char* data = std::getenv("QUADRILLE_DATA");
  if (data == nullptr) return std::nullopt;
  const std::filesystem::path path = std::filesystem::path(data) / "congested";
  return std::filesystem::exists(path) ? std::optional(path) : std::nullopt;
}

TEST(SmallInstances, AreSolvedAtKnownCosts) {
  const auto path = folder();
  if (!path) GTEST_SKIP() << "no QUADRILLE_DATA with congested/";
  for (const Entry& entry : kSolvable)
    for (const Objective objective : {Objective::sum_of_costs, Objective::makespan})
      for (const double limit : {0.1, 1.0}) {
        SCOPED_TRACE(entry.name);
        const auto instance = read_instance_json(*path / (entry.name + std::string(".json")));
        ASSERT_TRUE(instance);
        SolveOptions options;
        options.objective = objective;
        options.limits.cpu_s = limit;
        const SolveOutcome outcome = solve(*instance, options).value();
        EXPECT_TRUE(outcome.plan);
        if (limit < 1) continue;
        EXPECT_EQ(outcome.status, Status::optimal);
        const auto& known = objective == Objective::makespan ? entry.makespan : entry.sum_of_costs;
        if (known) {
          EXPECT_EQ(outcome.lower_bound, *known);
        }
      }
}

TEST(SmallInstances, AreRefuted) {
  const auto path = folder();
  if (!path) GTEST_SKIP() << "no QUADRILLE_DATA with congested/";
  int count = 0;
  for (const auto& file : std::filesystem::directory_iterator(*path)) {
    if (file.path().filename().string().rfind("infeasible_", 0) != 0) continue;
    SCOPED_TRACE(file.path().filename().string());
    const auto instance = read_instance_json(file.path());
    ASSERT_TRUE(instance);
    for (const System system : {System::dpll, System::smt_cbs}) {
      SolveOptions options;
      options.system = system;
      options.limits.cpu_s = 1;
      EXPECT_EQ(solve(*instance, options).value().status, Status::infeasible);
    }
    ++count;
  }
  EXPECT_GE(count, 7);
}

}  // namespace
}  // namespace quadrille::continuous::test
