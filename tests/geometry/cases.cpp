// SPDX-License-Identifier: MIT
#include "cases.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace quadrille::geometry {
namespace {

using support::Random;

std::ostream& operator<<(std::ostream& out, const Point& p) {
  out << "{" << p.x << ", " << p.y;
  if (p.z != 0) out << ", " << p.z;
  return out << "}";
}

std::ostream& operator<<(std::ostream& out, const Motion& motion) {
  return out << "Motion{" << motion.from << ", " << motion.to << ", " << motion.duration << "}";
}

std::ostream& operator<<(std::ostream& out, const Body& body) {
  if (const auto* disc = std::get_if<Disc>(&body)) return out << "Disc{" << disc->radius << "}";
  out << "ConvexPolygon::make({";
  for (const Point& p : std::get<ConvexPolygon>(body).vertices()) out << p << ",";
  return out << "}).value()";
}

Point operator+(const Point& p, const Point& q) { return {p.x + q.x, p.y + q.y, p.z + q.z}; }
Point operator*(std::int64_t factor, const Point& p) {
  return {factor * p.x, factor * p.y, factor * p.z};
}

Point draw_point(Random& random, Length size) {
  return {draw(random, -size, size), draw(random, -size, size)};
}

Motion draw_motion(Random& random, Length size, Ticks longest) {
  Motion motion{draw_point(random, size), draw_point(random, size), draw_ticks(random, 1, longest)};
  if (random.percent(15)) motion = rest(motion.from, draw_ticks(random, 0, longest));
  return motion;
}

Motion draw_motion(Random& random, Length size) {
  return draw_motion(random, size, Ticks(size.value()));
}

// A scale from a handful to the largest.
Length draw_scale(Random& random) { return Length(std::int64_t{1} << random.between(3, 36)); }

std::int64_t draw_factor(Random& random, Length first, Length last) {
  return draw(random, first, last).value();
}

// Directions of integer length, so that lines can be exactly so far apart.
struct Direction {
  Point along;
  std::int64_t length;
};
Direction draw_direction(Random& random) {
  const std::vector<Direction> directions{{{1, 0}, 1},    {{0, 1}, 1},   {{3, 4}, 5},
                                          {{-4, 3}, 5},   {{5, 12}, 13}, {{-8, 15}, 17},
                                          {{20, -21}, 29}};
  return random.pick(directions);
}

// `total` as a sum of two positive radii. Requires total >= 2.
std::pair<Disc, Disc> split(Random& random, Length total) {
  const Length first = draw(random, 1, total - 1);
  return {Disc{first}, Disc{total - first}};
}

// Two parallel lines exactly `reach` apart, give or take a unit; speeds equal or not.
Case parallel(Random& random, Length scale) {
  const Direction direction = draw_direction(random);
  const std::int64_t gap = draw_factor(random, 1, scale);
  const Ticks longest(scale.value());
  const Point normal{-direction.along.y, direction.along.x};
  const auto on_line = [&](const Point& base) {
    const Point from = base + draw_factor(random, -scale, scale) * direction.along;
    return Motion{from, from + draw_factor(random, 1, scale) * direction.along,
                  draw_ticks(random, 1, longest)};
  };
  Motion a = on_line({0, 0});
  Motion b = on_line(gap * normal);
  if (random.percent(30))
    b = {b.from, b.from + Point{a.to.x - a.from.x, a.to.y - a.from.y}, a.duration};
  if (random.percent(30)) std::swap(b.from, b.to);
  if (random.percent(10)) b = rest(b.from, b.duration);
  const Length reach = Length(gap * direction.length) + draw(random, -1, 1);
  auto [body_a, body_b] = split(random, std::max(reach, Length{2}));
  return {body_a, a, body_b, b};
}

// At the two ends of the motions the bodies are exactly `reach` apart, give or take a unit.
Case tangent_ends(Random& random, Length scale) {
  const Direction direction = draw_direction(random);
  const std::int64_t gap = draw_factor(random, 1, scale);
  Case c{Disc{1}, draw_motion(random, scale), Disc{1}, draw_motion(random, scale)};
  const Point at = (random.percent(50) ? c.a.from : c.a.to) + gap * direction.along;
  if (c.b.is_rest())
    c.b.from = c.b.to = at;
  else
    (random.percent(50) ? c.b.from : c.b.to) = at;
  if (c.b.is_rest() || c.b.duration == 0) c.b = rest(at, c.b.duration);
  const Length reach = Length(gap * direction.length) + draw(random, -1, 1);
  std::tie(c.body_a, c.body_b) = split(random, std::max(reach, Length{2}));
  return c;
}

// Behind one another on one line.
Case followers(Random& random, Length scale) {
  const Direction direction = draw_direction(random);
  const auto at = [&] { return draw_factor(random, 0, scale) * direction.along; };
  const Ticks longest(scale.value());
  const Ticks duration = draw_ticks(random, 1, longest);
  Motion a{at(), at(), duration};
  Motion b{at(), at(), random.percent(50) ? duration : draw_ticks(random, 1, longest)};
  if (random.percent(40)) b = {a.to, a.to + Point{a.to.x - a.from.x, a.to.y - a.from.y}, duration};
  if (a.is_rest()) a.to = a.to + direction.along;
  if (b.is_rest()) b.to = b.to + direction.along;
  auto [body_a, body_b] = split(random, draw(random, 2, 1 + scale));
  return {body_a, a, body_b, b};
}

// Velocities that differ by a few units over the whole motion, or not at all.
Case slow(Random& random, Length scale) {
  const Motion a = draw_motion(random, scale);
  const Point step{a.to.x - a.from.x, a.to.y - a.from.y};
  const Point from = draw_point(random, scale);
  Motion b{from, from + step + draw_point(random, 2), std::max(a.duration, Ticks{1})};
  if (random.percent(30)) b.duration += draw_ticks(random, 0, 2);
  auto [body_a, body_b] = split(random, draw(random, 2, 2 * scale));
  return {body_a, a, body_b, b};
}

Case anything(Random& random, Length scale) {
  const Ticks longest = random.percent(25) ? Ticks{3} : Ticks(draw_scale(random).value());
  Case c{Disc{1}, draw_motion(random, scale, longest), Disc{1},
         draw_motion(random, scale, longest)};
  if (random.percent(15)) c.b = {c.a.from, draw_point(random, scale), longest};  // Same start.
  if (random.percent(15)) c.b.to = c.a.to;
  if (c.b.duration == 0) c.b.duration = 1;
  std::tie(c.body_a, c.body_b) = split(random, draw(random, 2, scale));
  return c;
}

Motion scaled(const Motion& motion, std::int64_t factor) {
  return {factor * motion.from, factor * motion.to, motion.duration};
}

// Of length 3, and normal to each other.
const std::vector<Point> kAxes{{1, 2, 2}, {2, 1, -2}, {2, -2, 1}};

// b is moved out of the plane of `turned(c, which)` by as much as makes bodies that touched touch
// again, after their radii have grown: 3, 4 and 5 times the sum of the radii.
Case lifted(Case c, std::size_t which, support::Random& random) {
  Length &own = std::get<Disc>(c.body_a).radius, &other = std::get<Disc>(c.body_b).radius;
  const Length reach = own + other;
  const std::int64_t up = random.percent(50) ? 1 : -1;
  c.a = scaled(c.a, 4);
  c.b = scaled(c.b, 4);
  own = 4 * own + reach;
  other = 4 * other;
  Case result = turned(c, which);
  const Point across = kAxes[(which + 2) % 3];
  const Point shift = (up * 3 * reach.value()) * across;
  result.b.from = result.b.from + shift;
  result.b.to = result.b.to + shift;
  return result;
}

// Heights of their own for all ends.
Case with_heights(Case c, support::Random& random) {
  Length size = 1;
  for (const Point& p : {c.a.from, c.a.to, c.b.from, c.b.to})
    size = std::max({size, abs(p.x), abs(p.y)});
  for (Motion* motion : {&c.a, &c.b}) {
    const bool is_rest = motion->is_rest();
    motion->from.z = draw(random, -size, size);
    motion->to.z = is_rest || random.percent(30) ? motion->from.z : draw(random, -size, size);
  }
  return c;
}

Case in_space(const Case& c, Length most, support::Random& random) {
  Length size = 1;
  for (const Point& p : {c.a.from, c.a.to, c.b.from, c.b.to})
    size = std::max({size, abs(p.x), abs(p.y)});
  size = std::max({size, std::get<Disc>(c.body_a).radius, std::get<Disc>(c.body_b).radius});
  switch (random.below(3)) {
    case 0:
      return 6 * size > most ? with_heights(c, random) : turned(c, random.below(6));
    case 1:
      return 64 * size > most ? with_heights(c, random) : lifted(c, random.below(3), random);
    default:
      return with_heights(c, random);
  }
}

}  // namespace

std::ostream& operator<<(std::ostream& out, const Case& c) {
  return out << "Case{" << c.body_a << ", " << c.a << ", " << c.body_b << ", " << c.b << "}";
}

Length draw(Random& random, Length first, Length last) {
  return first + Length(static_cast<std::int64_t>(
                     random.below(static_cast<std::size_t>((last - first).value()) + 1)));
}

Ticks draw_ticks(Random& random, Ticks first, Ticks last) {
  return Ticks(draw(random, Length(first.value()), Length(last.value())).value());
}

ConvexPolygon random_polygon(Random& random, Length size) {
  while (true) {
    // Points on a circle, rounded: convex unless rounding spoils it.
    std::vector<double> angles;
    for (std::size_t n = random.percent(10) ? 40 : random.between(3, 7); n > 0; --n)
      angles.push_back(static_cast<double>(random.below(3600)) / 3600 * 6.283185307179586);
    std::sort(angles.begin(), angles.end());
    std::vector<Point> corners;
    const auto along = [&](double share) {
      return Length(static_cast<std::int64_t>(share * static_cast<double>(size.value())));
    };
    for (const double angle : angles)
      corners.push_back({along(std::cos(angle)), along(std::sin(angle))});
    if (random.percent(30)) corners = {{-size, -size}, {size, -size}, {size, size}, {-size, size}};
    if (auto polygon = ConvexPolygon::make(corners)) return *polygon;
  }
}

Case small_discs(Random& random) {
  const Length size = draw(random, 2, 30);
  Case c{Disc{draw(random, 1, 15)}, draw_motion(random, size, 25), Disc{draw(random, 1, 15)},
         draw_motion(random, size, 25)};
  if (random.percent(20)) c = followers(random, size);
  if (random.percent(20)) c = parallel(random, std::min(size, Length{6}));
  return c;
}

Case small_bodies(Random& random) {
  Case c = small_discs(random);
  const std::size_t which = random.between(1, 3);
  if (which & 1) c.body_a = random_polygon(random, draw(random, 2, 12));
  if (which & 2) c.body_b = random_polygon(random, draw(random, 2, 12));
  return c;
}

Case hard_discs(Random& random) {
  // Directions of length 29 multiply coordinates.
  const Length scale = std::min(draw_scale(random), Length(std::int64_t{1} << 32));
  switch (random.below(8)) {
    case 0:
    case 1:
      return parallel(random, scale);
    case 2:
      return tangent_ends(random, scale);
    case 3:
      return followers(random, scale);
    case 4:
      return slow(random, scale);
    case 5: {  // As far out as it goes.
      const Length far = kMaxLength;
      Case c{Disc{1}, draw_motion(random, far, kMaxDuration), Disc{1},
             draw_motion(random, far, random.percent(50) ? kMaxDuration : Ticks{5})};
      std::tie(c.body_a, c.body_b) = split(random, draw(random, 2, far));
      return c;
    }
    default:
      return anything(random, scale);
  }
}

Case turned(const Case& c, std::size_t which) {
  const std::size_t first = which % 3, second = (first + 1 + which / 3) % 3;
  const auto turn = [&](const Point& p) {
    return p.x.value() * kAxes[first] + p.y.value() * kAxes[second];
  };
  const auto larger = [](const Body& body) { return Disc{3 * std::get<Disc>(body).radius}; };
  return {larger(c.body_a),
          {turn(c.a.from), turn(c.a.to), c.a.duration},
          larger(c.body_b),
          {turn(c.b.from), turn(c.b.to), c.b.duration}};
}

Case small_balls(Random& random) { return in_space(small_discs(random), 4096, random); }

Case hard_balls(Random& random) { return in_space(hard_discs(random), kMaxLength, random); }

Case hard_bodies(Random& random) {
  Case c = hard_discs(random);
  const auto size = [](const Body& body) { return std::get<Disc>(body).radius; };
  const Length size_a = std::max(size(c.body_a), Length{3});
  const Length size_b = std::max(size(c.body_b), Length{3});
  const std::size_t which = random.between(1, 3);
  if (which & 1) c.body_a = random_polygon(random, size_a);
  if (which & 2) c.body_b = random_polygon(random, size_b);
  if (random.percent(25)) {  // Squares side by side on a grid.
    const Length unit = draw(random, 1, 1000000);
    const auto square = ConvexPolygon::make({{0, 0}, {unit, 0}, {unit, unit}, {0, unit}}).value();
    const auto place = [&] { return draw_point(random, 4); };
    c.body_a = c.body_b = square;
    const Ticks longest(4 * unit.value());
    c.a = scaled({place(), place(), draw_ticks(random, 1, longest)}, unit.value());
    c.b = scaled({place(), place(), draw_ticks(random, 1, longest)}, unit.value());
  }
  return c;
}

Point left_of(const Point& step) {
  std::int64_t s = 1, next_s = 0, t = 0, next_t = 1, a = step.x.value(), b = step.y.value();
  while (b != 0) {  // step.x s + step.y t == a
    const std::int64_t quotient = a / b;
    a = std::exchange(b, a - quotient * b);
    s = std::exchange(next_s, s - quotient * next_s);
    t = std::exchange(next_t, t - quotient * next_t);
  }
  const Point w{Length{-t}, Length{s}};
  __extension__ using Wide = __int128;
  const Wide ahead = Wide{w.x.value()} * step.x.value() + Wide{w.y.value()} * step.y.value();
  return ahead > 0 ? w : Point{w.x + step.x, w.y + step.y};
}

}  // namespace quadrille::geometry
