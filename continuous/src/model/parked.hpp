// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "model/shape_pairs.hpp"
#include "quadrille/continuous/instance.hpp"
#include "quadrille/continuous/plan.hpp"

namespace quadrille::continuous {

/// The places of agents that overlap at their starts, where these are *private*: no edge leads
/// there, and nobody else begins there. Then whoever is there has not left yet, and a move from
/// there is a first move; so what the two may do is a matter of places
/// (docs/soundness/continuous.md, "Parked nearer than their bodies").
class ParkedPlaces {
 public:
  explicit ParkedPlaces(const Instance& instance);

  /// Two agents that stand there do not collide.
  [[nodiscard]] bool may_stand(VertexId v, VertexId w) const {
    return !pairs_.empty() && std::binary_search(pairs_.begin(), pairs_.end(), std::pair(v, w));
  }
  /// An agent of a on the edge does not collide with one of b that stands at `v`. Both overlap when
  /// the move begins, and so from then on until they are apart; they have to be when it ends.
  [[nodiscard]] bool may_move(EdgeId e, VertexId v, ShapePairs& bodies) const {
    if (pairs_.empty()) return false;
    const Roadmap& roadmap = instance_.roadmap();
    const Edge& edge = roadmap.edge(e);
    return may_stand(edge.from, v) &&
           !bodies.overlap({edge.shape, roadmap.place(edge.to)}, stand_at(roadmap, v));
  }

 private:
  const Instance& instance_;
  std::vector<std::pair<VertexId, VertexId>> pairs_;  // in both orders, ascending
};

/// The same instance in which all agents that overlap with another one begin at private places:
/// copies of their starts, with the edges that lead on from there, which come after all others.
class PrivateStarts {
 public:
  explicit PrivateStarts(const Instance& instance);

  /// There was nothing to do: the instances are the same.
  [[nodiscard]] bool is_empty() const noexcept { return copied_.empty(); }
  [[nodiscard]] const Instance& instance() const noexcept { return inner_; }
  /// Plans of one instance become those of the other.
  void enter(Plan& plan) const;
  void leave(Plan& plan) const;
  [[nodiscard]] VertexId original(VertexId v) const {
    return v.index() < num_vertices_ ? v : copied_[v.index() - num_vertices_];
  }
  [[nodiscard]] EdgeId original(EdgeId e) const {
    return e.index() < num_edges_ ? e : copied_edges_[e.index() - num_edges_];
  }

 private:
  std::size_t num_vertices_, num_edges_;
  std::vector<VertexId> copied_;      // of which vertex each new one is a copy
  std::vector<EdgeId> copied_edges_;  // likewise
  Instance inner_;
};

}  // namespace quadrille::continuous
