// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/timesteps.hpp"
#include "quadrille/core/ids.hpp"
#include "quadrille/discrete/plan.hpp"

namespace quadrille::discrete {

/// An agent in one vertex from `begin` to `end`, both included, without a break.
struct Stay {
  Timestep begin = 0, end = 0;
  VertexId next;  ///< Where it goes at end + 1. Without meaning when it stays for ever.
  AgentId agent;
};

/// Calls f(vertex, stay) for the stays of a trimmed path, in order.
template <class F>
void for_each_stay(AgentId agent, const Path& path, const F& f) {
  std::size_t begin = 0;
  for (std::size_t t = 1; t <= path.size(); ++t) {
    const bool is_last = t == path.size();
    if (!is_last && path[t] == path[begin]) continue;
    f(path[begin],
      Stay{static_cast<Timestep>(begin), is_last ? kForever : static_cast<Timestep>(t - 1),
           is_last ? path[begin] : path[t], agent});
    begin = t;
  }
}

/// Who is where when: the stays of a set of collision-free paths, by vertex. Memory follows the
/// number of vertices and of stays, not the horizon.
class Reservations {
 public:
  explicit Reservations(std::size_t num_vertices) : stays_(num_vertices) {}

  /// Requires a trimmed path that collides with no path added before.
  void add(AgentId agent, const Path& path);
  /// Requires a path that was added.
  void remove(const Path& path);

  /// In order of time, disjoint. Valid until the next change.
  [[nodiscard]] std::span<const Stay> stays(VertexId v) const { return stays_[v]; }
  /// The first stay that ends at `t` or later, as an index into stays(v).
  [[nodiscard]] std::size_t first_ending_from(VertexId v, Timestep t) const {
    // Without branches that depend on the stays: path planning spends most of its time here.
    const Stay* first = stays_[v].data();
    for (std::size_t count = stays_[v].size(); count > 0;) {
      const std::size_t half = (count + 1) / 2;
      first += half & (std::size_t{0} - static_cast<std::size_t>(first[half - 1].end < t));
      count -= half;
    }
    return static_cast<std::size_t>(first - stays_[v].data());
  }
  /// The stay at a timestep; null if the vertex is free then.
  [[nodiscard]] const Stay* stay_at(VertexId v, Timestep t) const;

 private:
  IdVector<VertexId, std::vector<Stay>> stays_;
};

}  // namespace quadrille::discrete
