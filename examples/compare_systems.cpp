// SPDX-License-Identifier: MIT
// An instance on a graph that is no grid, solved by all systems for both objectives.
#include <iostream>
#include <quadrille/discrete/solver.hpp>
#include <vector>

using namespace quadrille;
using namespace quadrille::discrete;

namespace {

/// A ring of `size` vertices, with a siding beside vertex 0 and one edge across.
Result<Graph> ring_with_siding(std::size_t size) {
  std::vector<Graph::Edge> edges;
  for (std::size_t v = 0; v < size; ++v) edges.emplace_back(VertexId(v), VertexId((v + 1) % size));
  edges.emplace_back(VertexId(0), VertexId(size));          // the siding
  edges.emplace_back(VertexId(2), VertexId(size / 2 + 2));  // the edge across
  return Graph::make(size + 1, edges);
}

}  // namespace

int main() {
  constexpr std::size_t kSize = 9;
  auto graph = ring_with_siding(kSize);
  if (!graph) {
    std::cerr << graph.error().to_string() << "\n";
    return 1;
  }
  // Three agents go about half way round; the fourth one is in their way and has to come back.
  const auto instance = Instance::make(std::move(graph.value()), {{VertexId(1), VertexId(5)},
                                                                  {VertexId(5), VertexId(1)},
                                                                  {VertexId(8), VertexId(3)},
                                                                  {VertexId(0), VertexId(0)}});
  if (!instance) {
    std::cerr << instance.error().to_string() << "\n";
    return 1;
  }
  for (const Objective objective : {Objective::sum_of_costs, Objective::makespan})
    for (const System system : {System::dpll, System::dpll_mdd, System::smt_cbs, System::mdd_sat}) {
      SolveOptions options;
      options.objective = objective;
      options.system = system;
      if (system == System::dpll_mdd) options.mdd.check = parse_check_schedule("1/2,3/4").value();
      const SolveOutcome outcome = solve(*instance, options).value();
      std::cout << to_string(objective) << " by " << to_string(system) << ": "
                << to_string(outcome.status);
      if (outcome.cost) std::cout << ", " << *outcome.cost;
      std::cout << "\n";
    }
}
