// SPDX-License-Identifier: MIT
#include "traffic/scene_store.hpp"

#include <algorithm>
#include <optional>

namespace quadrille::continuous {
namespace {

std::vector<VertexId> goals_of(const Agent& agent) {
  const auto goals = agent.goals.vertices();
  return {goals.begin(), goals.end()};
}

}  // namespace

SceneStore::SceneStore(std::shared_ptr<const Roadmap> base)
    : base_(std::move(base)), contacts_(base_) {
  for (const Edge& edge : base_->edges()) open_to_.push_back(edge.open_to);
}

void SceneStore::adopt(const Instance& instance) {
  contacts_.adopt(instance);
  const std::vector<Change> changes = changes_to(instance);
  forget(instance, changes);
  for (const Change& change : changes) open_to_[change.edge.index()] = change.after;
}

std::vector<SceneStore::Change> SceneStore::changes_to(const Instance& instance) const {
  std::vector<Change> changes;
  for (const EdgeId e : IdRange<EdgeId>(base_->num_edges())) {
    const Groups now = instance.roadmap().edge(e).open_to;
    if (!(now == open_to_[e.index()])) changes.push_back({e, open_to_[e.index()], now});
  }
  return changes;
}

// Distances stay if no edge that was closed is on a shortest way, and none that was opened makes
// one shorter.
void SceneStore::forget(const Instance& instance, const std::vector<Change>& changes) {
  std::map<ClassKey, std::pair<ClassId, GroupId>> classes;
  for (const AgentId i : instance.agent_ids()) {
    const ClassId c = instance.class_of(i);
    classes.try_emplace(contacts_.key(c), c, instance.agent(i).group);
  }
  const auto is_changed = [&](const ClassKey& key, const std::vector<Ticks>& ticks) {
    const auto at = classes.find(key);
    if (at == classes.end()) return !changes.empty();
    const auto [c, group] = at->second;
    return std::any_of(changes.begin(), changes.end(), [&, c = c, group = group](const Change& x) {
      const bool was_open = x.before.contains(group), is_open = x.after.contains(group);
      if (was_open == is_open) return false;
      const Edge& edge = base_->edge(x.edge);
      if (ticks[edge.to.index()] >= kForever) return false;
      const Ticks via = ticks[edge.to.index()] + instance.duration(c, x.edge);
      const Ticks now = ticks[edge.from.index()];
      return is_open ? via < now : via == now;
    });
  };
  std::erase_if(distances_, [&](const auto& entry) {
    return !entry.second.is_used || is_changed(entry.first.first, entry.second.ticks);
  });
  for (auto& entry : distances_) entry.second.is_used = false;
}

GoalDistances SceneStore::distances(const Instance& instance, AgentId agent) {
  const ClassId c = instance.class_of(agent);
  Known& known = distances_[{contacts_.key(c), goals_of(instance.agent(agent))}];
  known.is_used = true;
  if (known.ticks.empty()) {
    GoalDistances made(instance, agent);
    known.ticks.assign(made.ticks().begin(),
                       made.ticks().begin() + static_cast<std::ptrdiff_t>(base_->num_vertices()));
    return made;
  }
  // The vertices that come after those of the roadmap have no edges that lead there.
  std::vector<Ticks> ticks = known.ticks;
  ticks.resize(instance.roadmap().num_vertices(), kForever);
  for (std::size_t v = base_->num_vertices(); v < ticks.size(); ++v)
    for (const EdgeId e : instance.out_edges(c, VertexId(v))) {
      const Ticks on = ticks[instance.roadmap().to(e).index()];
      if (on < kForever) ticks[v] = std::min(ticks[v], on + instance.duration(c, e));
    }
  return GoalDistances(std::move(ticks));
}

}  // namespace quadrille::continuous
