// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "model/timesteps.hpp"
#include "quadrille/discrete/instance.hpp"

namespace quadrille::discrete {

/// The blockages of an instance by place.
class BlockedTimes {
 public:
  /// From the first to the last timestep, both included; the last one can be kForever.
  struct Span {
    Timestep first, last;
    [[nodiscard]] bool contains(Timestep t) const noexcept { return first <= t && t <= last; }
  };

  /// O(V + blockages).
  explicit BlockedTimes(const Instance& instance)
      : vertices_(instance.graph().num_vertices()), moves_(instance.graph().num_vertices()) {
    for (const Blockage& b : instance.rules().blockages) {
      const Span span{b.first, b.last.value_or(kForever)};
      if (!b.to) {
        vertices_[b.vertex].push_back(span);
        continue;
      }
      moves_[b.vertex].push_back({*b.to, span});
      moves_[*b.to].push_back({b.vertex, span});
    }
  }

  /// When nobody may be there, in no order.
  [[nodiscard]] std::span<const Span> at(VertexId v) const { return vertices_[v]; }
  [[nodiscard]] bool forbids(VertexId v, Timestep t) const {
    return std::any_of(vertices_[v].begin(), vertices_[v].end(),
                       [t](const Span& span) { return span.contains(t); });
  }
  /// To begin the move from `v` to `w` at `t`.
  [[nodiscard]] bool forbids_move(VertexId v, VertexId w, Timestep t) const {
    return std::any_of(moves_[v].begin(), moves_[v].end(),
                       [w, t](const Move& move) { return move.to == w && move.span.contains(t); });
  }
  /// The first timestep from `t` on at which one may begin that move; kForever: never.
  [[nodiscard]] Timestep next_move(VertexId v, VertexId w, Timestep t) const {
    for (bool is_free = false; !is_free;) {
      is_free = true;
      for (const Move& move : moves_[v]) {
        if (move.to != w || !move.span.contains(t)) continue;
        if (move.span.last == kForever) return kForever;
        t = move.span.last + 1;
        is_free = false;
      }
    }
    return t;
  }
  /// From when on one may stay there for ever; kForever: never.
  [[nodiscard]] Timestep free_from(VertexId v) const {
    Timestep from = 0;
    for (const Span& span : vertices_[v])
      from = std::max(from, span.last == kForever ? kForever : span.last + 1);
    return from;
  }

 private:
  struct Move {
    VertexId to;
    Span span;
  };
  IdVector<VertexId, std::vector<Span>> vertices_;
  IdVector<VertexId, std::vector<Move>> moves_;
};

}  // namespace quadrille::discrete
