// SPDX-License-Identifier: MIT
// Forklifts that turn on the spot, one of them slowly, and a tractor that does not: poses, which
// are places with headings, as vertices.
#include <iostream>
#include <optional>
#include <quadrille/fleet/pose_builder.hpp>
#include <quadrille/fleet/solver.hpp>
#include <string>
#include <vector>

using namespace quadrille;
using namespace quadrille::fleet;
using namespace quadrille::units;

namespace {

/// Two aisles between two ways, and a ring of gentle bends around one end.
RoadmapBuilder make_places() {
  RoadmapBuilder roads({.length = 1_mm, .time = 100_ms});
  const VertexId dock = roads.vertex(0_m, 0_m, "dock"), gate = roads.vertex(6_m, 0_m, "gate");
  const VertexId left = roads.vertex(0_m, 6_m, "left"), right = roads.vertex(6_m, 6_m, "right");
  const VertexId front = roads.vertex(3_m, 0_m, "front"), back = roads.vertex(3_m, 6_m, "back");
  roads.road(dock, front).road(front, gate).road(left, back).road(back, right);
  roads.road(dock, left).road(gate, right).road(front, back);
  // From the gate round to the right end of the other way, by steps of 45 degrees.
  const std::vector<VertexId> ring{
      roads.vertex(8_m, 0_m, "bend 1"), roads.vertex(10_m, 2_m, "bend 2"),
      roads.vertex(10_m, 4_m, "bend 3"), roads.vertex(8_m, 6_m, "bend 4")};
  roads.road(gate, ring.front()).road(ring.back(), right);
  for (std::size_t i = 1; i < ring.size(); ++i) roads.road(ring[i - 1], ring[i]);
  return roads;
}

}  // namespace

int main() {
  RoadmapBuilder places = make_places();
  const Group heavy = places.group(), tractors = places.group();
  const Roadmap roads = places.build().value();
  const auto made = PoseBuilder(roads, 90_degps)     // a quarter turn takes a second,
                        .turn_rate(heavy, 30_degps)  // with a heavy load three;
                        .car(tractors, 50_deg)       // a tractor bends, but does not turn
                        .build();
  if (!made) {  // A lane that goes straight up, ...
    std::cerr << made.error().message << "\n";
    return 1;
  }
  const PoseRoadmap& poses = *made;
  const auto place = [&](const char* name) { return roads.find(name).value(); };

  Fleet fleet(poses.roadmap());
  const auto add = [&](const char* name, std::optional<Group> group, const char* from,
                       Radians heading, const char* to) {
    return fleet.robot({.name = name, .body = Disc(0.6_m), .speed = 1_mps, .group = group})
        .from(poses.facing(place(from), heading))
        .to_any(poses.any_heading(place(to)));
  };
  const Robot forklift = add("forklift", {}, "dock", 0_deg, "back");
  add("heavy forklift", heavy, "left", 0_deg, "front");
  const Robot tractor = add("tractor", tractors, "front", 0_deg, "right");
  // It has to face down when it has arrived.
  fleet.robot({.name = "picker", .body = Disc(0.6_m), .speed = 1_mps})
      .from(poses.facing(place("right"), 180_deg))
      .to(poses.facing(place("left"), 270_deg));

  const auto outcome = solve(fleet);
  if (!outcome) {
    std::cerr << outcome.error().message << "\n";
    return 1;
  }
  std::cout << outcome->summary() << "\n";
  if (!outcome->plan) return 1;
  std::cout << outcome->plan->summary();
  for (const AgentId robot : {forklift.id(), tractor.id()}) {
    const TimedPath& path = (*outcome->plan)[robot];
    std::cout << path.name() << ":\n";
    for (const Stop& stop : path.stops())
      std::cout << "  " << to_string(stop.arrive) << " " << fleet.roadmap().name(stop.vertex)
                << "\n";
  }
}
