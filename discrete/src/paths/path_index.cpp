// SPDX-License-Identifier: MIT
#include "paths/path_index.hpp"

#include <algorithm>

#include "quadrille/core/contract.hpp"

namespace quadrille::discrete {

using Kind = Encounter::Kind;

PathIndex::PathIndex(const Instance& instance)
    : instance_(instance),
      paths_(instance.num_agents()),
      present_(instance.graph().num_vertices()),
      resident_(instance.graph().num_vertices(), -1),
      is_changed_(instance.num_agents(), 0) {
  for (const AgentId i : instance.agents())
    resident_[instance.tasks()[i].goal] = static_cast<std::int32_t>(i.value());
}

void PathIndex::replace(AgentId agent, const Path& path) {
  QUADRILLE_REQUIRE(!path.empty() && path.back() == instance_.tasks()[agent].goal,
                    "a path ends at the agent's goal");
  Path& own = paths_[agent];
  for (std::size_t t = 0; t < own.size(); ++t) {
    auto& crowd = present_[own[t]];
    const auto it = std::find_if(crowd.begin(), crowd.end(), [&](const Presence& p) {
      return p.agent == agent && p.timestep == static_cast<Timestep>(t);
    });
    *it = crowd.back();
    crowd.pop_back();
  }
  own = path;
  for (std::size_t t = 0; t < own.size(); ++t)
    present_[own[t]].push_back({static_cast<Timestep>(t), agent});
  if (is_changed_[agent] == 0) {
    is_changed_[agent] = 1;
    changed_.push_back(agent);
  }
}

int PathIndex::collisions_of_rest(AgentId agent, Timestep arrival) const {
  int count = 0;
  for (const Presence& p : present_[instance_.tasks()[agent].goal])
    if (p.agent != agent && p.timestep > arrival) ++count;
  return count;
}

int PathIndex::num_collisions(AgentId agent) const {
  scratch_.clear();
  collect(agent, scratch_);
  return static_cast<int>(scratch_.size());
}

int PathIndex::num_collisions(AgentId agent, const Path& path) const {
  int count = 0;
  for (std::size_t t = 1; t < path.size(); ++t)
    count += collisions_of_step(agent, path[t - 1], path[t], static_cast<Timestep>(t));
  return count + collisions_of_rest(agent, static_cast<Timestep>(path.size()) - 1);
}

void PathIndex::collect(AgentId agent, std::vector<Encounter>& out) const {
  const Path& path = paths_[agent];
  const auto end = static_cast<Timestep>(path.size()) - 1;
  for (Timestep t = 0; t <= end; ++t) {
    const VertexId v = path[static_cast<std::size_t>(t)];
    std::optional<AgentId> host;  // who rests there now
    if (resident_[v] >= 0) {
      const AgentId resident(static_cast<std::size_t>(resident_[v]));
      if (resident != agent && rests_since(resident) <= t) host = resident;
    }
    if (host) out.push_back({Kind::rest, *host, agent, v, v, t});
    for (const Presence& p : present_[v])
      if (p.timestep == t && p.agent != agent && p.agent != host)
        out.push_back({t == end ? Kind::rest : Kind::vertex, agent, p.agent, v, v, t});
    if (t == end) break;
    const VertexId w = path[static_cast<std::size_t>(t) + 1];
    if (w == v) continue;
    for (const Presence& p : present_[w])
      if (p.timestep == t && p.agent != agent && cost(p.agent) > t &&
          paths_[p.agent][static_cast<std::size_t>(t) + 1] == v)
        out.push_back({Kind::swap, agent, p.agent, v, w, t});
  }
  if (!path.empty()) collect_rest(agent, out);
}

void PathIndex::collect_rest(AgentId agent, std::vector<Encounter>& out) const {
  const VertexId goal = instance_.tasks()[agent].goal;
  for (const Presence& p : present_[goal])
    if (p.agent != agent && p.timestep > cost(agent))
      out.push_back({Kind::rest, agent, p.agent, goal, goal, p.timestep});
}

const std::vector<Encounter>& PathIndex::collisions() {
  if (changed_.empty()) return collisions_;
  std::erase_if(collisions_, [&](const Encounter& c) {
    return is_changed_[c.first] != 0 || is_changed_[c.second] != 0;
  });
  for (const AgentId i : changed_) {
    scratch_.clear();
    collect(i, scratch_);
    is_changed_[i] = 0;
    // Pairs of changed agents are told by the one whose turn is last.
    for (const Encounter& c : scratch_)
      if (is_changed_[c.first == i ? c.second : c.first] == 0) collisions_.push_back(c);
  }
  changed_.clear();
  return collisions_;
}

}  // namespace quadrille::discrete
