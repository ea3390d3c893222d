// SPDX-License-Identifier: MIT
// A fleet that works for five minutes: tasks keep coming, and robots are late.
#include <iostream>
#include <quadrille/fleet/dispatcher.hpp>

using namespace quadrille;
using namespace quadrille::fleet;
using namespace quadrille::units;

int main() {
  RoadmapBuilder roads;  // 4 x 3 crossings, five metres apart
  for (std::size_t i = 0; i < 12; ++i)
    roads.vertex(5_m * static_cast<double>(i % 4), 5_m * static_cast<double>(i / 4));
  for (std::size_t i = 0; i < 12; ++i) {
    if (i % 4 < 3) roads.road(VertexId(i), VertexId(i + 1));
    if (i / 4 < 2) roads.road(VertexId(i), VertexId(i + 4));
  }
  Fleet fleet(roads.build().value());
  for (std::size_t i = 0; i < 4; ++i)
    fleet.robot({.body = Disc(0.6_m), .speed = 1_mps}).from(VertexId(i));
  Dispatcher dispatcher = Dispatcher::make(fleet).value();
  std::size_t done = 0, next = 0;
  for (std::size_t call = 0; call < 1'500; ++call) {
    for (const AgentId robot : fleet.robot_ids())
      if (dispatcher.num_tasks(robot) == 0 &&
          dispatcher.assign(robot, VertexId(next = (next + 7) % 12), {.service = 2_s}))
        return 1;
    done += dispatcher.tick(200_ms).served.size();
    for (const AgentId robot : fleet.robot_ids())  // each one stops now and then
      if ((call / 5 + robot.index()) % 7 > 0 && dispatcher.report(robot, dispatcher.limit(robot)))
        return 1;
  }
  std::cout << done << " tasks are done by " << to_string(dispatcher.now()) << "\n";
}
