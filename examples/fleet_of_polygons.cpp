// SPDX-License-Identifier: MIT
// Long forklifts and a round robot in a warehouse: bodies in metres, names, and what each one does.
#include <iostream>
#include <quadrille/fleet/solver.hpp>

using namespace quadrille;
using namespace quadrille::fleet;
using namespace quadrille::units;

namespace {

/// Three shelves; aisles lie between them, and a wide way at either end.
Roadmap make_warehouse() {
  RoadmapBuilder roads({.length = 1_mm, .time = 50_ms});
  std::vector<VertexId> north, south;
  for (const Metres x : {0_m, 3_m, 6_m, 9_m}) {
    north.push_back(roads.vertex(x, 0_m));
    south.push_back(roads.vertex(x, 8_m));
    const VertexId middle = roads.vertex(x, 4_m, "aisle " + std::to_string(north.size()));
    roads.road(north.back(), middle).road(middle, south.back());
  }
  for (std::size_t i = 1; i < north.size(); ++i)
    roads.road(north[i - 1], north[i]).road(south[i - 1], south[i]);
  roads.road(north.front(), roads.vertex(-3_m, 0_m, "dock"));
  roads.road(south.back(), roads.vertex(12_m, 8_m, "gate"));
  return roads.build().value();
}

/// A rectangle around the robot's position; it keeps its orientation.
Polygon rectangle(Metres length, Metres width) {
  const Metres x = length / 2, y = width / 2;
  return Polygon({{-x, -y}, {x, -y}, {x, y}, {-x, y}});
}

}  // namespace

int main() {
  Fleet fleet(make_warehouse());
  const auto place = [&](const char* name) { return fleet.roadmap().find(name).value(); };
  const auto forklift1 =
      fleet.robot({.name = "forklift 1", .body = rectangle(2.4_m, 1.2_m), .speed = 1.5_mps})
          .from(place("dock"))
          .to(place("gate"));
  fleet.robot({.name = "forklift 2", .body = rectangle(2.4_m, 1.2_m), .speed = 1.5_mps})
      .from(place("gate"))
      .to(place("dock"));
  fleet.robot({.name = "cleaner", .body = Disc(0.4_m), .speed = 0.5_mps})
      .from(place("aisle 2"))
      .to(place("aisle 3"));

  const auto outcome = solve(fleet);
  if (!outcome) {  // A robot without a goal, a polygon that is not convex, ...
    std::cerr << outcome.error().message << "\n";
    return 1;
  }
  std::cout << outcome->summary() << "\n";
  if (!outcome->plan) return 1;
  const TimedPlan& plan = *outcome->plan;
  std::cout << plan.summary();

  std::cout << plan[forklift1].name() << " every 2 s:";
  for (const Sample& sample : plan[forklift1].samples(0.5_Hz))
    std::cout << " (" << sample.position.x.value() << ", " << sample.position.y.value() << ")";
  const auto& least = *plan.least_clearance();
  std::cout << "\n"
            << fleet.name(least.robot) << " and " << fleet.name(least.other)
            << " come closest to each other\n";
}
