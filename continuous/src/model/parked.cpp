// SPDX-License-Identifier: MIT
#include "model/parked.hpp"

#include <memory>
#include <set>

namespace quadrille::continuous {

PrivateStarts::PrivateStarts(const Instance& instance)
    : num_vertices_(instance.roadmap().num_vertices()),
      num_edges_(instance.roadmap().num_edges()),
      inner_(instance) {
  const Roadmap& roadmap = instance.roadmap();
  std::set<AgentId> parked;
  for (const auto& [i, j] : instance.parked_pairs()) parked.insert({i, j});
  std::vector<Point> positions = roadmap.positions();
  std::vector<Edge> edges = roadmap.edges();
  std::vector<ShapeId> shapes = roadmap.shapes();
  std::vector<Agent> agents = instance.agents().items();
  for (const AgentId i : parked) {
    Agent& agent = agents[i.index()];
    const VertexId start = agent.start;
    if (roadmap.in_edges(start).empty()) continue;
    const VertexId copy(positions.size());
    copied_.push_back(start);
    positions.push_back(roadmap.position(start));
    if (!shapes.empty()) shapes.push_back(roadmap.shape(start));
    for (const EdgeId e : roadmap.out_edges(start)) {
      copied_edges_.push_back(e);
      edges.push_back(roadmap.edge(e));
      edges.back().from = copy;
    }
    agent.start = copy;
    if (!agent.goals.contains(start)) continue;
    const auto goals = agent.goals.vertices();
    std::vector<VertexId> more(goals.begin(), goals.end());
    more.push_back(copy);
    agent.goals = Goals(std::move(more));
  }
  if (copied_.empty()) return;
  auto made = Roadmap::make(std::move(positions), std::move(edges), roadmap.lane_places(),
                            std::move(shapes));
  QUADRILLE_REQUIRE(made, "copies of vertices and edges are as good as these");
  auto inner = Instance::make(std::move(made).value(), std::move(agents), instance.resolution(), {},
                              instance.obstacles(), instance.now());
  QUADRILLE_REQUIRE(inner, "copies of starts are as good as these");
  inner_ = std::move(inner).value();
}

void PrivateStarts::enter(Plan& plan) const {
  for (const AgentId i : inner_.agent_ids())
    if (!plan.paths[i].empty()) plan.paths[i].front().vertex = inner_.agent(i).start;
}

void PrivateStarts::leave(Plan& plan) const {
  for (Path& path : plan.paths)
    for (Stop& stop : path) stop.vertex = original(stop.vertex);
}

}  // namespace quadrille::continuous
