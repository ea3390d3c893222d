// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "quadrille/continuous/instance.hpp"
#include "quadrille/core/goals.hpp"
#include "quadrille/dispatch/course.hpp"

namespace quadrille::dispatch {

/// A roadmap on which lanes are closed and opened again.
class Roads {
 public:
  explicit Roads(std::shared_ptr<const continuous::Roadmap> roadmap)
      : roadmap_(std::move(roadmap)) {}

  /// All edges from one vertex to another one. Errors (invalid_instance): there is none, or it is
  /// closed (open) already.
  [[nodiscard]] std::optional<Error> close(VertexId from, VertexId to);
  [[nodiscard]] std::optional<Error> open(VertexId from, VertexId to);

  [[nodiscard]] bool are_open() const noexcept { return closed_.empty(); }
  [[nodiscard]] std::vector<continuous::EdgeId> closed_edges() const;
  /// When the course first enters a lane that is closed, at `since` or later.
  [[nodiscard]] std::optional<Ticks> barrier(const Course& course, Ticks since) const;
  /// Whether the agent comes from a vertex to one of these by lanes that are open to it.
  [[nodiscard]] bool lead(const continuous::Agent& agent, VertexId from, const Goals& goals) const;
  /// The vertex and others near it, by such lanes; two at least, of which the second may be
  /// anywhere: as a set they may be where another robot has its goal.
  [[nodiscard]] Goals near(const continuous::Agent& agent, VertexId vertex) const;

 private:
  /// Fewest moves first, about so many at most.
  [[nodiscard]] std::vector<VertexId> reach(const continuous::Agent& agent, VertexId from,
                                            std::size_t most) const;

  const std::shared_ptr<const continuous::Roadmap> roadmap_;
  std::set<std::pair<VertexId, VertexId>> closed_;
};

}  // namespace quadrille::dispatch
