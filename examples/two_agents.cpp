// SPDX-License-Identifier: MIT
#include <iostream>
#include <quadrille/discrete/solver.hpp>
using namespace quadrille::discrete;

int main() {
  // Two agents change places in a row of three cells; there is one more cell below its middle.
  const Graph graph = Graph::grid(3, 2, {true, true, true, false, true, false});
  const auto left = *graph.layout()->vertex_at({0, 0}), right = *graph.layout()->vertex_at({2, 0});
  const auto instance = Instance::make(graph, {{left, right}, {right, left}});
  if (!instance) std::cerr << instance.error().to_string() << "\n";
  if (!instance) return 1;
  // A plan, verified, or why there is none.
  const SolveOutcome outcome = solve(*instance, {}).value();
  std::cout << to_string(outcome.status) << ", sum of costs " << outcome.cost.value_or(-1) << "\n";
}
