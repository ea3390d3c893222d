// SPDX-License-Identifier: MIT
#include <iostream>
#include <quadrille/continuous/instance.hpp>
#include <quadrille/continuous/roadmap.hpp>
#include <quadrille/continuous/solver.hpp>
#include <quadrille/continuous/verify.hpp>
#include <quadrille/discrete/graph.hpp>
#include <quadrille/discrete/instance.hpp>
#include <quadrille/discrete/solver.hpp>
#include <quadrille/discrete/verify.hpp>

namespace {

using namespace quadrille;

/// Two agents change places along a row of three cells with one cell beside its middle.
bool on_a_grid() {
  using namespace quadrille::discrete;
  const auto instance = Instance::make(Graph::grid(3, 2, {true, true, true, false, true, false}),
                                       {{VertexId(0), VertexId(2)}, {VertexId(2), VertexId(0)}});
  if (!instance) {
    std::cerr << instance.error().to_string() << "\n";
    return false;
  }
  const SolveOutcome outcome = solve(*instance, {}).value();
  if (!outcome.plan || !verify(*instance, *outcome.plan).valid()) return false;
  std::cout << to_string(outcome.status) << ", sum of costs " << *outcome.cost << "\n";
  return true;
}

/// A disc and a square cross each other's way.
bool on_a_roadmap() {
  using namespace quadrille::continuous;
  const auto roadmap =
      Roadmap::make({{0, 0}, {2000, 0}, {1000, -1000}, {1000, 1000}},
                    {{VertexId(0), VertexId(1), {}}, {VertexId(2), VertexId(3), {}}});
  const auto square = ConvexPolygon::make({{-100, -100}, {100, -100}, {100, 100}, {-100, 100}});
  if (!roadmap || !square) return false;
  const auto instance = Instance::make(*roadmap, {{VertexId(0), VertexId(1), Disc{100}, kUnitSpeed},
                                                  {VertexId(2), VertexId(3), *square, kUnitSpeed}});
  if (!instance) return false;
  const SolveOutcome outcome = solve(*instance, {}).value();
  if (!outcome.plan || !verify(*instance, *outcome.plan).valid()) return false;
  std::cout << to_string(outcome.status) << ", after " << *outcome.cost << " ticks in sum\n";
  return true;
}

}  // namespace

int main() { return on_a_grid() && on_a_roadmap() ? 0 : 1; }
