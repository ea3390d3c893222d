// SPDX-License-Identifier: MIT
#include "model/independent_groups.hpp"

#include <cstddef>

#include "quadrille/core/grouping.hpp"

namespace quadrille::discrete {

Grouping components_of(const Graph& graph) {
  Grouping components(graph.num_vertices());
  for (const VertexId v : IdRange<VertexId>(graph.num_vertices()))
    for (const VertexId w : graph.neighbours(v)) components.join(v.index(), w.index());
  return components;
}

AgentGroups independent_groups(const Instance& instance) {
  const Grouping components = components_of(instance.graph());
  IdVector<AgentId, std::size_t> component;
  for (const AgentId i : instance.agent_ids())
    component.push_back(components.root(instance.agents()[i].start.index()));
  return groups_by(component);
}

}  // namespace quadrille::discrete
