// SPDX-License-Identifier: MIT
#include "joint/joint_groups.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "quadrille/core/grouping.hpp"

namespace quadrille::continuous {
namespace {

/// Where agents of each class can be on the way to their goals. Who can be at one place, or near to
/// each other, is joined.
class Whereabouts {
 public:
  explicit Whereabouts(Scene& scene)
      : scene_(scene),
        instance_(scene.instance()),
        num_edges_(instance_.roadmap().num_edges()),
        num_places_(num_edges_ + instance_.roadmap().num_vertices()),
        grouping_(instance_.num_agents() + instance_.num_classes() * num_places_),
        is_used_(instance_.num_classes() * num_places_),
        is_moved_to_(is_used_.size()) {
    for (const AgentId i : instance_.agent_ids()) roam(i);
    for (const ClassId c : IdRange<ClassId>(instance_.num_classes())) look_around(c);
  }

  [[nodiscard]] std::vector<JointGroup> groups() const {
    IdVector<AgentId, std::size_t> number;
    for (const AgentId i : instance_.agent_ids()) number.push_back(grouping_.root(i.index()));
    std::vector<JointGroup> groups;
    std::map<std::size_t, std::size_t> place;  // by root
    for (auto& agents : groups_by(number)) {
      place[number[agents.front()]] = groups.size();
      groups.push_back({std::move(agents)});
    }
    std::vector<bool> is_counted(num_places_);
    for (std::size_t p = 0; p < is_used_.size(); ++p) {
      const std::size_t at = p % num_places_;
      if (!is_moved_to_[p] || is_counted[at]) continue;
      is_counted[at] = true;
      JointGroup& group = groups[place.at(grouping_.root(instance_.num_agents() + p))];
      ++(at < num_edges_ ? group.num_edges : group.num_vertices);
    }
    return groups;
  }

 private:
  [[nodiscard]] std::size_t place_of(ClassId c, EdgeId e) const {
    return c.index() * num_places_ + e.index();
  }
  [[nodiscard]] std::size_t place_of(ClassId c, VertexId v) const {
    return c.index() * num_places_ + num_edges_ + v.index();
  }
  void use(AgentId i, std::size_t place) {
    is_used_[place] = true;
    grouping_.join(i.index(), instance_.num_agents() + place);
  }

  void roam(AgentId i) {
    scene_.limits().check();
    const auto& distances = scene_.task(i).distances;
    const ClassId c = instance_.class_of(i);
    std::vector<bool> is_seen(instance_.roadmap().num_vertices());
    std::vector<VertexId> open{instance_.agent(i).start};
    is_seen[open.front().index()] = true;
    use(i, place_of(c, open.front()));
    while (!open.empty()) {
      const VertexId v = open.back();
      open.pop_back();
      for (const EdgeId e : instance_.out_edges(c, v)) {
        const VertexId to = instance_.roadmap().to(e);
        if (distances[to] >= kForever) continue;
        use(i, place_of(c, e));
        use(i, place_of(c, to));
        is_moved_to_[place_of(c, e)] = is_moved_to_[place_of(c, to)] = true;
        if (is_seen[to.index()]) continue;
        is_seen[to.index()] = true;
        open.push_back(to);
      }
    }
  }

  void look_around(ClassId c) {
    for (const EdgeId e : IdRange<EdgeId>(num_edges_)) {
      if (!is_used_[place_of(c, e)]) continue;
      scene_.limits().check();
      for (const ClassId d : IdRange<ClassId>(instance_.num_classes())) {
        const Contacts::Neighbours& near = scene_.contacts().near_edge(c, e, d);
        for (const EdgeId f : near.edges) meet(place_of(c, e), place_of(d, f));
        for (const VertexId v : near.vertices) meet(place_of(c, e), place_of(d, v));
      }
    }
  }
  void meet(std::size_t place, std::size_t other) {
    if (is_used_[other])
      grouping_.join(instance_.num_agents() + place, instance_.num_agents() + other);
  }

  Scene& scene_;
  const Instance& instance_;
  const std::size_t num_edges_, num_places_;  // edges, then vertices
  Grouping grouping_;                         // of agents, then of places by class
  std::vector<bool> is_used_;                 // places, by class: some agent can be there
  std::vector<bool> is_moved_to_;             // of these, edges and where they lead
};

}  // namespace

std::vector<JointGroup> independent_groups(Scene& scene) { return Whereabouts(scene).groups(); }

bool are_in_one_component(const Instance& instance) {
  const Roadmap& roadmap = instance.roadmap();
  Grouping components(roadmap.num_vertices());
  for (const EdgeId e : IdRange<EdgeId>(roadmap.num_edges()))
    components.join(roadmap.from(e).index(), roadmap.to(e).index());
  std::set<std::size_t> roots;
  for (const Agent& agent : instance.agents()) roots.insert(components.root(agent.start.index()));
  return roots.size() <= 1;
}

}  // namespace quadrille::continuous
