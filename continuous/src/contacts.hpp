// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

#include "quadrille/continuous/instance.hpp"
#include "quadrille/geometry/body_pair.hpp"
#include "quadrille/geometry/swept_volumes.hpp"

namespace quadrille::continuous {

/// Which moves and stays of agents of two classes are in each other's way, and when. Answers are
/// computed when they are first asked for, and kept.
class Contacts {
 public:
  /// `instance` outlives this.
  explicit Contacts(const Instance& instance);

  /// Offsets d = start of f - start of e, both ends included, at which an agent of class a on edge
  /// e and one of class b on edge f collide.
  using Offsets = std::optional<geometry::OffsetInterval>;
  [[nodiscard]] Offsets offsets(ClassId a, EdgeId e, ClassId b, EdgeId f);

  /// When an agent of class b that stands at `v` is in the way of one of class a on edge e.
  using Window = std::optional<geometry::ContactWindow>;
  [[nodiscard]] Window window(ClassId a, EdgeId e, ClassId b, VertexId v);

  /// Whether two standing agents collide.
  [[nodiscard]] bool overlap(ClassId a, VertexId v, ClassId b, VertexId w) const;

  /// Edges and vertices at which an agent of class b may collide with one of class a on edge e
  /// (at vertex v), ascending; none that can is missing.
  struct Neighbours {
    std::vector<EdgeId> edges;
    std::vector<VertexId> vertices;
  };
  [[nodiscard]] const Neighbours& near_edge(ClassId a, EdgeId e, ClassId b);
  [[nodiscard]] const Neighbours& near_vertex(ClassId a, VertexId v, ClassId b);

 private:
  struct Pair {
    geometry::BodyPair bodies;
    std::unordered_map<std::uint64_t, Offsets> offsets;
    std::unordered_map<std::uint64_t, Window> windows;
    std::unordered_map<std::uint32_t, std::unique_ptr<Neighbours>> near_edges, near_vertices;
  };
  [[nodiscard]] Pair& pair(ClassId a, ClassId b) {
    return pairs_[a.index() * instance_.num_classes() + b.index()];
  }
  [[nodiscard]] const geometry::SweptVolumes& volumes(ClassId c);
  [[nodiscard]] const Neighbours& near(
      std::unordered_map<std::uint32_t, std::unique_ptr<Neighbours>>& known, std::uint32_t key,
      ClassId a, const geometry::Motion& motion, ClassId b);

  const Instance& instance_;
  std::vector<Pair> pairs_;
  std::vector<std::unique_ptr<geometry::SweptVolumes>> volumes_;  // by class: edges, then vertices
};

}  // namespace quadrille::continuous
