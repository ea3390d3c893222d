// SPDX-License-Identifier: MIT
//
// The costs that published solvers found on MAPF_R benchmarks. Needs QUADRILLE_DATA.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <sstream>
#include <string>

#include "quadrille/continuous/quantise.hpp"
#include "quadrille/continuous/roadmap_xml.hpp"
#include "quadrille/continuous/solver.hpp"
#include "quadrille/continuous/verify.hpp"
#include "support/environment.hpp"

namespace quadrille::continuous::test {
namespace {

using support::data_folder;
using support::scaled;

struct Row {
  std::string map;
  int neighbourhood = 0;
  std::string task;
  std::size_t agents = 0;
  double cost = 0;  // in the files' unit of time
};

/// With six digits after the point.
constexpr double kPrecisionOfReference = 0.5e-6;

std::vector<Row> read_rows(const std::string& file) {
  std::vector<Row> rows;
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);  // the heading
  while (std::getline(in, line)) {
    std::istringstream fields(line);
    Row row;
    std::string neighbourhood, agents, cost;
    if (std::getline(fields, row.map, ',') && std::getline(fields, neighbourhood, ',') &&
        std::getline(fields, row.task, ',') && std::getline(fields, agents, ',') &&
        std::getline(fields, cost, ',') && !cost.empty()) {
      row.neighbourhood = std::stoi(neighbourhood);
      row.agents = std::stoul(agents);
      row.cost = std::stod(cost);
      rows.push_back(row);
    }
  }
  return rows;
}

/// Discs of radius sqrt(2)/4 and speed 1.
Instance read_instance(const std::filesystem::path& folder, const Row& row, double resolution) {
  auto map = read_map_xml(folder / "map.xml", resolution).value();
  const auto task = read_task_xml(folder / ("task_" + row.task + ".xml")).value();
  const Length radius = quantise_radius(std::sqrt(2.0) / 4, resolution).value();
  if (const auto* cells = std::get_if<OccupancyGrid>(&map.map)) {
    const auto grid = GridRoadmap::make(*cells, row.neighbourhood, radius, resolution).value();
    return Instance::make(grid.roadmap(),
                          agents_of(task, row.agents, grid, radius, kUnitSpeed).value(), resolution)
        .value();
  }
  const auto roadmap = std::make_shared<const Roadmap>(std::get<Roadmap>(std::move(map.map)));
  return Instance::make(roadmap, agents_of(task, row.agents, *roadmap, radius, kUnitSpeed).value(),
                        resolution)
      .value();
}

/// What rounding can change in the cost of this plan: half a tick per move, one per wait.
double rounding(const Plan& plan, double resolution) {
  double ticks = 0;
  for (const Path& path : plan.paths)
    for (std::size_t k = 0; k + 1 < path.size(); ++k)
      ticks += path[k].depart > path[k].arrive ? 1.5 : 0.5;
  return ticks * resolution;
}

struct Count {
  int finished = 0;
  int within_1e4 = 0;  ///< Of these, as far from the reference as 1e-4 at most.
  int lower = 0;       ///< Of these, lower than the reference by more than rounding explains.
  double farthest = 0;
};

class ContinuousBenchmark : public testing::TestWithParam<double> {
 protected:
  /// False if a limit ended the search.
  bool compare(const std::filesystem::path& folder, const Row& row, Count& count) {
    const double resolution = GetParam();
    const Instance instance = read_instance(folder, row, resolution);
    SolveOptions options;
    options.limits.cpu_s = 2;
    const SolveOutcome outcome = solve(instance, options).value();
    const std::string name = row.map + ", k = " + std::to_string(row.neighbourhood) + ", task " +
                             row.task + ", " + std::to_string(row.agents) + " agents";
    EXPECT_FALSE(outcome.internal_error) << name;
    EXPECT_NE(outcome.status, Status::infeasible) << name;
    const double bound = in_input_units(outcome.lower_bound, resolution);
    if (outcome.status != Status::optimal) {
      EXPECT_LT(bound, row.cost + 1e-3) << name;
      std::cout << name << ": " << to_string(outcome.stop) << " limit, lower bound " << bound
                << " of " << row.cost << "\n";
      return false;
    }
    EXPECT_TRUE(verify(instance, *outcome.plan).valid()) << name;
    EXPECT_EQ(cost(*outcome.plan, options.objective), outcome.lower_bound) << name;
    const double tolerance = rounding(*outcome.plan, resolution) + kPrecisionOfReference;
    EXPECT_LE(bound, row.cost + tolerance) << name;
    // Otherwise our plan, which has been verified, is the better one.
    if (bound < row.cost - tolerance) {
      ++count.lower;
      std::cout << name << ": " << bound << ", the reference has " << row.cost << "\n";
    }
    ++count.finished;
    const double distance = std::abs(bound - row.cost);
    count.within_1e4 += distance <= 1e-4 ? 1 : 0;
    count.farthest = std::max(count.farthest, distance);
    return true;
  }
};

TEST_P(ContinuousBenchmark, FindsTheReferenceCosts) {
  const auto folder = data_folder();
  if (!folder) GTEST_SKIP() << "QUADRILLE_DATA is not set";
  const auto rows = read_rows(*folder + "/reference/continuous_sum_of_costs.csv");
  ASSERT_FALSE(rows.empty()) << "no reference rows in " << *folder;
  std::map<std::string, std::vector<Row>> ladders;
  for (const Row& row : rows)
    ladders[row.map + "/" + std::to_string(row.neighbourhood) + "/" + row.task].push_back(row);
  Count count;
  for (const auto& [name, ladder] : ladders) {
    const auto place = std::filesystem::path(*folder) / "mapf_r" / ladder[0].map;
    if (!std::filesystem::exists(place)) {
      std::cout << place << " is not there\n";
      continue;
    }
    for (const Row& row : ladder)
      if (!compare(place, row, count)) break;
  }
  std::cout << count.finished << " of " << rows.size() << " reference rows finished, "
            << count.within_1e4 << " within 1e-4, " << count.lower
            << " lower than rounding explains, farthest " << count.farthest << "\n";
  // Slow builds (scale below 1) finish fewer rows.
  EXPECT_GE(count.finished, std::min(60, static_cast<int>(scaled(60))));
}

INSTANTIATE_TEST_SUITE_P(Resolution, ContinuousBenchmark, testing::Values(1e-6, 1e-9),
                         [](const auto& param) { return param.param < 1e-8 ? "Fine" : "Default"; });

}  // namespace
}  // namespace quadrille::continuous::test
