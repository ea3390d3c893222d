// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

#include "model/parked.hpp"
#include "model/shape_pairs.hpp"
#include "quadrille/continuous/instance.hpp"
#include "quadrille/core/limits.hpp"
#include "quadrille/geometry/swept_volumes.hpp"

namespace quadrille::continuous {

/// An interval, or none, for each of `rows` times `columns` keys, computed when it is first asked
/// for. A plain table if it is small, because hashing costs more than anything else in searches on
/// small roadmaps; else hashed with open addressing: between fifty classes on a roadmap of 57,344
/// edges, the nodes of a standard table took twice as long as the geometry.
class IntervalTable {
 public:
  using Value = std::optional<geometry::TickInterval>;

  /// So many at most. Requires at least one column.
  IntervalTable(std::size_t rows, std::size_t columns)
      : columns_(columns), is_plain_(rows <= kMaxPlain / columns) {
    if (is_plain_) size_ = rows * columns;
  }

  template <typename Compute>
  [[nodiscard]] Value get(std::size_t row, std::size_t column, const Compute& compute) {
    const std::uint64_t key = row * columns_ + column;
    if (is_plain_) {
      if (entries_.empty()) entries_.assign(size_, {kNoKey, {}});
      Entry& entry = entries_[key];
      if (entry.key == kNoKey) entry = {key, packed(compute())};
      return unpacked(entry.interval);
    }
    if (!entries_.empty())
      if (const Entry& entry = entries_[place_of(key)]; entry.key == key)
        return unpacked(entry.interval);
    const Value value = compute();  // may throw
    if (4 * size_ >= 3 * entries_.size()) grow();
    entries_[place_of(key)] = {key, packed(value)};
    ++size_;
    return value;
  }

  /// Of the rest nothing is known any more. Linear in what is known.
  void keep(std::size_t rows, std::size_t columns) {
    const auto is_kept = [&](const Entry& entry) {
      return entry.key != kNoKey && entry.key / columns_ < rows && entry.key % columns_ < columns;
    };
    if (is_plain_) {
      for (Entry& entry : entries_)
        if (!is_kept(entry)) entry = {};
      return;
    }
    std::vector<Entry> old(entries_.size());
    old.swap(entries_);
    size_ = 0;
    for (const Entry& entry : old) {
      if (!is_kept(entry)) continue;
      entries_[place_of(entry.key)] = entry;
      ++size_;
    }
  }

 private:
  static constexpr std::size_t kMaxPlain = std::size_t{1} << 14;
  static constexpr std::uint64_t kNoKey = ~std::uint64_t{0};
  struct Entry {
    std::uint64_t key = kNoKey;
    geometry::TickInterval interval;  // empty: none
  };
  static geometry::TickInterval packed(const Value& value) {
    return value ? *value : geometry::TickInterval{};
  }
  static Value unpacked(const geometry::TickInterval& interval) {
    return interval.is_empty() ? Value{} : Value{interval};
  }
  /// Where the key is, or would be. There is an empty entry.
  [[nodiscard]] std::size_t place_of(std::uint64_t key) const {
    const std::size_t mask = entries_.size() - 1;
    // Fibonacci hashing: neighbours go far apart, the high bits depend on all of the key.
    std::size_t at = static_cast<std::size_t>((key * 0x9e3779b97f4a7c15u) >> 32) & mask;
    while (entries_[at].key != key && entries_[at].key != kNoKey) at = (at + 1) & mask;
    return at;
  }
  void grow() {
    std::vector<Entry> old(std::max<std::size_t>(16, 2 * entries_.size()));
    old.swap(entries_);
    for (const Entry& entry : old)
      if (entry.key != kNoKey) entries_[place_of(entry.key)] = entry;
  }

  std::size_t columns_, size_ = 0;  // of the plain table, or keys that are in
  bool is_plain_;
  std::vector<Entry> entries_;
};

class ContactStore;

/// Which moves and stays of agents of two classes are in each other's way, and when. Answers are
/// computed when they are first asked for, and kept; references to neighbours stay valid.
class Contacts {
 public:
  /// What has to be computed throws LimitReached when `limits` are met. With a `store`, answers
  /// come from there and stay there. All arguments outlive this.
  Contacts(const Instance& instance, LimitMonitor& limits, ContactStore* store = nullptr);

  /// Offsets d = start of f - start of e at which an agent of class a on edge e and one of class b
  /// on edge f collide.
  using Offsets = IntervalTable::Value;
  [[nodiscard]] Offsets offsets(ClassId a, EdgeId e, ClassId b, EdgeId f);

  /// The stretch during which an agent of class b that stands at `v` is in the way of one of class
  /// a on edge e, in ticks since the latter's start. None if the two are parked there, see
  /// ParkedPlaces.
  using Window = IntervalTable::Value;
  [[nodiscard]] Window window(ClassId a, EdgeId e, ClassId b, VertexId v);

  /// Whether two standing agents collide.
  [[nodiscard]] bool overlap(ClassId a, VertexId v, ClassId b, VertexId w) const;

  /// Edges and vertices at which an agent of class b may collide with one of class a on edge e
  /// (at vertex v), ascending; none that can is missing. Edges are open to class b; of a store,
  /// some may be closed.
  struct Neighbours {
    std::vector<EdgeId> edges;
    std::vector<VertexId> vertices;
  };
  [[nodiscard]] const Neighbours& near_edge(ClassId a, EdgeId e, ClassId b);
  [[nodiscard]] const Neighbours& near_vertex(ClassId a, VertexId v, ClassId b);

  /// What is known of two classes.
  struct Pair {
    ShapePairs bodies;
    IntervalTable offsets;
    IntervalTable windows;
    std::unordered_map<std::uint32_t, std::unique_ptr<Neighbours>> near_edges = {},
                                                                   near_vertices = {};
  };
  /// What a roadmap is made of, as something to come near to.
  struct Volumes {
    geometry::SweptVolumes tree;  ///< Of segments, then of vertices.
    /// The edges between the same two vertices, one segment after the other.
    std::vector<EdgeId> segment_edges;
    std::vector<std::size_t> segment_begins;
  };

 private:
  [[nodiscard]] Pair& pair(ClassId a, ClassId b) {
    return *pairs_[a.index() * instance_.num_classes() + b.index()];
  }
  [[nodiscard]] const Volumes& volumes();
  [[nodiscard]] bool is_listed(ClassId c, EdgeId e) const;
  [[nodiscard]] ShapePairs::Move move(ClassId c, EdgeId e) const {
    return move_of(instance_, c, e);
  }
  [[nodiscard]] ShapePairs::Stand stand(VertexId v) const {
    return stand_at(instance_.roadmap(), v);
  }
  [[nodiscard]] const Neighbours& near(
      std::unordered_map<std::uint32_t, std::unique_ptr<Neighbours>>& known, std::uint32_t key,
      ClassId a, const ShapePairs::Move& move, ClassId b);

  const Instance& instance_;
  const ParkedPlaces parked_;
  LimitMonitor& limits_;
  ContactStore* const store_;
  std::vector<std::shared_ptr<Pair>> pairs_;
  std::shared_ptr<const Volumes> volumes_;  // null until they are needed
};

}  // namespace quadrille::continuous
