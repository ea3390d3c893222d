// SPDX-License-Identifier: MIT
#include "paths/path_index.hpp"

#include <algorithm>
#include <utility>

#include "quadrille/core/contract.hpp"

namespace quadrille::discrete {

using Kind = Encounter::Kind;

PathIndex::PathIndex(const Instance& instance)
    : instance_(instance),
      robust_(instance.rules().robust),
      paths_(instance.num_agents()),
      stays_(instance.graph().num_vertices()),
      resident_(instance.graph().num_vertices(), -1),
      next_resident_(instance.num_agents(), -1),
      is_changed_(instance.num_agents(), 0) {}

void PathIndex::remove_resident(AgentId agent) {
  if (leaves(agent)) return;
  std::int32_t* at = &resident_[paths_[agent].back()];
  while (*at != static_cast<std::int32_t>(agent.value()))
    at = &next_resident_[AgentId(static_cast<std::size_t>(*at))];
  *at = next_resident_[agent];
}

void PathIndex::add_resident(AgentId agent) {
  if (leaves(agent)) return;
  std::int32_t& first = resident_[paths_[agent].back()];
  next_resident_[agent] = std::exchange(first, static_cast<std::int32_t>(agent.value()));
}

void PathIndex::replace(AgentId agent, const Path& path) {
  QUADRILLE_REQUIRE(!path.empty() && instance_.agents()[agent].goals.contains(path.back()),
                    "a path ends at a goal of the agent");
  Path& own = paths_[agent];
  if (!own.empty()) remove_resident(agent);
  for (std::size_t t = 0; t < own.size();) {
    const Stay old = stay_at(agent, own, t);
    auto& crowd = stays_[own[t]];
    const auto it = std::find_if(crowd.begin(), crowd.end(), [&](const Stay& stay) {
      return stay.agent == agent && stay.begin == old.begin;
    });
    *it = crowd.back();
    crowd.pop_back();
    t = static_cast<std::size_t>(old.end) + 1;
  }
  own = path;
  add_resident(agent);
  for (std::size_t t = 0; t < own.size();) {
    const Stay stay = stay_at(agent, own, t);
    stays_[own[t]].push_back(stay);
    t = static_cast<std::size_t>(stay.end) + 1;
  }
  if (is_changed_[agent] == 0) {
    is_changed_[agent] = 1;
    changed_.push_back(agent);
  }
}

PathIndex::Stay PathIndex::stay_at(AgentId agent, const Path& path, std::size_t t) {
  std::size_t end = t;
  while (end + 1 < path.size() && path[end + 1] == path[t]) ++end;
  return {static_cast<Timestep>(t), static_cast<Timestep>(end), agent};
}

int PathIndex::collisions_of_rest(AgentId agent, VertexId goal, Timestep arrival) const {
  if (leaves(agent)) return 0;
  if (robust_ > 0) return encounters_of_rest(agent, goal, arrival);
  int count = 0;
  for (const Stay& stay : stays_[goal])
    if (stay.agent != agent && stay.end > arrival)
      count += stay.end - std::max(stay.begin - 1, arrival);
  return count;
}

int PathIndex::num_collisions(AgentId agent) const {
  if (robust_ > 0) {
    const Path& path = paths_[agent];
    int count = collisions_of_rest(agent, path.back(), cost(agent));
    for (Timestep t = 1; t <= cost(agent); ++t)
      count += encounters_at(agent, path[static_cast<std::size_t>(t)], t);
    return count;
  }
  scratch_.clear();
  collect(agent, scratch_);
  return static_cast<int>(scratch_.size());
}

int PathIndex::encounters_at(AgentId agent, VertexId v, Timestep t) const {
  const Timestep first = t - robust_, last = t + robust_;
  int count = 0;
  for (std::int32_t at = resident_[v]; at >= 0;) {
    const AgentId resident(static_cast<std::size_t>(at));
    // Its stay ends with its arrival.
    if (resident != agent) count += std::max(0, last - std::max(first, cost(resident) + 1) + 1);
    at = next_resident_[resident];
  }
  for (const Stay& stay : stays_[v])
    if (stay.agent != agent)
      count += std::max(0, std::min(last, stay.end) - std::max(first, stay.begin) + 1);
  return count;
}

int PathIndex::encounters_of_rest(AgentId agent, VertexId goal, Timestep arrival) const {
  int count = 0;
  for (const Stay& stay : stays_[goal]) {
    if (stay.agent == agent) continue;
    for (Timestep t = stay.end; t >= stay.begin && t + robust_ > arrival; --t)
      count += t + robust_ - std::max(arrival + 1, t - robust_) + 1;
  }
  return count;
}

void PathIndex::collect_robust(AgentId agent, std::vector<Encounter>& out) const {
  const Path& path = paths_[agent];
  if (path.empty()) return;
  const Timestep end = cost(agent);
  const auto rest = [&](AgentId resident, AgentId visitor, VertexId v, Timestep t) {
    const Timestep then = std::max(t, cost(resident));
    out.push_back({Kind::rest, resident, visitor, v, v, then, t - then});
  };
  for (Timestep t = 0; t <= end; ++t) {
    const VertexId v = path[static_cast<std::size_t>(t)];
    const auto is_host = [&](AgentId i) {
      return i != agent && !leaves(i) && paths_[i].back() == v && cost(i) <= t + robust_;
    };
    for (std::int32_t at = resident_[v]; at >= 0;) {
      const AgentId resident(static_cast<std::size_t>(at));
      if (is_host(resident)) rest(resident, agent, v, t);
      at = next_resident_[resident];
    }
    if (t == end && !leaves(agent)) break;
    for (const Stay& stay : stays_[v])
      if (stay.agent != agent && !is_host(stay.agent) && stay.begin <= t + robust_ &&
          stay.end >= t - robust_)
        out.push_back(
            {Kind::vertex, agent, stay.agent, v, v, t, std::clamp(t, stay.begin, stay.end) - t});
  }
  if (leaves(agent)) return;
  for (const Stay& stay : stays_[path.back()])
    if (stay.agent != agent)
      for (Timestep t = std::max(stay.begin, end - robust_); t <= stay.end; ++t)
        rest(agent, stay.agent, path.back(), t);
}

void PathIndex::collect(AgentId agent, std::vector<Encounter>& out) const {
  if (robust_ > 0) return collect_robust(agent, out);
  const Path& path = paths_[agent];
  const auto end = static_cast<Timestep>(path.size()) - 1;
  for (Timestep t = 0; t <= end; ++t) {
    const VertexId v = path[static_cast<std::size_t>(t)];
    const auto is_host = [&](AgentId i) {  // rests there now
      return i != agent && !leaves(i) && paths_[i].back() == v && cost(i) <= t;
    };
    for (std::int32_t at = resident_[v]; at >= 0;) {
      const AgentId resident(static_cast<std::size_t>(at));
      if (is_host(resident)) out.push_back({Kind::rest, resident, agent, v, v, t});
      at = next_resident_[resident];
    }
    for (const Stay& stay : stays_[v])
      if (stay.contains(t) && stay.agent != agent && !is_host(stay.agent))
        out.push_back(
            {t == end && !leaves(agent) ? Kind::rest : Kind::vertex, agent, stay.agent, v, v, t});
    if (t == end) break;
    const VertexId w = path[static_cast<std::size_t>(t) + 1];
    if (w == v) continue;
    for (const Stay& stay : stays_[w])
      if (stay.end == t && stay.agent != agent && cost(stay.agent) > t &&
          paths_[stay.agent][static_cast<std::size_t>(t) + 1] == v)
        out.push_back({Kind::swap, agent, stay.agent, v, w, t});
  }
  if (!path.empty() && !leaves(agent)) collect_rest(agent, out);
}

void PathIndex::collect_rest(AgentId agent, std::vector<Encounter>& out) const {
  const VertexId goal = paths_[agent].back();
  for (const Stay& stay : stays_[goal])
    if (stay.agent != agent)
      for (Timestep t = std::max(stay.begin, cost(agent) + 1); t <= stay.end; ++t)
        out.push_back({Kind::rest, agent, stay.agent, goal, goal, t});
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
