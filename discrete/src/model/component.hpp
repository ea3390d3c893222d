// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "quadrille/discrete/instance.hpp"

namespace quadrille::discrete {

/// A vertex of one component: its place in the preorder of a depth-first search. Also used for an
/// agent's place among the agents of the component.
using Local = std::uint32_t;
inline constexpr Local kNoLocal = UINT32_MAX;

/// A connected component with at least one agent, its vertices renumbered in depth-first preorder.
/// The root, vertex 0, has degree >= 3 if any vertex has; otherwise the component is a path, rooted
/// at an end, or a cycle.
struct Component {
  const Graph* graph = nullptr;
  std::vector<VertexId> vertices;
  std::vector<Local> parent;       ///< kNoLocal for the root.
  std::vector<Local> subtree_end;  ///< The subtree of v is v .. subtree_end[v]-1.
  /// The smallest vertex of v's block, which here means its 2-edge-connected component. The edge
  /// from v to its parent is a bridge exactly if block[v] == v.
  std::vector<Local> block;
  std::vector<bool> on_cycle;  ///< Whether v's block has more than one vertex.
  /// The edges outside the search tree; they join a vertex to an ancestor (second).
  std::vector<std::pair<Local, Local>> back_edges;
  std::vector<AgentId> agents;  ///< Increasing.

  [[nodiscard]] Local size() const { return static_cast<Local>(vertices.size()); }
  [[nodiscard]] std::size_t degree(Local v) const { return graph->neighbours(vertices[v]).size(); }
  [[nodiscard]] std::string name_of(Local v) const { return vertex_name(*graph, vertices[v]); }
  [[nodiscard]] std::string agent_name(Local agent) const {
    return std::to_string(agents[agent].value());
  }
};

/// Renumbers components, each vertex of the graph at most once.
class ComponentNumbering {
 public:
  explicit ComponentNumbering(const Graph& graph);

  /// Which component a vertex belongs to, counted in the order of `explore`; kNoLocal before that.
  [[nodiscard]] Local component_of(VertexId v) const { return component_of_[v]; }
  /// The place of an explored vertex in its component.
  [[nodiscard]] Local number(VertexId v) const { return number_[v]; }
  /// Numbers the component of a vertex that belongs to none so far. Leaves `agents` empty.
  [[nodiscard]] Component explore(VertexId vertex);

 private:
  /// Marks the component of a vertex and returns the root to number it from.
  [[nodiscard]] VertexId mark_component(VertexId vertex);
  void find_blocks(Component& component) const;

  const Graph& graph_;
  Local num_components_ = 0;
  IdVector<VertexId, Local> component_of_;
  IdVector<VertexId, Local> number_;
};

}  // namespace quadrille::discrete
