// SPDX-License-Identifier: MIT
#include "mdd/collisions.hpp"

#include <algorithm>

#include "mdd/usages.hpp"

namespace quadrille::discrete {

using sat::Lit;

std::vector<PathCollision> find_collisions(const Graph& graph, const Plan& plan) {
  std::vector<PathCollision> found;
  std::size_t end = 0;
  for (const Path& path : plan.paths) end = std::max(end, path.size());
  // Who was last seen in a vertex, and when.
  struct Seen {
    Timestep timestep = -1;
    AgentId agent;
  };
  IdVector<VertexId, Seen> now(graph.num_vertices()), before(graph.num_vertices());
  const IdRange<AgentId> agents(plan.paths.size());
  for (Timestep t = 0; t < static_cast<Timestep>(end); ++t) {
    std::swap(now, before);
    for (const AgentId i : agents) {
      if (plan.paths[i].empty()) continue;
      const VertexId v = position(plan.paths[i], t);
      if (now[v].timestep == t)
        found.push_back({PathCollision::Kind::vertex, now[v].agent, i, v, v, t});
      else
        now[v] = {t, i};
    }
    if (t == 0) continue;
    for (const AgentId i : agents) {
      if (plan.paths[i].empty()) continue;
      const VertexId from = position(plan.paths[i], t - 1), to = position(plan.paths[i], t);
      if (from == to || before[to].timestep != t - 1) continue;
      const AgentId j = before[to].agent;
      if (i < j && position(plan.paths[j], t) == from)
        found.push_back({PathCollision::Kind::swap, i, j, from, to, t - 1});
    }
  }
  return found;
}

void CollisionClauses::vertex(Lit x, Lit y, const Sink& sink) {
  const auto a = model_.variable(x), b = model_.variable(y);
  const Lit clause[] = {~x, ~y};
  const sat::Usage usages[] = {vertex_usage(a.agent, a.vertex, a.number),
                               vertex_usage(b.agent, b.vertex, b.number)};
  sink({sat::why::Vertex{}, clause, usages, false});
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
  const Lit clause[] = {~x, late};
  const sat::Usage usages[] = {rest_usage(resident, a.vertex, a.number),
                               vertex_usage(a.agent, a.vertex, a.number)};
  sink({sat::why::Goal{resident}, clause, usages, false});
}

}  // namespace quadrille::discrete
