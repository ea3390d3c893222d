// SPDX-License-Identifier: MIT
#include "joint/joint_groups.hpp"

#include <algorithm>
#include <utility>

namespace quadrille::continuous {
namespace {

/// Where an agent can be on its way to its goal.
struct Room {
  std::vector<EdgeId> edges;  // increasing
  std::vector<char> has_edge, has_vertex;
};

Room room_of(Scene& scene, AgentId i) {
  const Instance& instance = scene.instance();
  const Roadmap& roadmap = instance.roadmap();
  const auto& distances = scene.task(i).distances;
  const VertexId start = instance.agent(i).start;
  Room room{{}, std::vector<char>(roadmap.num_edges()), std::vector<char>(roadmap.num_vertices())};
  std::vector<VertexId> open{start};
  room.has_vertex[start.index()] = 1;
  while (!open.empty()) {
    const VertexId v = open.back();
    open.pop_back();
    for (const EdgeId e : instance.out_edges(instance.class_of(i), v)) {
      const VertexId to = roadmap.edge(e).to;
      if (distances[to] >= kForever) continue;
      room.edges.push_back(e);
      room.has_edge[e.index()] = 1;
      if (room.has_vertex[to.index()] != 0) continue;
      room.has_vertex[to.index()] = 1;
      open.push_back(to);
    }
  }
  std::sort(room.edges.begin(), room.edges.end());
  return room;
}

/// Whether a move of the first one comes near to a move or stay of the other one.
bool meets(Scene& scene, ClassId c, const Room& room, ClassId other, const Room& others) {
  return std::any_of(room.edges.begin(), room.edges.end(), [&](EdgeId e) {
    const Contacts::Neighbours& near = scene.contacts().near_edge(c, e, other);
    return std::any_of(near.edges.begin(), near.edges.end(),
                       [&](EdgeId f) { return others.has_edge[f.index()] != 0; }) ||
           std::any_of(near.vertices.begin(), near.vertices.end(),
                       [&](VertexId v) { return others.has_vertex[v.index()] != 0; });
  });
}

JointGroup group_of(const Instance& instance, const std::vector<Room>& rooms,
                    std::vector<AgentId> agents) {
  JointGroup group{std::move(agents)};
  std::vector<char> has_edge(instance.roadmap().num_edges());
  std::vector<char> has_vertex(instance.roadmap().num_vertices());
  for (const AgentId i : group.agents)
    for (const EdgeId e : rooms[i.index()].edges) {
      has_edge[e.index()] = 1;
      has_vertex[instance.roadmap().edge(e).to.index()] = 1;
    }
  group.num_edges = static_cast<std::size_t>(std::count(has_edge.begin(), has_edge.end(), 1));
  group.num_vertices =
      static_cast<std::size_t>(std::count(has_vertex.begin(), has_vertex.end(), 1));
  return group;
}

}  // namespace

std::vector<JointGroup> independent_groups(Scene& scene) {
  const Instance& instance = scene.instance();
  std::vector<Room> rooms;
  for (const AgentId i : instance.agent_ids()) rooms.push_back(room_of(scene, i));
  // By agent, the first one of its group; no agent has a later first one than itself.
  IdVector<AgentId, AgentId> first;
  for (const AgentId i : instance.agent_ids()) {
    first.push_back(i);
    for (const AgentId j : IdRange<AgentId>(i.index())) {
      if (first[i] == first[j]) continue;
      const ClassId c = instance.class_of(i), d = instance.class_of(j);
      const Room &own = rooms[i.index()], &other = rooms[j.index()];
      if (!meets(scene, c, own, d, other) && !meets(scene, d, other, c, own)) continue;
      const AgentId from = std::max(first[i], first[j]), to = std::min(first[i], first[j]);
      for (AgentId& known : first)
        if (known == from) known = to;
    }
  }
  std::vector<JointGroup> groups;
  for (const AgentId i : instance.agent_ids()) {
    if (first[i] != i) continue;
    std::vector<AgentId> agents;
    for (const AgentId j : instance.agent_ids())
      if (first[j] == i) agents.push_back(j);
    groups.push_back(group_of(instance, rooms, std::move(agents)));
  }
  return groups;
}

}  // namespace quadrille::continuous
