// SPDX-License-Identifier: MIT
// Compiled with CASE = 0, which has to succeed, and with each other one, which must not. More of
// this kind, and cheaper, is in units_test.cpp.
#include "quadrille/fleet/fleet.hpp"

using namespace quadrille::fleet;
using namespace quadrille::units;

void try_out(Fleet& fleet, RoadmapBuilder& roads) {
#if CASE == 0
  roads.vertex(1_m, 2.5_m);
  roads = RoadmapBuilder({.length = 1_mm, .time = 10_ms});
  fleet.robot({.name = "a", .body = Disc(0.35_m), .speed = 0.8_mps});
  const Group small = roads.group();
  roads.lane(quadrille::VertexId(0), quadrille::VertexId(1), {.only = {small}});
  fleet[quadrille::AgentId(0)].release(3_s).deadline(4.5_s).leaves();
  fleet.obstacle({.body = Disc(0.35_m), .path = {{{1_m, 2_m}, 0_s, 3_s}}});
#elif CASE == 1
  roads.vertex(1, 2.5);
#elif CASE == 2
  roads = RoadmapBuilder({.length = 0.001, .time = 0.01});
#elif CASE == 3
  fleet.robot({.name = "a", .body = Disc(0.35), .speed = 0.8_mps});
#elif CASE == 4
  fleet[quadrille::AgentId(0)].release(3);
#elif CASE == 5
  fleet[quadrille::AgentId(0)].deadline(4.5);
#elif CASE == 6
  roads.lane(quadrille::VertexId(0), quadrille::VertexId(1), {.only = {1}});
#elif CASE == 7
  fleet.obstacle({.body = Disc(0.35_m), .path = {{{1_m, 2_m}, 0, 3}}});
#elif CASE == 8
  fleet[quadrille::AgentId(0)].from_edge(quadrille::VertexId(0), quadrille::VertexId(1), 0.4_m);
#endif
}
