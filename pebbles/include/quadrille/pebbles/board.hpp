// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "quadrille/core/export.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::pebbles {

/// A vertex of a graph, or an agent on it, by number.
using Local = std::uint32_t;
inline constexpr Local kNoLocal = UINT32_MAX;

/// A connected undirected graph without loops and parallel edges.
class LocalGraph {
 public:
  /// By vertex, its neighbours: each edge is named from both ends. O(V + E).
  explicit LocalGraph(const std::vector<std::vector<Local>>& neighbours);

  [[nodiscard]] Local size() const noexcept { return static_cast<Local>(block_.size()); }
  [[nodiscard]] std::span<const Local> neighbours(Local v) const {
    return std::span(neighbours_).subspan(offsets_[v], offsets_[v + 1] - offsets_[v]);
  }
  [[nodiscard]] std::size_t degree(Local v) const { return offsets_[v + 1] - offsets_[v]; }
  /// Of neighbours: whether no cycle leads along their edge.
  [[nodiscard]] bool is_bridge(Local a, Local b) const { return block_[a] != block_[b]; }
  /// The smallest vertex of the vertex's block, which here means its 2-edge-connected component.
  [[nodiscard]] Local block(Local v) const { return block_[v]; }
  [[nodiscard]] bool on_cycle(Local v) const { return on_cycle_[v]; }

 private:
  void find_blocks();

  std::vector<std::size_t> offsets_;
  std::vector<Local> neighbours_;
  std::vector<Local> block_;
  std::vector<bool> on_cycle_;
};

/// One agent goes along one edge.
struct Shift {
  Local agent = kNoLocal, from = kNoLocal, to = kNoLocal;
  bool with_next = false;  ///< At the same time as the shift after it: they are of one rotation.
};

/// Where the agents of a component are, and the shifts that brought them there, one after the
/// other.
class Board {
 public:
  /// `vertex_of`: by agent, all different.
  Board(Local num_vertices, std::vector<Local> vertex_of);

  [[nodiscard]] Local agent_at(Local v) const { return agent_at_[v]; }  ///< kNoLocal: nobody.
  [[nodiscard]] bool is_free(Local v) const { return agent_at_[v] == kNoLocal; }
  [[nodiscard]] Local vertex_of(Local agent) const { return vertex_of_[agent]; }
  [[nodiscard]] const std::vector<Local>& vertices() const noexcept {
    return vertex_of_;
  }  ///< By agent.

  /// Requires that `to` is free and next to the agent.
  void move(Local agent, Local to);
  /// Who is in `from` goes to `to`. Requires that there is somebody.
  void move_from(Local from, Local to) { move(agent_at_[from], to); }
  /// All at once go on to the next vertex of a cycle. Requires that none of its vertices is free.
  void rotate(std::span<const Local> cycle);
  /// A timestep of a plan, as shifts one after the other: all agents go to `to` (by agent) at once,
  /// or stay. Requires that these are neighbours, all different, and that no two change places.
  /// O(agents).
  void step(std::span<const Local> to);

  [[nodiscard]] const std::vector<Shift>& shifts() const noexcept { return shifts_; }
  /// Takes back what came after the first `count` shifts.
  void undo_to(std::size_t count);
  /// Goes back by further shifts what the shifts first .. last-1 went, with the agents a and b in
  /// each other's place. Requires that they are where these shifts left them, but for that.
  void retrace(std::size_t first, std::size_t last, Local a, Local b);
  /// Goes back by further shifts what another board has gone.
  void retrace(const Board& other);
  /// Instead of the shifts so far, others that lead from the same arrangement to the same one.
  void replace_shifts(std::vector<Shift> shifts) { shifts_ = std::move(shifts); }

 private:
  void apply(std::span<const Shift> together);
  void append_backwards(std::span<const Shift> shifts, Local a, Local b);

  std::vector<Local> vertex_of_, agent_at_;
  std::vector<Shift> shifts_;
};

}  // namespace quadrille::pebbles

QUADRILLE_API_END
