// SPDX-License-Identifier: MIT
#include "model/parked.hpp"

#include <memory>
#include <set>

namespace quadrille::continuous {

namespace {

/// Where agents begin alone and no edge leads.
class Privacy {
 public:
  explicit Privacy(const Instance& instance)
      : roadmap_(instance.roadmap()), num_starts_(roadmap_.num_vertices(), 0) {
    for (const Agent& agent : instance.agents()) ++num_starts_[agent.start];
  }
  [[nodiscard]] bool is_private(VertexId start) const {
    return num_starts_[start] == 1 && roadmap_.in_edges(start).empty();
  }

 private:
  const Roadmap& roadmap_;
  IdVector<VertexId, std::size_t> num_starts_;
};

}  // namespace

ParkedPlaces::ParkedPlaces(const Instance& instance) : instance_(instance) {
  if (instance.parked_pairs().empty()) return;
  const Privacy privacy(instance);
  for (const auto& [i, j] : instance.parked_pairs()) {
    const VertexId v = instance.agent(i).start, w = instance.agent(j).start;
    if (!privacy.is_private(v) || !privacy.is_private(w)) continue;
    pairs_.emplace_back(v, w);
    pairs_.emplace_back(w, v);
  }
  std::sort(pairs_.begin(), pairs_.end());
}

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
  std::vector<LanePlace> lane_places = roadmap.lane_places();
  std::vector<Agent> agents = instance.agents().items();
  const Privacy privacy(instance);
  for (const AgentId i : parked) {
    Agent& agent = agents[i.index()];
    const VertexId start = agent.start;
    if (privacy.is_private(start)) continue;
    const VertexId copy(positions.size());
    copied_.push_back(start);
    positions.push_back(roadmap.position(start));
    if (!shapes.empty()) shapes.push_back(roadmap.shape(start));
    if (const LanePlace* const place = roadmap.lane_place(start)) {
      lane_places.push_back(*place);
      lane_places.back().vertex = copy;
    }
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
  auto made = Roadmap::make(std::move(positions), std::move(edges), std::move(lane_places),
                            std::move(shapes), roadmap.no_waiting());
  QUADRILLE_REQUIRE(made, "copies of vertices and edges are as good as these");
  auto inner = Instance::make(std::move(made).value(), std::move(agents), instance.resolution(), {},
                              instance.obstacles(), instance.now());
  QUADRILLE_REQUIRE(inner, "copies of starts are as good as these");
  inner_ = inner->with_whole_moves(instance.has_whole_moves());
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
