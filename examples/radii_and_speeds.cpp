// SPDX-License-Identifier: MIT
// A fast agent behind a slow one: whether it follows or overtakes depends on speeds and radii.
#include <iostream>
#include <memory>
#include <quadrille/continuous/solver.hpp>

using namespace quadrille;
using namespace quadrille::continuous;

namespace {

/// A road from vertex 0 over 1, 2 and 3 to 4 or 6, and a way around its middle over 5.
std::shared_ptr<const Roadmap> make_roadmap() {
  const std::vector<Point> points = {{0, 0},    {1000, 0},    {2000, 0},    {6000, 0},
                                     {8000, 0}, {4000, 1500}, {6000, -2000}};
  std::vector<Edge> edges;
  for (const auto& [from, to] :
       {std::pair{0U, 1U}, {1U, 2U}, {2U, 3U}, {3U, 4U}, {2U, 5U}, {5U, 3U}, {3U, 6U}})
    edges.push_back({VertexId(from), VertexId(to), std::nullopt});
  return std::make_shared<const Roadmap>(Roadmap::make(points, edges).value());
}

void try_out(const char* title, Length radius, Speed leader_speed) {
  const auto instance =
      Instance::make(make_roadmap(), {{VertexId(1), VertexId(4), Disc{radius}, leader_speed},
                                      {VertexId(0), VertexId(6), Disc{100}, 2 * kUnitSpeed}});
  std::cout << title << ": ";
  if (!instance) {  // overlapping starts, goals out of reach, ...
    std::cout << instance.error().message << "\n";
    return;
  }
  const SolveOutcome outcome = solve(*instance, {}).value();
  std::cout << to_string(outcome.status) << ", sum of costs " << outcome.cost.value_or(-1);
  if (!outcome.plan) {
    std::cout << "\n";
    return;
  }
  bool detour = false;
  for (const Stop& stop : outcome.plan->paths[AgentId(1)])
    detour = detour || stop.vertex == VertexId(5);
  std::cout << ", the fast agent takes the " << (detour ? "detour" : "straight road") << "\n";
}

}  // namespace

int main() {
  // Speeds are in millionths of a length unit per tick.
  try_out("small leader, same speed", 100, 2 * kUnitSpeed);
  try_out("small leader, half the speed", 100, kUnitSpeed);
  try_out("small leader, a tenth of the speed", 100, kUnitSpeed / 5);
  try_out("large leader, half the speed", 800, kUnitSpeed);
  try_out("leader that does not fit", 901, kUnitSpeed);
}
