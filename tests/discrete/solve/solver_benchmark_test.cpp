// SPDX-License-Identifier: MIT
// The MovingAI benchmark: the optimal costs that published solvers found, and limits on large
// instances. Needs QUADRILLE_DATA.
#include <gtest/gtest.h>
#include <malloc.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <memory>
#include <sstream>
#include <string>

#include "discrete/solve/limits.hpp"
#include "quadrille/discrete/movingai.hpp"
#include "support/environment.hpp"
#include "support/solver_cases.hpp"

namespace quadrille::discrete::support {
namespace {

using quadrille::support::data_folder;
using quadrille::support::scaled;

struct Row {
  std::string map, scenario;
  std::size_t agents = 0;
  Cost optimum = 0;
};

std::vector<Row> read_rows(const std::string& file) {
  std::vector<Row> rows;
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);  // the heading
  while (std::getline(in, line)) {
    std::istringstream fields(line);
    Row row;
    std::string agents, optimum;
    if (std::getline(fields, row.map, ',') && std::getline(fields, row.scenario, ',') &&
        std::getline(fields, agents, ',') && std::getline(fields, optimum, ',')) {
      if (optimum.empty()) continue;  // nobody solved it
      row.agents = std::stoul(agents);
      row.optimum = std::stoll(optimum);
      rows.push_back(row);
    }
  }
  return rows;
}

Instance read_instance(const std::string& folder, const Row& row) {
  const std::filesystem::path data = folder + "/movingai";
  const auto map = read_map(data / "maps" / (row.map + ".map"));
  const auto scenario =
      read_scenario(data / "scens" / (row.map + "-random-" + row.scenario + ".scen"));
  const auto graph = std::make_shared<const Graph>(map.value().graph());
  return make_instance(graph, scenario.value(), row.agents).value();
}

/// Solves the reference rows of a map with one system, from few agents to many, each for at most
/// `seconds` of CPU time, until a row is not finished. Returns the number of finished rows.
int compare_rows(const std::vector<Row>& rows, const std::string& folder, TunedOptions options,
                 double seconds) {
  int finished = 0;
  options.limits = {};
  options.limits.cpu_s = seconds;
  for (const Row& row : rows) {
    const Instance instance = read_instance(folder, row);
    const SolveOutcome outcome = solve(instance, options).value();
    const std::string name = row.map + " scenario " + row.scenario + ", " +
                             std::to_string(row.agents) + " agents, " +
                             std::string(to_string(options.system));
    EXPECT_EQ(find_inconsistency(instance, options, outcome), "") << name;
    EXPECT_NE(outcome.status, Status::infeasible) << name;
    EXPECT_LE(outcome.lower_bound, row.optimum) << name;
    if (outcome.plan) {
      EXPECT_GE(*outcome.cost, row.optimum) << name;
    }
    if (outcome.status != Status::optimal) {
      std::cout << name << ": " << to_string(outcome.stop) << " limit, lower bound "
                << outcome.lower_bound << " of " << row.optimum << "\n";
      break;
    }
    EXPECT_EQ(*outcome.cost, row.optimum) << name;
    ++finished;
  }
  return finished;
}

struct Entry {
  const char* name;
  std::size_t system;  // index in all_systems
  double seconds;      // of CPU time per row
  int least;           // rows that have to be finished at scale 1
};

std::ostream& operator<<(std::ostream& out, const Entry& entry) { return out << entry.name; }

class SolverBenchmark : public testing::TestWithParam<Entry> {};

TEST_P(SolverBenchmark, FindsTheReferenceCosts) {
  const auto folder = data_folder();
  if (!folder) GTEST_SKIP() << "QUADRILLE_DATA is not set";
  const auto rows = read_rows(*folder + "/reference/discrete_sum_of_costs.csv");
  ASSERT_FALSE(rows.empty()) << "no reference rows in " << *folder;
  std::map<std::string, std::vector<Row>> by_map;
  for (const Row& row : rows) by_map[row.map].push_back(row);
  int finished = 0;
  for (const auto& [map, of_map] : by_map)
    finished +=
        compare_rows(of_map, *folder, all_systems(Objective::sum_of_costs)[GetParam().system],
                     GetParam().seconds);
  std::cout << GetParam().name << ": " << finished << " of " << rows.size()
            << " reference rows finished\n";
  // Slow builds (scale below 1) finish fewer rows.
  EXPECT_GE(finished,
            std::min(GetParam().least, static_cast<int>(scaled(30)) * GetParam().least / 30));
}

INSTANTIATE_TEST_SUITE_P(System, SolverBenchmark,
                         testing::Values(Entry{"dpll", 0, 1, 50}, Entry{"propagate", 2, 0.5, 30},
                                         Entry{"fractions", 4, 0.5, 25},
                                         Entry{"smt_cbs", 6, 0.5, 25},
                                         Entry{"mdd_sat", 7, 0.5, 25}),
                         [](const auto& entry) { return entry.param.name; });

// Those whose plans and gaps docs/performance.md shows.
const Row kLarge[] = {{"den520d", "1", 1000},        {"warehouse-20-40-10-2-1", "1", 1000},
                      {"empty-48-48", "1", 600},     {"Paris_1_256", "1", 1000},
                      {"orz900d", "1", 500},         {"brc202d", "1", 500},
                      {"random-64-64-20", "1", 500}, {"random-32-32-20", "1", 300},
                      {"random-32-32-20", "1", 400}, {"room-64-64-8", "1", 400},
                      {"maze-32-32-4", "1", 100}};

double resident_mib() {
  std::size_t all = 0, resident = 0;  // in pages
  std::ifstream("/proc/self/statm") >> all >> resident;
  return static_cast<double>(resident) * 4096 / (1 << 20);
}

TEST(LargeBenchmark, LimitsHold) {
  const auto folder = data_folder();
  if (!folder) GTEST_SKIP() << "QUADRILLE_DATA is not set";
  for (const Row& row : kLarge) {
    SCOPED_TRACE(row.map);
    const Instance instance = read_instance(*folder, row);
    for (const double seconds : {0.1, 0.6, 2.0}) {
      TunedOptions options;
      options.limits.cpu_s = seconds;
      const auto [outcome, cpu_s] = run(instance, options);
      EXPECT_EQ(outcome.stop, StopReason::cpu_time) << to_string(outcome.stop);
      EXPECT_LT(cpu_s, seconds + kSoon);
    }
    // What has been added is looked at from time to time, hence the margin.
    for (const std::int64_t mib : {4, 30}) {
      TunedOptions options;
      options.limits.cpu_s = 10;
      options.limits.memory_mib = mib;
      malloc_trim(0);
      // The peak is that of the process, earlier solves included.
      const double most = std::max(peak_rss_mib(), resident_mib() + static_cast<double>(mib) + 30);
      const auto [outcome, cpu_s] = run(instance, options);
      EXPECT_LE(peak_rss_mib(), most);
      EXPECT_NE(outcome.stop, StopReason::none);
    }
  }
}

}  // namespace
}  // namespace quadrille::discrete::support
