// SPDX-License-Identifier: MIT
// Reads a map and a scenario, finds a plan of least sum of costs, and replays it.
//
// usage: solve_map MAP SCENARIO AGENTS
#include <charconv>
#include <iostream>
#include <memory>
#include <quadrille/discrete/movingai.hpp>
#include <quadrille/discrete/solver.hpp>
#include <quadrille/discrete/verify.hpp>
#include <string_view>

using namespace quadrille;
using namespace quadrille::discrete;

namespace {

/// Errors are values: each step either gives its result or says what was wrong, with file and line.
Result<Instance> read(const char* map_file, const char* scenario_file, std::size_t agents) {
  const auto map = read_map(map_file);
  if (!map) return map.error();
  const auto scenario = read_scenario(scenario_file);
  if (!scenario) return scenario.error();
  return make_instance(std::make_shared<const Graph>(map->graph()), *scenario, agents);
}

}  // namespace

int main(int argc, char** argv) {
  std::size_t agents = 0;
  const std::string_view number = argc == 4 ? argv[3] : "";
  if (std::from_chars(number.begin(), number.end(), agents).ec != std::errc()) {
    std::cerr << "usage: solve_map MAP SCENARIO AGENTS\n";
    return 2;
  }
  const auto instance = read(argv[1], argv[2], agents);
  if (!instance) {
    std::cerr << instance.error().to_string() << "\n";
    return 1;
  }

  const SolveOutcome outcome = solve(*instance, {}).value();
  std::cout << to_string(outcome.status) << "\n";
  if (!outcome.plan) {
    std::cout << outcome.explanation << "\n";
    return 1;
  }
  // `solve` has replayed the plan already; this is how to check one from elsewhere.
  const VerifyReport report = verify(*instance, *outcome.plan);
  std::cout << "sum of costs " << report.sum_of_costs << ", lower bound " << outcome.lower_bound
            << "\n";
  for (const Violation& violation : report.violations) std::cout << violation.message << "\n";
  for (const AgentId i : instance->agent_ids()) {
    const Agent& task = instance->agents()[i];
    const Path& path = outcome.plan->paths[i];
    std::cout << "agent " << i.value() << " from " << vertex_name(instance->graph(), task.start)
              << " to " << vertex_name(instance->graph(), path.back()) << "\n";
  }
  return report.valid() ? 0 : 1;
}
