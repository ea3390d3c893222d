// SPDX-License-Identifier: MIT
#include <iostream>
#include <quadrille/discrete/graph.hpp>
#include <quadrille/discrete/instance.hpp>

int main() {
  using namespace quadrille;
  using namespace quadrille::discrete;
  const auto instance =
      Instance::make(Graph::grid(2, 2, {true, true, true, false}),
                     {{VertexId(0), VertexId(1)}, {VertexId(1), VertexId(2)}});
  if (!instance) {
    std::cerr << instance.error().to_string() << "\n";
    return 1;
  }
  std::cout << instance->graph().num_vertices() << " vertices, " << instance->num_agents()
            << " agents\n";
}
