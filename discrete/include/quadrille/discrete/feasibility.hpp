// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "quadrille/core/export.hpp"
#include "quadrille/discrete/instance.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::discrete {

/// Something that no move of the agents changes, and that differs between starts and goals
/// (docs/feasibility.md). For certificates.
struct Invariant {
  enum class Kind {
    none,
    component,  ///< In which component the agent is.
    bridge,     ///< On which side of a bridge, its two vertices, it is; no vertex is free.
    cycle,      ///< The cyclic order of agents on a cycle, its vertices in order.
    parity,     ///< That of the permutation of a block, its vertices, all of whose cycles are odd.
    corridor,   ///< The agent's place in a long corridor or on a path, its vertices in order.
  };
  Kind kind = Kind::none;
  std::optional<AgentId> agent = {};  ///< Of component, bridge and corridor.
  std::vector<VertexId> vertices = {};
  /// Of a corridor of one vertex: a vertex on one side of it, which is a component of what is left
  /// without it. Absent: all else is on the other side.
  std::optional<VertexId> beyond = {};
};

/// Whether any plan exists, of whatever cost.
struct Feasibility {
  bool feasible = true;
  /// Empty when feasible, else one sentence (no full stop) that names agents and places, such as
  /// "agents 0 and 1 cannot pass each other: the component of (0, 0) is a corridor without
  /// junctions". Of several reasons one is given, the same one every time.
  std::string reason;
  /// Whom and what it names: the agents, and the vertices of the place where they are in each
  /// other's way, in the order of the corridor, path or cycle; for an agent that no way leads to
  /// its goal, its start and its goal. Empty when feasible.
  std::vector<AgentId> agents = {};
  std::vector<VertexId> vertices = {};
  /// False: the instance has rules, of which nothing is decided; or some agents have several goals,
  /// there are too many choices to try them all, and those that were tried have no plan. Then
  /// `feasible` is true.
  bool is_decided = true;
  /// Why there is none, for programs. None when feasible, and where agents have several goals.
  Invariant invariant = {};
};

/// Decides whether an instance without rules has a plan. Exact in both directions;
/// docs/feasibility.md has the proof. Where agents have several goals, choices of one goal each are
/// tried, some ten million elementary steps long: exact where the answer is decided. The rules are
/// those of `verify`: one agent per vertex, no swaps over an edge; agents may follow each other and
/// rotate along cycles. Deterministic; thread-safe; recursion-free. O(V + E) time and memory; with
/// goal sets, O(agents * (V + E + goals)) time and as many steps as said.
[[nodiscard]] Feasibility check_feasibility(const Instance& instance);

}  // namespace quadrille::discrete

QUADRILLE_API_END
