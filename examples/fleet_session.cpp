// SPDX-License-Identifier: MIT
// A fleet that is solved again after each change, while time goes on.
#include <iostream>
#include <quadrille/fleet/session.hpp>

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
    fleet.robot({.body = Disc(0.6_m), .speed = 1_mps}).from(VertexId(i)).to(VertexId(11 - i));
  Session session = Session::make(fleet).value();
  for (std::size_t k = 0; k < 5; ++k) {
    const SolveOutcome outcome = session.solve().value();
    std::cout << "at " << to_string(session.now()) << " " << outcome.summary() << "\n";
    if (!outcome.plan || session.advance_to(session.now() + 3_s, *outcome.plan)) return 1;
    if (session.assign(fleet.name(AgentId(k % 4)), VertexId(k))) return 1;  // one has a new goal
    if (k == 2 && session.close(VertexId(5), VertexId(6))) return 1;        // and a lane is closed
  }
}
