// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "quadrille/continuous/instance.hpp"
#include "quadrille/geometry/body_pair.hpp"

namespace quadrille::continuous {

/// geometry::BodyPair for two kinds of agents, which may have shapes: when bodies collide that are
/// what edges and vertices make of them. Pairs are made when they are first asked for.
///
/// A body with shapes may be larger while it moves than before and after. So where it has any,
/// moves count without their ends: two that have only a moment in common do not collide, and who
/// stands is in the way of a move strictly between its begin and its end. Without shapes that makes
/// no difference to plans: what collides at an end does so in the move before or after it.
///
/// With `whole_moves` two moves that can ever meet collide whenever they have more than a moment in
/// common (Instance::has_whole_moves).
class ShapePairs {
 public:
  /// Of the bodies by shape; one if there are no shapes.
  ShapePairs(std::vector<Body> a, std::vector<Body> b, bool whole_moves = false);

  struct Move {
    ShapeId shape;
    geometry::Motion motion;
  };
  struct Stand {
    ShapeId shape;
    geometry::Place place;
  };
  /// The offsets, from a's start to b's, at which they collide.
  [[nodiscard]] std::optional<geometry::TickInterval> unsafe_offsets(const Move& a, const Move& b);
  /// Whether `offset` is one of these.
  [[nodiscard]] bool collide(const Move& a, const Move& b, Ticks offset);
  /// When b is in the way of a's move; as BodyPair::contact_window.
  [[nodiscard]] std::optional<geometry::TickInterval> contact_window(const Move& a, const Stand& b);
  [[nodiscard]] bool overlap(const Stand& a, const Stand& b);
  /// At some offset.
  [[nodiscard]] bool can_meet(const Move& a, const Move& b);

  /// The bodies themselves.
  [[nodiscard]] const geometry::BodyPair& of(ShapeId a, ShapeId b);
  /// A pair that meets whenever some of b's bodies meets this one of a: that itself without shapes.
  [[nodiscard]] const geometry::BodyPair& around(ShapeId a);
  [[nodiscard]] bool has_shapes() const noexcept { return a_.size() > 1 || b_.size() > 1; }

 private:
  /// They are never under way at the same time.
  [[nodiscard]] bool exclude_each_other(const Move& a, const Move& b);

  const std::vector<Body> a_, b_;
  const bool whole_moves_;
  std::map<std::pair<ShapeId, ShapeId>, geometry::BodyPair> pairs_;
  std::map<ShapeId, geometry::BodyPair> around_;
};

/// Of two classes.
[[nodiscard]] inline ShapePairs shape_pairs(const Instance& instance, ClassId a, ClassId b) {
  return {instance.bodies(a), instance.bodies(b), instance.has_whole_moves()};
}
[[nodiscard]] inline ShapePairs::Move move_of(const Instance& instance, ClassId c, EdgeId e) {
  return {instance.roadmap().edge(e).shape, instance.motion(c, e)};
}
[[nodiscard]] inline ShapePairs::Stand stand_at(const Roadmap& roadmap, VertexId v) {
  return {roadmap.shape(v), roadmap.place(v)};
}
/// As a move, of one tick.
[[nodiscard]] inline ShapePairs::Move rest_at(const Roadmap& roadmap, VertexId v) {
  return {roadmap.shape(v), geometry::rest(roadmap.place(v), 1)};
}

}  // namespace quadrille::continuous
