// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "quadrille/continuous/generator.hpp"
#include "quadrille/continuous/solver.hpp"
#include "support/generators.hpp"
#include "support/solver_cases.hpp"

namespace quadrille::support {

/// Every system of the discrete domain with both objectives, alone and in a portfolio.
inline std::vector<discrete::SolveOptions> discrete_systems() {
  std::vector<discrete::SolveOptions> all;
  for (const Objective objective : {Objective::sum_of_costs, Objective::makespan})
    for (const discrete::SolveOptions& options : discrete::support::all_systems(objective))
      all.push_back(options);
  all.emplace_back();
  all.back().threads = 3;
  return all;
}

/// The same of the continuous domain.
inline std::vector<continuous::SolveOptions> continuous_systems() {
  std::vector<continuous::SolveOptions> all;
  for (const Objective objective : {Objective::sum_of_costs, Objective::makespan})
    for (const continuous::System system :
         {continuous::System::dpll, continuous::System::smt_cbs}) {
      all.emplace_back();
      all.back().objective = objective;
      all.back().system = system;
      all.back().route_work = all.back().joint_work = 0;
    }
  return all;
}

inline discrete::Instance grid(std::size_t size, std::size_t num_agents, std::uint64_t seed) {
  Random random(seed);
  return discrete::support::random_grid(random, {size, size, 0, num_agents, num_agents});
}

inline continuous::Instance discs(std::size_t num_vertices, std::size_t num_agents,
                                  std::uint64_t seed) {
  continuous::RandomInstanceOptions options;
  options.num_vertices = num_vertices;
  options.num_agents = num_agents;
  options.mixed = true;
  return continuous::random_instance(options, seed).value();
}

}  // namespace quadrille::support
