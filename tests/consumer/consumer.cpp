// SPDX-License-Identifier: MIT
#include <iostream>
#include <quadrille/discrete/graph.hpp>
#include <quadrille/discrete/instance.hpp>
#include <quadrille/discrete/solver.hpp>
#include <quadrille/discrete/verify.hpp>

int main() {
  using namespace quadrille;
  using namespace quadrille::discrete;
  // Two agents change places along a row of three cells with one cell beside its middle.
  const auto instance = Instance::make(Graph::grid(3, 2, {true, true, true, false, true, false}),
                                       {{VertexId(0), VertexId(2)}, {VertexId(2), VertexId(0)}});
  if (!instance) {
    std::cerr << instance.error().to_string() << "\n";
    return 1;
  }
  const SolveOutcome outcome = solve(*instance, {}).value();
  if (!outcome.plan || !verify(*instance, *outcome.plan).valid()) return 1;
  std::cout << to_string(outcome.status) << ", sum of costs " << *outcome.cost << "\n";
}
