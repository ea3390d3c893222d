// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "lazy/lazy_model.hpp"

// What an assignment of the lazy model means, from nothing but the model's tables of literals and
// obstacles.
namespace quadrille::discrete::support {

inline bool forbids_visit(const ObstacleTable& table, const Obstacle& o, VertexId v, Timestep t) {
  if (o.kind == Obstacle::Kind::edge || o.kind == Obstacle::Kind::end ||
      o.kind == Obstacle::Kind::elsewhere)
    return false;
  if (o.kind != Obstacle::Kind::barrier) return o.vertex == v && o.first <= t && t <= o.last;
  const auto visits = table.visits(o);
  return std::find(visits.begin(), visits.end(), Visit{v, t}) != visits.end();
}

inline bool forbids_move(const Obstacle& o, VertexId v, VertexId w, Timestep t) {
  return o.kind == Obstacle::Kind::edge && o.first == t &&
         ((o.vertex == v && o.to == w) || (o.vertex == w && o.to == v));
}

/// Caps and active obstacles under a stack of literals.
struct Situation {
  Situation(const LazyModel& of, const std::vector<sat::Lit>& stack)
      : model(of), cap(of.instance().num_agents(), kForever), active(of.instance().num_agents()) {
    for (const sat::Lit lit : stack) {
      const auto index = static_cast<std::size_t>(lit.variable());
      if (values.size() <= index) values.resize(index + 1, sat::Truth::unassigned);
      values[index] = lit.positive() ? sat::Truth::is_true : sat::Truth::is_false;
    }
    for (const AgentId i : model.instance().agent_ids())
      for (const auto& rung : model.rungs(i))
        if (is_false(rung.at_least))
          cap[i] = std::min(cap[i], static_cast<Timestep>(rung.cost - 1));
    for (const ObstacleId id : IdRange<ObstacleId>(model.obstacles().size())) {
      const Obstacle& o = model.obstacles()[id];
      if (is_false(o.allowed)) active[o.agent].push_back(o);
      if (o.last != kForever) end = std::max(end, o.last);
      end = std::max(end, o.first + 1);
    }
    for (const AgentId i : model.instance().agent_ids())
      if (is_present(i)) end = std::max(end, cap[i]);
  }

  [[nodiscard]] bool is_assigned(sat::Lit lit) const {
    const auto index = static_cast<std::size_t>(lit.variable());
    return index < values.size() && values[index] != sat::Truth::unassigned;
  }
  [[nodiscard]] bool is_false(sat::Lit lit) const {
    const auto index = static_cast<std::size_t>(lit.variable());
    return is_assigned(lit) && (values[index] == sat::Truth::is_true) != lit.positive();
  }
  [[nodiscard]] bool is_false(const std::vector<sat::Lit>& clause) const {
    return std::all_of(clause.begin(), clause.end(), [&](sat::Lit lit) { return is_false(lit); });
  }
  [[nodiscard]] bool is_present(AgentId i) const { return cap[i] != kForever; }
  [[nodiscard]] bool all_present() const {
    return std::find(cap.begin(), cap.end(), kForever) == cap.end();
  }
  [[nodiscard]] bool may_visit(AgentId i, VertexId v, Timestep t) const {
    return (t < cap[i] || may_end(i, v)) &&
           std::none_of(active[i].begin(), active[i].end(), [&](const Obstacle& o) {
             return forbids_visit(model.obstacles(), o, v, t);
           });
  }
  [[nodiscard]] bool may_end(AgentId i, VertexId v) const {
    return model.instance().agents()[i].goals.contains(v) &&
           std::none_of(active[i].begin(), active[i].end(), [&](const Obstacle& o) {
             return (o.kind == Obstacle::Kind::end && o.vertex == v) ||
                    (o.kind == Obstacle::Kind::elsewhere && o.vertex != v);
           });
  }
  [[nodiscard]] bool may_move(AgentId i, VertexId v, VertexId w, Timestep t) const {
    return std::none_of(active[i].begin(), active[i].end(),
                        [&](const Obstacle& o) { return forbids_move(o, v, w, t); });
  }

  /// Whether some path of a present agent is within its cap and avoids its obstacles.
  [[nodiscard]] bool has_path(AgentId i) const {
    const Graph& graph = model.instance().graph();
    const Agent& task = model.instance().agents()[i];
    std::vector<bool> here(graph.num_vertices(), false);
    here[task.start.index()] = may_visit(i, task.start, 0);
    for (Timestep t = 0; t <= end; ++t) {
      std::vector<bool> next(graph.num_vertices(), false);
      for (const VertexId v : IdRange<VertexId>(graph.num_vertices())) {
        if (!here[v.index()]) continue;
        if (may_visit(i, v, t + 1)) next[v.index()] = true;
        if (t >= cap[i]) continue;  // it rests
        for (const VertexId w : graph.neighbours(v))
          if (may_visit(i, w, t + 1) && may_move(i, v, w, t)) next[w.index()] = true;
      }
      here = std::move(next);
    }
    const auto goals = task.goals.vertices();
    return std::any_of(goals.begin(), goals.end(),
                       [&](VertexId v) { return here[v.index()] && may_end(i, v); });
  }
  /// Why `path` is not one of these; empty if it is.
  [[nodiscard]] std::string find_fault(AgentId i, const Path& path) const {
    const Graph& graph = model.instance().graph();
    const Agent& task = model.instance().agents()[i];
    if (path.empty() || path.front() != task.start || !may_end(i, path.back()))
      return "does not lead from the start to a goal where it may end";
    if (static_cast<Timestep>(path.size()) - 1 > cap[i]) return "is costlier than the cap";
    const auto last = std::max(end + 1, static_cast<Timestep>(path.size()));
    for (Timestep t = 0; t <= last; ++t) {
      const VertexId v = position(path, t), w = position(path, t + 1);
      if (v != w && !graph.adjacent(v, w)) return "jumps";
      if (!may_visit(i, v, t)) return "makes a forbidden visit at " + std::to_string(t);
      if (!may_move(i, v, w, t)) return "makes a forbidden move at " + std::to_string(t);
    }
    return "";
  }

  const LazyModel& model;
  std::vector<sat::Truth> values;  // by variable
  IdVector<AgentId, Timestep> cap;
  IdVector<AgentId, std::vector<Obstacle>> active;
  Timestep end = 0;  // nothing changes from then on
};

inline bool collide(const Path& a, const Path& b) {
  const auto end = static_cast<Timestep>(std::max(a.size(), b.size()));
  for (Timestep t = 0; t < end; ++t)
    if (position(a, t) == position(b, t) ||
        (position(a, t) == position(b, t + 1) && position(a, t + 1) == position(b, t)))
      return true;
  return false;
}

}  // namespace quadrille::discrete::support
