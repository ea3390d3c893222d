// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
#include <vector>

#include "quadrille/core/contract.hpp"
#include "quadrille/core/export.hpp"
#include "quadrille/core/ids.hpp"
#include "quadrille/core/result.hpp"
#include "quadrille/geometry/motion.hpp"
#include "quadrille/geometry/place.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::continuous {

using geometry::Length;  ///< Whole length units.
using geometry::Point;
using geometry::Ticks;  ///< Whole ticks.
using EdgeId = StrongId<struct EdgeTag>;

/// Millionths of a length unit per tick.
using Speed = Quantity<struct SpeedUnit>;
inline constexpr Speed kUnitSpeed = 1'000'000;
inline constexpr Speed kMaxSpeed{1'000'000'000'000};

/// A kind of agents, to which edges can be open or closed. Numbers are below kMaxGroups.
using GroupId = StrongId<struct GroupTag>;
inline constexpr std::size_t kMaxGroups = 64;

/// A set of groups.
class Groups {
 public:
  constexpr Groups() = default;  ///< None.
  /// Requires numbers below kMaxGroups.
  constexpr Groups(std::initializer_list<GroupId> groups) {
    for (const GroupId group : groups) insert(group);
  }
  [[nodiscard]] static constexpr Groups all() {
    Groups groups;
    groups.bits_ = ~std::uint64_t{0};
    return groups;
  }
  constexpr void insert(GroupId group) {
    QUADRILLE_REQUIRE(group.index() < kMaxGroups, "there are 64 groups");
    bits_ |= std::uint64_t{1} << group.index();
  }
  [[nodiscard]] constexpr bool contains(GroupId group) const noexcept {
    return group.index() < kMaxGroups && (bits_ >> group.index() & 1) != 0;
  }
  [[nodiscard]] constexpr bool is_empty() const noexcept { return bits_ == 0; }
  friend constexpr bool operator==(const Groups&, const Groups&) = default;

 private:
  std::uint64_t bits_ = 0;
};

/// Which of its bodies a robot that turns has somewhere: Agent::body_as.
using ShapeId = StrongId<struct ShapeTag>;
inline constexpr std::size_t kMaxShapes = 1'000'000;

/// A straight move from one vertex to another.
struct Edge {
  VertexId from;
  VertexId to;
  /// How long the move takes, whoever makes it; absent: its length at the speed of the agent.
  std::optional<Ticks> duration;
  /// Only agents of these groups may make the move.
  Groups open_to = Groups::all();
  /// The shape of who makes the move, all the way.
  ShapeId shape = {};
  /// Nobody goes faster than that. Not with a duration. One for a kind of agents is that of an edge
  /// for their group, beside one for the others.
  std::optional<Speed> speed_limit = {};
  friend bool operator==(const Edge&, const Edge&) = default;
};

/// A vertex in the middle of a move from one vertex to another one, which takes `whole` ticks, of
/// which `behind` lie behind whoever is there. Where it is follows from that, exactly. No edge
/// leads to it, and one leads on: the rest of the move.
struct LanePlace {
  VertexId vertex;
  VertexId from, to;
  Ticks behind = 0;  ///< 0 <= behind < whole.
  Ticks whole = 1;
  friend bool operator==(const LanePlace&, const LanePlace&) = default;
};

/// The edges at each vertex, by id: those that leave it, or those that lead to it.
class EdgeLists {
 public:
  EdgeLists() = default;
  /// Of the edges that are open to `group`, or of all, by their end `end`. Requires ends below
  /// `num_vertices`. Linear.
  EdgeLists(std::size_t num_vertices, const std::vector<Edge>& edges, VertexId Edge::*end,
            const std::optional<GroupId>& group);
  [[nodiscard]] std::span<const EdgeId> of(VertexId v) const {
    return {edges_.data() + begin_[v.index()], edges_.data() + begin_[v.index() + 1]};
  }

 private:
  std::vector<std::size_t> begin_;
  std::vector<EdgeId> edges_;
};

/// Vertices in the plane or in space, and directed edges. Immutable.
class Roadmap {
 public:
  /// Errors: out_of_range for coordinates beyond geometry::kMaxLength, durations outside
  /// [1, geometry::kMaxDuration] or speed limits outside [1, kMaxSpeed]; invalid_instance for an
  /// edge with an end that does not exist, from a vertex to itself, of length zero without a
  /// duration, with a duration and a speed limit, or open to nobody. Vertices and
  /// edges are named by their index. Parallel edges are allowed, and several vertices in the same
  /// place.
  /// `lane_places`: vertices in the middle of moves, whose coordinates are the exact ones rounded
  /// to the nearest length unit. Errors: invalid_instance for one that is not as LanePlace says.
  /// `shapes`: of who stands at each vertex; none: they are all 0. Errors: out_of_range for one
  /// above kMaxShapes; invalid_instance for another number of them, edges between the same two
  /// vertices in the same direction that have different ones, and a vertex in the middle of a move
  /// that has not the one of the move.
  /// `no_waiting`: vertices at which nobody may wait: who comes there goes on at once, or leaves.
  /// Errors: invalid_instance for one that does not exist, is told twice, or is in the middle of a
  /// move.
  [[nodiscard]] static Result<Roadmap> make(std::vector<Point> vertices, std::vector<Edge> edges,
                                            std::vector<LanePlace> lane_places = {},
                                            std::vector<ShapeId> shapes = {},
                                            std::vector<VertexId> no_waiting = {});

  /// The same one, but these edges are open to nobody; all ids stay the same. No file can hold it.
  /// Requires edges that exist. Linear.
  [[nodiscard]] Roadmap with_closed(std::span<const EdgeId> closed) const;

  [[nodiscard]] std::size_t num_vertices() const noexcept { return positions_.size(); }
  [[nodiscard]] std::size_t num_edges() const noexcept { return edges_.size(); }
  /// Of a vertex in the middle of a move to the nearest length unit, see `place`.
  [[nodiscard]] const Point& position(VertexId v) const { return positions_[v.index()]; }
  /// Where whoever stands there is, exactly.
  [[nodiscard]] geometry::Place place(VertexId v) const {
    const LanePlace* const on_lane = lane_place(v);
    if (on_lane == nullptr) return position(v);
    return {position(on_lane->from), position(on_lane->to), on_lane->behind, on_lane->whole};
  }
  /// Of who stands there.
  [[nodiscard]] ShapeId shape(VertexId v) const {
    return shapes_.empty() ? ShapeId() : shapes_[v.index()];
  }
  /// Of who goes from one vertex to another one. Requires an edge between them.
  [[nodiscard]] ShapeId shape(VertexId from, VertexId to) const;
  /// Of the vertices; empty: all 0.
  [[nodiscard]] const std::vector<ShapeId>& shapes() const noexcept { return shapes_; }
  /// The largest one that a vertex or an edge has, and one more.
  [[nodiscard]] std::size_t num_shapes() const noexcept { return num_shapes_; }
  [[nodiscard]] bool may_wait(VertexId v) const {
    return is_no_waiting_.empty() || is_no_waiting_[v.index()] == 0;
  }
  /// Vertices at which nobody may wait, ascending.
  [[nodiscard]] const std::vector<VertexId>& no_waiting() const noexcept { return no_waiting_; }
  /// The move in so many ticks from one vertex to another one.
  [[nodiscard]] geometry::Motion motion(VertexId from, VertexId to, Ticks duration) const;
  /// Null unless the vertex is in the middle of a move. Logarithmic.
  [[nodiscard]] const LanePlace* lane_place(VertexId v) const;
  /// By vertex.
  [[nodiscard]] const std::vector<LanePlace>& lane_places() const noexcept { return lane_places_; }
  [[nodiscard]] const Edge& edge(EdgeId e) const { return edges_[e.index()]; }
  /// The ends of an edge, in less memory than the edge: for searches over large roadmaps.
  [[nodiscard]] VertexId from(EdgeId e) const { return ends_[e.index()].from; }
  [[nodiscard]] VertexId to(EdgeId e) const { return ends_[e.index()].to; }
  /// Whether no vertex has a height: all of them are in the plane z = 0.
  [[nodiscard]] bool is_flat() const noexcept { return is_flat_; }
  /// Whoever they are open to, by edge id.
  [[nodiscard]] std::span<const EdgeId> out_edges(VertexId v) const { return out_.of(v); }
  [[nodiscard]] std::span<const EdgeId> in_edges(VertexId v) const { return in_.of(v); }

  [[nodiscard]] const std::vector<Point>& positions() const noexcept { return positions_; }
  [[nodiscard]] const std::vector<Edge>& edges() const noexcept { return edges_; }

 private:
  Roadmap(std::vector<Point> positions, std::vector<Edge> edges, std::vector<LanePlace> lane_places,
          std::vector<ShapeId> shapes, std::vector<VertexId> no_waiting);

  std::vector<Point> positions_;
  struct Ends {
    VertexId from, to;
  };

  std::vector<Edge> edges_;
  std::vector<Ends> ends_;  // by edge
  std::vector<LanePlace> lane_places_;
  std::vector<ShapeId> shapes_;
  std::vector<VertexId> no_waiting_;
  std::vector<char> is_no_waiting_;  // by vertex, or none
  std::size_t num_shapes_ = 1;
  bool is_flat_ = true;
  EdgeLists out_, in_;
};

}  // namespace quadrille::continuous

QUADRILLE_API_END
