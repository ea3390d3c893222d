// SPDX-License-Identifier: MIT
// From a nav graph of Open-RMF to orders of VDA 5050 with headings: forklifts, longer than they are
// wide, that turn on the spot.
#include <cmath>
#include <cstdio>
#include <iostream>
#include <numbers>
#include <quadrille/execution/precedences.hpp>
#include <quadrille/execution/releaser.hpp>
#include <quadrille/fleet/nav_graph.hpp>
#include <quadrille/fleet/pose_builder.hpp>
#include <quadrille/fleet/solver.hpp>
#include <string>

using namespace quadrille;
using namespace quadrille::fleet;
using namespace quadrille::units;

namespace {

constexpr Resolution kResolution{.length = 1_mm, .time = 100_ms};

/// An order in JSON, of which `released` moves may be made at once. A turn is an edge between two
/// nodes in one place. VDA 5050 has angles from -pi to pi.
std::string order(const TimedPath& path, const PoseRoadmap& poses, const Roadmap& places,
                  std::size_t released) {
  std::string nodes, edges;
  for (std::size_t k = 0; k < path.stops().size(); ++k) {
    const fleet::Stop& stop = path.stops()[k];
    const std::string id = places.name(poses.place(stop.vertex));
    const double theta = std::remainder(poses.heading(stop.vertex).value(), 2 * std::numbers::pi);
    const auto step = [&](std::size_t number, bool is_released) {
      return "\"sequenceId\": " + std::to_string(number) +
             ", \"released\": " + (is_released ? "true" : "false");
    };
    if (k > 0)
      edges += (k > 1 ? ",\n    " : "\n    ") + ("{\"edgeId\": \"edge " + std::to_string(k)) +
               "\", " + step(2 * k - 1, k <= released) + ", \"actions\": []}";
    char at[96];
    std::snprintf(at, sizeof at, "{\"x\": %g, \"y\": %g, \"theta\": %.3f, \"mapId\": \"L1\"}",
                  stop.place.x.value(), stop.place.y.value(), theta);
    nodes += (k > 0 ? ",\n    " : "\n    ") + ("{\"nodeId\": \"" + id) + "\", " +
             step(2 * k, k <= released) + ", \"nodePosition\": " + at + ", \"actions\": []}";
  }
  return "{\"version\": \"3.0.0\", \"manufacturer\": \"maker\", \"serialNumber\": \"" +
         path.name() + "\", \"orderId\": \"order of " + path.name() +
         "\", \"orderUpdateId\": 0,\n  \"nodes\": [" + nodes + "],\n  \"edges\": [" + edges + "]}";
}

}  // namespace

int main(int argc, char** argv) {
  // The places and lanes in metres, with their names, limits and passthrough points.
  RoadmapBuilder roads(kResolution);
  const auto added = add_nav_graph(roads, argc > 1 ? argv[1] : "hall.nav.yaml");
  if (!added) {
    std::cerr << added.error().to_string() << "\n";
    return 1;
  }
  const auto places = roads.build();
  if (!places) {
    std::cerr << places.error().to_string() << "\n";
    return 1;
  }
  const PoseRoadmap poses = PoseBuilder(*places, 45_degps).build().value();
  const Polygon forklift({{-0.6_m, -0.4_m}, {0.6_m, -0.4_m}, {0.6_m, 0.4_m}, {-0.6_m, 0.4_m}});
  Fleet fleet(poses.roadmap());
  const auto add = [&](const char* name, const char* from, Radians heading, const char* to) {
    fleet.robot({.name = name, .body = forklift, .speed = 1_mps})
        .from(poses.facing(places->find(from).value(), heading))
        .to_any(poses.any_heading(places->find(to).value()));
  };
  add("lift_1", "dock", 0_deg, "rack_3");
  add("lift_2", "rack_2", 270_deg, "dock");
  add("lift_3", "gate", 180_deg, "rack_1");

  const auto outcome = solve(fleet);
  if (!outcome || !outcome->plan) {
    std::cerr << (outcome ? outcome->summary() : outcome.error().message) << "\n";
    return 1;
  }
  std::cerr << outcome->summary() << "\n";
  // Who follows whom: a robot is released as far as it has to wait for nobody.
  const auto order_of_moves =
      execution::precedences(fleet.instance().value(), outcome->plan->in_units()).value();
  const execution::Releaser releaser(order_of_moves);
  for (const AgentId robot : fleet.robot_ids())
    std::cout << order((*outcome->plan)[robot], poses, *places, releaser.released(robot)) << "\n";
}
