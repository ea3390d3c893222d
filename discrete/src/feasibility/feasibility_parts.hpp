// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "model/component.hpp"
#include "quadrille/discrete/feasibility.hpp"

/// The parts of check_feasibility. docs/feasibility.md has the theorems they rest on.
namespace quadrille::discrete::feasibility {

inline constexpr Local kNone = kNoLocal;

/// Where the agents of a component stand, at the start or at the end.
struct Arrangement {
  std::vector<Local> vertex_of;     ///< By agent.
  std::vector<Local> agent_at;      ///< By vertex; kNone: free.
  std::vector<Local> count_before;  ///< By vertex, one more entry: agents on smaller vertices.

  Arrangement(std::size_t num_vertices, std::vector<Local> vertices);
  [[nodiscard]] bool occupied(Local v) const { return agent_at[v] != kNone; }
  /// Agents on the vertices begin .. end-1.
  [[nodiscard]] Local count(Local begin, Local end) const {
    return count_before[end] - count_before[begin];
  }
};

/// Why the agents of a component cannot get from one arrangement to another.
struct Obstruction {
  std::string reason;
  std::vector<Local> agents;
  std::vector<Local> vertices;  ///< Where they are in each other's way.
  Invariant::Kind kind;
  std::vector<Local> invariant;  ///< Its vertices, where these are others.
  Local beyond = kNone;          ///< See Invariant.
};

/// Each of these returns why `goal` cannot be reached from `start`, or nullopt if it can.

/// For a path, the vertices in order. Any number of free vertices.
[[nodiscard]] std::optional<Obstruction> check_path(const Component& component,
                                                    const Arrangement& start,
                                                    const Arrangement& goal);
/// For agents that stay on one cycle, whose vertices are given in order. Any number of free ones.
[[nodiscard]] std::optional<Obstruction> check_cycle(const Component& component,
                                                     std::span<const Local> cycle,
                                                     const Arrangement& start,
                                                     const Arrangement& goal);
/// For a component without a free vertex.
[[nodiscard]] std::optional<Obstruction> check_full(const Component& component,
                                                    const Arrangement& start,
                                                    const Arrangement& goal);
/// For a component with a free vertex and a root of degree >= 3.
[[nodiscard]] std::optional<Obstruction> check_corridors(const Component& component,
                                                         const Arrangement& start,
                                                         const Arrangement& goal);

}  // namespace quadrille::discrete::feasibility
