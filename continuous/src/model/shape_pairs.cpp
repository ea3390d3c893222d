// SPDX-License-Identifier: MIT
#include "model/shape_pairs.hpp"

#include <algorithm>
#include <utility>

namespace quadrille::continuous {
namespace {

const Body& body_as(const std::vector<Body>& bodies, ShapeId shape) {
  return bodies.size() == 1 ? bodies.front() : bodies[shape.index()];
}

/// What a part of a move is a part of.
geometry::Motion whole_of(geometry::Motion motion) {
  if (motion.is_rest()) return motion;
  motion.duration += motion.behind;
  motion.behind = 0;
  return motion;
}

}  // namespace

ShapePairs::ShapePairs(std::vector<Body> a, std::vector<Body> b, bool whole_moves)
    : a_(std::move(a)), b_(std::move(b)), whole_moves_(whole_moves) {}

bool ShapePairs::exclude_each_other(const Move& a, const Move& b) {
  return whole_moves_ && can_meet(a, b);
}

const geometry::BodyPair& ShapePairs::of(ShapeId a, ShapeId b) {
  const std::pair key(a_.size() == 1 ? ShapeId() : a, b_.size() == 1 ? ShapeId() : b);
  const auto known = pairs_.find(key);
  if (known != pairs_.end()) return known->second;
  return pairs_.emplace(key, geometry::BodyPair(body_as(a_, a), body_as(b_, b))).first->second;
}

const geometry::BodyPair& ShapePairs::around(ShapeId a) {
  if (!has_shapes()) return of({}, {});
  const auto known = around_.find(a);
  if (known != around_.end()) return known->second;
  Length reach = 0;
  for (const Body& body : b_) reach = std::max(reach, geometry::enclosing_radius(body));
  const Disc own{geometry::enclosing_radius(body_as(a_, a))}, other{reach};
  return around_.emplace(a, geometry::BodyPair(own, other)).first->second;
}

// Bodies may collide where one move ends and the other one begins, too: then these are unsafe as
// well.
std::optional<geometry::TickInterval> ShapePairs::unsafe_offsets(const Move& a, const Move& b) {
  auto offsets = of(a.shape, b.shape).unsafe_offsets(a.motion, b.motion);
  const geometry::TickInterval inner{1 - b.motion.duration, a.motion.duration};
  if (exclude_each_other(a, b)) {
    if (!offsets || has_shapes()) return inner;
    return geometry::TickInterval{std::min(offsets->begin, inner.begin),
                                  std::max(offsets->end, inner.end)};
  }
  if (!offsets || !has_shapes()) return offsets;
  const geometry::TickInterval cut{std::max(offsets->begin, inner.begin),
                                   std::min(offsets->end, inner.end)};
  return cut.is_empty() ? std::nullopt : std::optional(cut);
}

bool ShapePairs::collide(const Move& a, const Move& b, Ticks offset) {
  const bool share_time = offset < a.motion.duration && offset > -b.motion.duration;
  if (has_shapes() && !share_time) return false;
  return (share_time && exclude_each_other(a, b)) ||
         of(a.shape, b.shape).collide(a.motion, b.motion, offset);
}

std::optional<geometry::TickInterval> ShapePairs::contact_window(const Move& a, const Stand& b) {
  auto window = of(a.shape, b.shape).contact_window(a.motion, b.place);
  if (!window || !has_shapes()) return window;
  return geometry::TickInterval{std::max(window->begin, Ticks(0)),
                                std::min(window->end, a.motion.duration)};
}

bool ShapePairs::overlap(const Stand& a, const Stand& b) {
  return of(a.shape, b.shape).overlap(a.place, b.place);
}

bool ShapePairs::can_meet(const Move& a, const Move& b) {
  if (whole_moves_) return of(a.shape, b.shape).can_meet(whole_of(a.motion), whole_of(b.motion));
  return of(a.shape, b.shape).can_meet(a.motion, b.motion);
}

}  // namespace quadrille::continuous
