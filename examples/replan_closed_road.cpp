// SPDX-License-Identifier: MIT
// A road is closed while robots are under way, and opened again before they have got far: each time
// they plan again from where they are, and each one finishes its move.
#include <iostream>
#include <quadrille/fleet/solver.hpp>

using namespace quadrille;
using namespace quadrille::fleet;
using namespace quadrille::units;

namespace {

/// A grid of 4 x 3 crossings, five metres apart.
RoadmapBuilder make_roads() {
  RoadmapBuilder roads({.length = 1_mm, .time = 100_ms});
  for (std::size_t i = 0; i < 12; ++i)
    roads.vertex(5_m * static_cast<double>(i % 4), 5_m * static_cast<double>(i / 4),
                 {static_cast<char>('A' + i / 4), static_cast<char>('1' + i % 4)});
  for (std::size_t i = 0; i < 12; ++i) {
    if (i % 4 < 3) roads.road(VertexId(i), VertexId(i + 1));
    if (i / 4 < 2) roads.road(VertexId(i), VertexId(i + 4));
  }
  return roads;
}

void print(const Fleet& fleet, const TimedPlan& plan) {
  for (const AgentId robot : plan.robot_ids()) {
    std::cout << "  " << plan[robot].name();
    const char* separator = ": ";
    for (const Stop& stop : plan[robot].stops()) {
      std::cout << separator << fleet.place_name(stop.vertex) << " " << to_string(stop.arrive);
      separator = ", ";
    }
    std::cout << "\n";
  }
}

}  // namespace

int main() {
  RoadmapBuilder roads = make_roads();
  Fleet fleet(roads.build().value());
  const auto at = [&](const char* name) { return fleet.roadmap().find(name).value(); };
  const auto add = [&](const char* name, const char* from, const char* to) {
    return fleet.robot({.name = name, .body = Disc(0.6_m), .speed = 1_mps})
        .from(at(from))
        .to(at(to));
  };
  add("red", "B1", "B4");
  add("green", "B4", "B1");
  add("blue", "A1", "C4");

  SolveOutcome outcome = solve(fleet).value();
  std::cout << outcome.summary() << "\n";
  const TimedPlan before = outcome.plan.value();
  print(fleet, before);

  const Seconds now = 3_s;
  roads.close(at("B2"), at("B3"));
  fleet.set_roadmap(roads.build().value());
  std::cout << "at " << to_string(now) << " the road from B2 to B3 is closed\n";
  // Each one begins at a vertex, or in the middle of a move.
  for (const AgentId robot : before.robot_ids()) fleet[robot].from(before[robot], now);
  outcome = solve(fleet).value();
  std::cout << "from " << to_string(now) << " on, " << outcome.summary() << "\n";
  const TimedPlan detour = outcome.plan.value();
  print(fleet, detour);

  const Seconds later = 1_s;  // All are within the same moves.
  roads.road(at("B2"), at("B3"));
  fleet.set_roadmap(roads.build().value());
  std::cout << "another " << to_string(later) << " later it is open again\n";
  for (const AgentId robot : detour.robot_ids()) fleet[robot].from(detour[robot], later);
  outcome = solve(fleet).value();
  std::cout << "from then on, " << outcome.summary() << "\n";
  print(fleet, outcome.plan.value());
}
