// SPDX-License-Identifier: MIT
#include "mdd/collisions.hpp"

#include <algorithm>
#include <array>
#include <span>

#include "mdd/usages.hpp"

namespace quadrille::discrete {

using sat::Lit;

std::vector<PathCollision> find_collisions(const Instance& instance, const Plan& plan) {
  const Graph& graph = instance.graph();
  const Timestep robust = instance.rules().robust;
  std::vector<PathCollision> found;
  std::size_t end = 0;
  for (const Path& path : plan.paths) end = std::max(end, path.size());
  // Who was last seen in a vertex, and when.
  struct Seen {
    Timestep timestep = -1;
    AgentId agent;
  };
  IdVector<VertexId, Seen> now(graph.num_vertices()), before(graph.num_vertices());
  // The same by the timestep before, however long ago.
  IdVector<VertexId, Seen> left(robust > 0 ? graph.num_vertices() : 0);
  const IdRange<AgentId> all(plan.paths.size());
  std::vector<AgentId> agents;  // who is still there
  const auto is_gone = [&](AgentId i, Timestep t) {
    const Path& path = plan.paths[i];
    return path.empty() || (instance.agents()[i].leaves && t >= static_cast<Timestep>(path.size()));
  };
  for (Timestep t = 0; t < static_cast<Timestep>(end); ++t) {
    std::swap(now, before);
    agents.clear();
    for (const AgentId i : all)
      if (!is_gone(i, t)) agents.push_back(i);
    for (const AgentId i : agents) {
      const VertexId v = position(plan.paths[i], t);
      if (now[v].timestep == t)
        found.push_back({PathCollision::Kind::vertex, now[v].agent, i, v, v, t});
      else
        now[v] = {t, i};
    }
    for (const AgentId i : agents) {
      if (robust == 0) break;
      const VertexId v = position(plan.paths[i], t);
      const Seen& last = left[v];
      if (last.timestep < 0 || last.agent == i || t - last.timestep > robust) continue;
      found.push_back({PathCollision::Kind::vertex, std::min(i, last.agent),
                       std::max(i, last.agent), v, v, i < last.agent ? t : last.timestep,
                       i < last.agent ? last.timestep - t : t - last.timestep});
    }
    if (robust > 0)
      for (const AgentId i : agents) left[position(plan.paths[i], t)] = {t, i};
    if (t == 0) continue;
    for (const AgentId i : agents) {
      const VertexId from = position(plan.paths[i], t - 1), to = position(plan.paths[i], t);
      if (from == to || before[to].timestep != t - 1) continue;
      const AgentId j = before[to].agent;
      if (i < j && position(plan.paths[j], t) == from)
        found.push_back({PathCollision::Kind::swap, i, j, from, to, t - 1});
    }
  }
  return found;
}

namespace {

/// A few literals, without invalid ones.
struct Clause {
  std::array<Lit, 4> lits;
  std::size_t size = 0;
  void add(Lit lit) {
    if (lit.valid()) lits[size++] = lit;
  }
  [[nodiscard]] std::span<const Lit> all() const { return std::span(lits).first(size); }
};

}  // namespace

void CollisionClauses::vertex(Lit x, Lit y, const Sink& sink) {
  const auto a = model_.variable(x), b = model_.variable(y);
  Clause clause;
  for (const Lit lit : {~x, ~y, model_.gone(x), model_.gone(y)}) clause.add(lit);
  const sat::Usage usages[] = {vertex_usage(a.agent, a.vertex, a.number),
                               vertex_usage(b.agent, b.vertex, b.number)};
  sink({sat::why::Vertex{}, clause.all(), usages, false});
}

void CollisionClauses::swap(Lit x, Lit x_next, Lit y, Lit y_next, const Sink& sink) {
  const auto a = model_.variable(x), b = model_.variable(y);
  const Lit clause[] = {~x, ~x_next, ~y, ~y_next};
  const sat::Usage usages[] = {move_usage(a.agent, a.vertex, b.vertex, a.number),
                               move_usage(b.agent, b.vertex, a.vertex, b.number)};
  sink({sat::why::Edge{}, clause, usages, false});
}

void CollisionClauses::rest(Lit x, AgentId resident, Lit late, const Sink& sink) {
  const auto a = model_.variable(x);
  Clause clause;
  const Lit ends = model_.end_at(resident, a.vertex);
  for (const Lit lit : {~x, late, model_.gone(x)}) clause.add(lit);
  if (ends.valid()) clause.add(~ends);
  const sat::Usage usages[] = {rest_usage(resident, a.vertex, a.number + model_.robust()),
                               vertex_usage(a.agent, a.vertex, a.number)};
  sink({sat::why::Goal{resident}, clause.all(), usages, false});
}

void CollisionClauses::end(AgentId first, AgentId second, VertexId goal, const Sink& sink) {
  Clause clause;
  for (const AgentId agent : {first, second})
    if (const Lit ends = model_.end_at(agent, goal); ends.valid()) clause.add(~ends);
  const sat::Usage usages[] = {end_usage(first, goal), end_usage(second, goal)};
  sink({sat::why::Goal{first}, clause.all(), usages, false});
}

}  // namespace quadrille::discrete
