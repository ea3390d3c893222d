// SPDX-License-Identifier: MIT
#include "model/component.hpp"

#include <algorithm>

namespace quadrille::discrete {

ComponentNumbering::ComponentNumbering(const Graph& graph)
    : graph_(graph),
      component_of_(graph.num_vertices(), kNoLocal),
      number_(graph.num_vertices(), kNoLocal) {}

VertexId ComponentNumbering::mark_component(VertexId vertex) {
  // From a vertex of degree >= 3 every bridge leads downwards to one corridor or block; from the
  // end of a path, and on a cycle, the preorder is the order of the vertices.
  const auto rank = [&](VertexId v) {
    const std::size_t degree = graph_.neighbours(v).size();
    return degree >= 3 ? 2 : degree <= 1 ? 1 : 0;
  };
  VertexId root = vertex;
  std::vector<VertexId> stack{vertex};
  component_of_[vertex] = num_components_;
  while (!stack.empty()) {
    const VertexId v = stack.back();
    stack.pop_back();
    if (rank(v) > rank(root)) root = v;
    for (const VertexId w : graph_.neighbours(v))
      if (component_of_[w] == kNoLocal) {
        component_of_[w] = num_components_;
        stack.push_back(w);
      }
  }
  ++num_components_;
  return root;
}

Component ComponentNumbering::explore(VertexId vertex) {
  Component component;
  component.graph = &graph_;
  std::vector<std::size_t> next_edge;
  const auto enter = [&](VertexId v, Local parent) {
    number_[v] = component.size();
    component.vertices.push_back(v);
    component.parent.push_back(parent);
    component.subtree_end.push_back(kNoLocal);
    next_edge.push_back(0);
    return number_[v];
  };
  // Not recursive: a path of a million vertices would overflow the stack.
  Local v = enter(mark_component(vertex), kNoLocal);
  while (v != kNoLocal) {
    const auto near = graph_.neighbours(component.vertices[v]);
    if (next_edge[v] == near.size()) {
      component.subtree_end[v] = component.size();
      v = component.parent[v];
      continue;
    }
    const VertexId w = near[next_edge[v]++];
    if (number_[w] == kNoLocal) v = enter(w, v);
  }
  find_blocks(component);
  return component;
}

void ComponentNumbering::find_blocks(Component& component) const {
  const Local size = component.size();
  // The smallest vertex that a back edge from the subtree leads to.
  std::vector<Local> low(size);
  for (Local v = 0; v < size; ++v) low[v] = v;
  for (Local v = size; v-- > 1;) {
    const Local parent = component.parent[v];
    for (const VertexId w : graph_.neighbours(component.vertices[v]))
      if (number_[w] < v && number_[w] != parent) {
        component.back_edges.emplace_back(v, number_[w]);
        low[v] = std::min(low[v], number_[w]);
      }
    low[parent] = std::min(low[parent], low[v]);
  }
  component.block.resize(size);
  component.on_cycle.assign(size, false);
  for (Local v = 0; v < size; ++v) {
    if (v == 0 || low[v] == v) {
      component.block[v] = v;
      continue;
    }
    const Local block = component.block[component.parent[v]];
    component.block[v] = block;
    component.on_cycle[v] = component.on_cycle[block] = true;
  }
}

}  // namespace quadrille::discrete
