// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "reservations/reservations.hpp"

namespace quadrille::discrete {

/// Who is where when, for paths that may collide. A *meeting* of two paths is a stay of one that
/// overlaps a stay of the other in the same vertex, or a swap of vertices; paths collide if and
/// only if they meet. Memory follows the number of vertices and of stays, not the horizon.
class SoftReservations {
 public:
  /// A span of time, up to the begin of the next one, in which nobody comes or goes.
  struct Piece {
    Timestep begin = 0;
    std::uint32_t present = 0;  ///< Stays that cover it.
    std::uint32_t begins = 0;   ///< Of these, those that begin with it.
    std::uint32_t ends = 0;     ///< Stays that end just before it.
  };

  explicit SoftReservations(std::size_t num_vertices) : cells_(num_vertices) {}

  /// Requires a trimmed path, and none reserved for that agent. O(stays of the vertices passed).
  void add(AgentId agent, const Path& path);
  /// Requires the path that was added for that agent.
  void remove(AgentId agent, const Path& path);
  void clear();

  /// In order, from timestep 0 to the end of time; at least one. Valid until the next change.
  [[nodiscard]] std::span<const Piece> pieces(VertexId v) const {
    const auto& pieces = cells_[v].pieces;
    return pieces.empty() ? std::span<const Piece>(&kEmpty, 1) : std::span<const Piece>(pieces);
  }
  /// The last timestep of a piece.
  [[nodiscard]] static Timestep end_of(std::span<const Piece> pieces, std::size_t piece) {
    return piece + 1 == pieces.size() ? kForever : pieces[piece + 1].begin - 1;
  }
  /// The piece of a timestep, as an index into `pieces`.
  [[nodiscard]] static std::size_t piece_at(std::span<const Piece> pieces, Timestep t) {
    // Without branches that depend on the pieces: path planning spends much of its time here.
    const Piece* first = pieces.data();
    for (std::size_t count = pieces.size() - 1; count > 0;) {
      const std::size_t half = (count + 1) / 2;
      first += first[half].begin <= t ? half : 0;
      count -= half;
    }
    return static_cast<std::size_t>(first - pieces.data());
  }

  /// In order of their begins. Valid until the next change.
  [[nodiscard]] std::span<const Stay> stays(VertexId v) const { return cells_[v].stays; }
  /// How many agents swap with one that goes from `from` to `to` and arrives at `arrival`.
  [[nodiscard]] std::uint32_t swaps(VertexId from, VertexId to, Timestep arrival) const;
  /// Calls f(agent) for each meeting of a trimmed path with those of other agents than `agent`.
  template <class F>
  void for_each_meeting(AgentId agent, const Path& path, const F& f) const;

 private:
  struct Cell {
    std::vector<Stay> stays;
    std::vector<Piece> pieces;
  };
  static const Piece kEmpty;

  static std::size_t split(std::vector<Piece>& pieces, Timestep begin);
  static void join(std::vector<Piece>& pieces, Timestep begin);

  IdVector<VertexId, Cell> cells_;
};

template <class F>
void SoftReservations::for_each_meeting(AgentId agent, const Path& path, const F& f) const {
  for_each_stay(agent, path, [&](VertexId v, const Stay& stay) {
    for (const Stay& other : stays(v)) {
      if (other.begin > stay.end) break;
      if (other.end >= stay.begin && other.agent != agent) f(other.agent);
    }
    if (stay.end == kForever) return;
    for (const Stay& ahead : stays(stay.next)) {
      if (ahead.begin > stay.end) break;
      if (ahead.end == stay.end && ahead.next == v && ahead.agent != agent) f(ahead.agent);
    }
  });
}

}  // namespace quadrille::discrete
