// SPDX-License-Identifier: MIT
// One file per past bug or notorious case in tests/regressions, through all systems.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "support/case_text.hpp"
#include "support/solver_cases.hpp"

namespace quadrille::discrete::support {
namespace {

std::vector<std::string> case_files() {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(QUADRILLE_REGRESSIONS))
    if (entry.path().extension() == ".txt") files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  return files;
}

Case read_case(const std::string& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  auto read = parse_case(text.str(), file);
  EXPECT_TRUE(read) << read.error().to_string();
  return std::move(read).value();
}

/// The answer that the file states for an objective, confirmed by the joint search if it can.
JointAnswer expected_answer(const Case& read, Objective objective) {
  JointAnswer answer = joint_search(read.instance, objective);
  const auto& cost = objective == Objective::makespan ? read.makespan : read.sum_of_costs;
  if (answer.status == Status::unknown) {
    if (read.infeasible) answer.status = Status::infeasible;
    if (cost) answer = {Status::optimal, *cost, {}};
  }
  if (read.infeasible) {
    EXPECT_EQ(answer.status, Status::infeasible);
  }
  if (cost) {
    EXPECT_EQ(answer.cost, *cost);
  }
  return answer;
}

class SolverRegression : public testing::TestWithParam<std::string> {};

TEST_P(SolverRegression, AllSystemsAnswerAsExpected) {
  const Case read = read_case(GetParam());
  for (const Objective objective : {Objective::sum_of_costs, Objective::makespan}) {
    const JointAnswer expected = expected_answer(read, objective);
    ASSERT_NE(expected.status, Status::unknown) << "state what to expect in " << GetParam();
    std::vector<TunedOptions> systems = all_systems(objective);
    for (const TunedOptions& options : all_systems(objective)) {
      systems.push_back(options);
      systems.back().debug.audit = true;
      if (!expected.plan.paths.empty()) systems.back().debug.known_plan = expected.plan;
    }
    if (read.options && read.options->objective == objective) {
      systems.push_back(*read.options);
      if (read.known_plan) systems.back().debug.known_plan = Plan();
      if (read.initial_plan) systems.back().initial_plan = Plan();
    }
    for (const TunedOptions& options : systems) {
      const std::string fault = solve_and_compare(read.instance, options, expected, GetParam());
      EXPECT_EQ(fault, "") << fault;
    }
  }
}

std::string file_name(const testing::TestParamInfo<std::string>& info) {
  std::string name = std::filesystem::path(info.param).stem().string();
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(File, SolverRegression, testing::ValuesIn(case_files()), file_name);

}  // namespace
}  // namespace quadrille::discrete::support
