// SPDX-License-Identifier: MIT
#include "exact/exact.hpp"

#include "exact/exact_integer.hpp"
#include "exact/offset_search.hpp"

namespace quadrille::geometry::exact {
namespace {

struct Vector {
  Integer x;
  Integer y;
};
Vector operator-(const Vector& p, const Vector& q) { return {p.x - q.x, p.y - q.y}; }
Integer dot(const Vector& p, const Vector& q) { return p.x * q.x + p.y * q.y; }
Integer cross(const Vector& p, const Vector& q) { return p.x * q.y - p.y * q.x; }
Vector scaled(const Point& p, const Integer& factor) {
  return {factor * p.x.value(), factor * p.y.value()};
}

// Both ends of the relative path, and the shape, times `scale`.
struct ScaledPath {
  Integer scale;
  Vector begin;
  Vector end;
};

ScaledPath scaled_path(const Motion& a, const Motion& b, Ticks offset, Window window) {
  const Ticks unit_a = a.whole(), unit_b = b.whole();
  const Integer scale = Integer(unit_a.value()) * unit_b.value();
  const auto at = [&](Ticks time) {
    const Integer done_a = Integer(a.done(time).value()) * unit_b.value();
    const Integer done_b = Integer(b.done(time - offset).value()) * unit_a.value();
    const Point apart = b.from - a.from;
    const Point step_a = a.to - a.from;
    const Point step_b = b.to - b.from;
    return Vector{scale * apart.x.value() + done_b * step_b.x.value() - done_a * step_a.x.value(),
                  scale * apart.y.value() + done_b * step_b.y.value() - done_a * step_a.y.value()};
  };
  return {scale, at(window.begin), at(window.end)};
}

Fraction squared_distance(const Vector& p, const Vector& begin, const Vector& end) {
  const Vector along = end - begin;
  const Vector to_p = p - begin;
  const Integer projection = dot(to_p, along);
  if (projection <= 0) return {dot(to_p, to_p), 1};
  const Integer square = dot(along, along);
  if (projection >= square) {
    const Vector beyond = p - end;
    return {dot(beyond, beyond), 1};
  }
  const Integer area = cross(to_p, along);
  return {area * area, square};
}

// The smallest squared distance between corners of one and sides of the other: that of the two
// convex sets unless they overlap. `Visit` returns true to stop.
template <class Visit>
void for_each_side_distance(std::span<const Vector> p, std::span<const Vector> q,
                            const Visit& visit) {
  const auto one_way = [&](std::span<const Vector> corners, std::span<const Vector> sides) {
    const std::size_t count = sides.size() == 2 ? 1 : sides.size();
    for (const Vector& corner : corners)
      for (std::size_t i = 0; i < count; ++i)
        if (visit(squared_distance(corner, sides[i], sides[(i + 1) % sides.size()]))) return true;
    return false;
  };
  if (!one_way(p, q)) one_way(q, p);
}

bool within(std::span<const Vector> p, std::span<const Vector> q, const Integer& squared_reach) {
  bool found = false;
  for_each_side_distance(p, q, [&](const Fraction& square) {
    found = square.numerator < squared_reach * square.denominator;
    return found;
  });
  return found;
}

std::vector<Vector> scaled(std::span<const Point> shape, const Integer& factor) {
  std::vector<Vector> result;
  result.reserve(shape.size());
  for (const Point& p : shape) result.push_back(scaled(p, factor));
  return result;
}

// How far outside side i the path is at its begin, and by how much that grows until its end; less
// than 0 means on the inner side. Not normalised: each side has a unit of its own.
struct Outside {
  Integer begin;
  Integer growth;
};

std::vector<Outside> outside(const ScaledPath& path, std::span<const Vector> shape,
                             std::span<const Point> unscaled) {
  std::vector<Outside> result;
  result.reserve(shape.size());
  for (std::size_t i = 0; i < shape.size(); ++i) {
    const Vector side = scaled(unscaled[(i + 1) % shape.size()] - unscaled[i], 1);
    result.push_back({-cross(side, path.begin - shape[i]), -cross(side, path.end - path.begin)});
  }
  return result;
}

// The smallest value that the largest of the linear functions takes on [0, 1], by walking along
// their upper envelope while it falls. Below 0 exactly if the path meets the inside of the shape;
// convex in the path, since each function is and the largest of convex functions is convex.
Fraction smallest_outside(const std::vector<Outside>& functions) {
  std::size_t top = 0;
  for (std::size_t i = 1; i < functions.size(); ++i) {
    const bool equal = functions[i].begin == functions[top].begin;
    if (functions[i].begin > functions[top].begin ||
        (equal && functions[i].growth > functions[top].growth))
      top = i;
  }
  if (functions[top].growth >= 0) return {functions[top].begin, 1};
  while (true) {
    // Where does a function that falls less fast take over?
    std::optional<std::size_t> next;
    Fraction when{1, 1};
    for (std::size_t i = 0; i < functions.size(); ++i) {
      if (functions[i].growth <= functions[top].growth) continue;
      const Fraction candidate{functions[top].begin - functions[i].begin,
                               functions[i].growth - functions[top].growth};
      const int order = compare(candidate, when);
      if (order < 0 || (order == 0 && next && functions[i].growth > functions[*next].growth)) {
        next = i;
        when = candidate;
      }
    }
    if (!next) return {functions[top].begin + functions[top].growth, 1};
    if (functions[*next].growth >= 0)
      return {functions[top].begin * when.denominator + functions[top].growth * when.numerator,
              when.denominator};
    top = *next;
  }
}

Fraction smallest_squared_distance(const ScaledPath& path, std::span<const Vector> shape) {
  const Vector ends[] = {path.begin, path.end};
  std::optional<Fraction> least;
  for_each_side_distance(shape, ends, [&](const Fraction& square) {
    if (!least || square < *least) least = square;
    return false;
  });
  return *least;
}

Integer squared(Length reach, const Integer& scale) {
  const Integer scaled_reach = scale * reach.value();
  return scaled_reach * scaled_reach;
}

// Distance between the path and the shape, which do not meet, in a measure that is convex in the
// offset and comparable between offsets.
Fraction apart(const ScaledPath& path, std::span<const Point> shape, Length reach) {
  const std::vector<Vector> corners = scaled(shape, path.scale);
  if (reach == 0) return smallest_outside(outside(path, corners, shape));
  return smallest_squared_distance(path, corners);
}

}  // namespace

bool meet(const Motion& a, const Motion& b, Ticks offset, Window window,
          std::span<const Point> shape, Length reach) {
  const ScaledPath path = scaled_path(a, b, offset, window);
  if (shape.size() == 1) {
    const Fraction square = squared_distance(scaled(shape[0], path.scale), path.begin, path.end);
    return square.numerator < squared(reach, path.scale) * square.denominator;
  }
  const std::vector<Vector> corners = scaled(shape, path.scale);
  if (smallest_outside(outside(path, corners, shape)).numerator < 0) return true;
  if (reach == 0) return false;
  const Vector ends[] = {path.begin, path.end};
  return within(corners, ends, squared(reach, path.scale));
}

bool touch(const Motion& a, const Motion& b, Ticks offset, Window window,
           std::span<const Point> shape, Length reach) {
  const ScaledPath path = scaled_path(a, b, offset, window);
  const Fraction measure = apart(path, shape, reach);
  return measure.numerator == squared(reach, path.scale) * measure.denominator;
}

std::optional<Ticks> find_meeting(const Motion& a, const Motion& b, std::span<const Point> shape,
                                  Length reach) {
  const auto meets = [&](Ticks at) {
    return meet(a, b, at, *common_window(a, b, at), shape, reach);
  };
  const auto distance = [&](Ticks at) {
    return apart(scaled_path(a, b, at, *common_window(a, b, at)), shape, reach);
  };
  return find_near(-b.duration, a.duration, meets, distance);
}

bool sides_within(const Parallelogram& places, std::span<const Point> shape, Length reach) {
  const std::vector<Vector> corners = scaled(places.corners, 1);
  return within(corners, scaled(shape, 1), squared(reach, 1));
}

}  // namespace quadrille::geometry::exact
