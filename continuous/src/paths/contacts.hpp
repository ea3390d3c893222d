// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

#include "quadrille/continuous/instance.hpp"
#include "quadrille/core/limits.hpp"
#include "quadrille/geometry/body_pair.hpp"
#include "quadrille/geometry/swept_volumes.hpp"

namespace quadrille::continuous {

/// A value for each of `rows` times `columns` keys, computed when it is first asked for. A plain
/// table if it is small, because hashing costs more than anything else in searches on small
/// roadmaps.
template <typename Value>
class PairTable {
 public:
  PairTable(std::size_t rows, std::size_t columns)
      : columns_(columns), size_(rows <= kMaxSize / columns ? rows * columns : 0) {}

  template <typename Compute>
  [[nodiscard]] const Value& get(std::size_t row, std::size_t column, const Compute& compute) {
    const std::size_t key = row * columns_ + column;
    if (size_ == 0) {
      const auto at = hashed_.find(key);
      return at != hashed_.end() ? at->second : hashed_.emplace(key, compute()).first->second;
    }
    if (plain_.empty()) plain_.resize(size_);
    if (!plain_[key]) plain_[key] = compute();
    return *plain_[key];
  }

 private:
  static constexpr std::size_t kMaxSize = std::size_t{1} << 14;
  std::size_t columns_, size_;
  std::vector<std::optional<Value>> plain_;
  std::unordered_map<std::size_t, Value> hashed_;
};

/// Which moves and stays of agents of two classes are in each other's way, and when. Answers are
/// computed when they are first asked for, and kept; references to them stay valid.
class Contacts {
 public:
  /// Both arguments outlive this. What has to be computed throws LimitReached when `limits` are
  /// met.
  Contacts(const Instance& instance, LimitMonitor& limits);

  /// Offsets d = start of f - start of e at which an agent of class a on edge e and one of class b
  /// on edge f collide.
  using Offsets = std::optional<geometry::TickInterval>;
  [[nodiscard]] const Offsets& offsets(ClassId a, EdgeId e, ClassId b, EdgeId f);

  /// The stretch during which an agent of class b that stands at `v` is in the way of one of class
  /// a on edge e, in ticks since the latter's start.
  using Window = std::optional<geometry::TickInterval>;
  [[nodiscard]] const Window& window(ClassId a, EdgeId e, ClassId b, VertexId v);

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
    PairTable<Offsets> offsets;
    PairTable<Window> windows;
    std::unordered_map<std::uint32_t, std::unique_ptr<Neighbours>> near_edges, near_vertices;
  };
  [[nodiscard]] Pair& pair(ClassId a, ClassId b) {
    return pairs_[a.index() * instance_.num_classes() + b.index()];
  }
  void make_volumes();
  [[nodiscard]] const Neighbours& near(
      std::unordered_map<std::uint32_t, std::unique_ptr<Neighbours>>& known, std::uint32_t key,
      ClassId a, const geometry::Motion& motion, ClassId b);

  const Instance& instance_;
  LimitMonitor& limits_;
  std::vector<Pair> pairs_;
  std::optional<geometry::SweptVolumes> volumes_;  // of segments, then of vertices
  // The edges between the same two vertices, one segment after the other.
  std::vector<EdgeId> segment_edges_;
  std::vector<std::size_t> segment_begins_;
};

}  // namespace quadrille::continuous
