// SPDX-License-Identifier: MIT
#include "continuous/support/meeting.hpp"

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <variant>

#include "geometry/oracle.hpp"

namespace quadrille::continuous::test {
namespace {

using Wide = boost::multiprecision::checked_int256_t;

/// A square of a length, as a fraction.
struct Square {
  Wide over, under = 1;
};
bool less(const Square& a, const Square& b) { return a.over * b.under < b.over * a.under; }

/// The least square of the distance between the centres while both elements last, times
/// `scale` squared; nothing if they share no moment.
struct Nearest {
  std::optional<Square> square;
  Wide scale = 1;
};

Ticks length(const Element& e) { return std::max<Ticks>(e.end - e.begin, 1); }

// Times the lengths of both elements the distance is (x + u t, y + v t, z + w t), in integers.
Nearest nearest(const Element& a, const Element& b) {
  const Ticks begin = std::max(a.begin, b.begin);
  const Ticks end = std::min(a.end, b.end);
  const Wide la = length(a).value(), lb = length(b).value();
  if (begin > end) return {std::nullopt, la * lb};
  const Wide u = lb * (a.to.x - a.from.x).value() - la * (b.to.x - b.from.x).value();
  const Wide v = lb * (a.to.y - a.from.y).value() - la * (b.to.y - b.from.y).value();
  const Wide w = lb * (a.to.z - a.from.z).value() - la * (b.to.z - b.from.z).value();
  const auto at_zero = [&](Length from_a, Length to_a, Length from_b, Length to_b) -> Wide {
    return lb * (la * from_a.value() - Wide((to_a - from_a).value()) * a.begin.value()) -
           la * (lb * from_b.value() - Wide((to_b - from_b).value()) * b.begin.value());
  };
  const Wide x = at_zero(a.from.x, a.to.x, b.from.x, b.to.x);
  const Wide y = at_zero(a.from.y, a.to.y, b.from.y, b.to.y);
  const Wide z = at_zero(a.from.z, a.to.z, b.from.z, b.to.z);
  const Wide speed = u * u + v * v + w * w;
  const Wide approach = -(x * u + y * v + z * w);  // speed * the moment at which they are nearest
  const auto at = [&](Ticks t) {
    const Wide dx = x + u * t.value(), dy = y + v * t.value(), dz = z + w * t.value();
    return Nearest{Square{dx * dx + dy * dy + dz * dz}, la * lb};
  };
  if (approach <= speed * begin.value()) return at(begin);
  if (approach >= speed * end.value()) return at(end);
  const Wide xy = x * v - y * u, yz = y * w - z * v, zx = z * u - x * w;  // the cross product
  return {Square{xy * xy + yz * yz + zx * zx, speed}, la * lb};
}

Element moved(Element e, Ticks by) {
  e.begin += by;
  e.end += by;
  return e;
}

/// The last of [yes, no) at which `is_so`, which is true first and then false.
template <class Predicate>
Ticks last_true(Ticks yes, Ticks no, const Predicate& is_so) {
  while (no - yes > 1 || yes - no > 1) {
    const Ticks middle = yes + (no - yes) / 2;
    (is_so(middle) ? yes : no) = middle;
  }
  return yes;
}

/// The sum of the radii of two discs.
std::optional<Length> reach_of(const Body& a, const Body& b) {
  const auto *disc_a = std::get_if<Disc>(&a), *disc_b = std::get_if<Disc>(&b);
  if (disc_a == nullptr || disc_b == nullptr) return std::nullopt;
  return disc_a->radius + disc_b->radius;
}

bool discs_meet(const Element& a, const Element& b, Length reach) {
  const Nearest n = nearest(a, b);
  const Wide scaled_reach = n.scale * reach.value();
  return n.square && less(*n.square, {scaled_reach * scaled_reach});
}

// Positions are linear in time, so the distance is a convex function of two moments, and what is
// least at each difference between these is one of the difference: it falls and then rises.
std::optional<Run> disc_starts(const Element& a, const Element& b, Length reach) {
  const auto apart = [](Length a0, Length a1, Length b0, Length b1, Length by) {
    return std::max(a0, a1) + by <= std::min(b0, b1) || std::max(b0, b1) + by <= std::min(a0, a1);
  };
  if (apart(a.from.x, a.to.x, b.from.x, b.to.x, reach) ||
      apart(a.from.y, a.to.y, b.from.y, b.to.y, reach) ||
      apart(a.from.z, a.to.z, b.from.z, b.to.z, reach))
    return std::nullopt;
  const auto meets = [&](Ticks d) { return discs_meet(a, moved(b, d), reach); };
  // These are the differences at which they share a moment.
  Ticks low = a.begin - b.end, high = a.end - b.begin;
  while (low < high && !meets(low + (high - low) / 2)) {
    const Ticks middle = low + (high - low) / 2;
    const Square here = *nearest(a, moved(b, middle)).square;
    const Square next = *nearest(a, moved(b, middle + 1)).square;
    if (less(next, here))
      low = middle + 1;
    else
      high = middle;
  }
  low += (high - low) / 2;
  if (!meets(low)) return std::nullopt;
  return Run{last_true(low, a.begin - b.end - 1, meets),
             last_true(low, a.end - b.begin + 1, meets)};
}

/// The smallest box with sides along the axes that contains the body all the time.
struct Box {
  Length left, right, bottom, top;
};
Box swept_box(const Element& e, const Body& body) {
  Box box{std::min(e.from.x, e.to.x), std::max(e.from.x, e.to.x), std::min(e.from.y, e.to.y),
          std::max(e.from.y, e.to.y)};
  if (const auto* disc = std::get_if<Disc>(&body))
    return {box.left - disc->radius, box.right + disc->radius, box.bottom - disc->radius,
            box.top + disc->radius};
  const auto& corners = std::get<geometry::ConvexPolygon>(body).vertices();
  const auto [left, right] = std::ranges::minmax(corners, {}, &geometry::Point::x);
  const auto [bottom, top] = std::ranges::minmax(corners, {}, &geometry::Point::y);
  return {box.left + left.x, box.right + right.x, box.bottom + bottom.y, box.top + top.y};
}

/// Whether the bodies are apart at all times, whenever the elements begin. Nearly all are, and the
/// integers of the exact test are wide and slow.
bool always_apart(const Element& a, const Body& body_a, const Element& b, const Body& body_b) {
  const Box p = swept_box(a, body_a), q = swept_box(b, body_b);
  return p.right <= q.left || q.right <= p.left || p.top <= q.bottom || q.top <= p.bottom;
}

}  // namespace

bool meet(const Element& a, const Body& body_a, const Element& b, const Body& body_b) {
  if (const auto reach = reach_of(body_a, body_b)) return discs_meet(a, b, *reach);
  const auto motion = [](const Element& e) {
    return geometry::Motion{e.from, e.to, e.end - e.begin};
  };
  if (always_apart(a, body_a, b, body_b)) return false;
  return geometry::oracle::Oracle<Wide>(body_a, motion(a), body_b, motion(b))
      .collide(b.begin - a.begin);
}

// For polygons all differences are tried: the elements have to be short.
std::optional<Run> meeting_starts(const Element& a, const Body& body_a, const Element& b,
                                  const Body& body_b) {
  if (const auto reach = reach_of(body_a, body_b)) return disc_starts(a, b, *reach);
  if (always_apart(a, body_a, b, body_b)) return std::nullopt;
  std::optional<Run> run;
  for (Ticks d = a.begin - b.end; d <= a.end - b.begin; d += 1) {
    if (!meet(a, body_a, moved(b, d), body_b)) continue;
    if (!run) run = Run{d, d};
    run->last = d;
  }
  return run;
}

std::optional<Clearance> clearance(const Element& move, const Body& mover, Point place,
                                   const Body& resident) {
  const Ticks before = move.begin - 1, after = move.end + 1;
  const auto meets = [&](Ticks from, Ticks until) {
    return meet(move, mover, {place, place, from, until}, resident);
  };
  if (!meets(before, after)) return std::nullopt;
  const Ticks leave = last_true(after, before, [&](Ticks t) { return meets(before, t); }) - 1;
  const Ticks arrive = last_true(before, after, [&](Ticks t) { return meets(t, after); }) + 1;
  return Clearance{move.begin - leave, arrive - move.begin};
}

std::optional<Run> without_ends(std::optional<Run> run, const Element& a, const Element& b) {
  if (!run) return run;
  if (run->first == a.begin - b.end) run->first += 1;
  if (run->last == a.end - b.begin) run->last -= 1;
  return run->first > run->last ? std::nullopt : run;
}

std::optional<Clearance> without_ends(std::optional<Clearance> clear, const Element& move) {
  if (!clear) return clear;
  if (clear->after_leaving == 1) clear->after_leaving = 0;
  if (clear->before_arrival == move.end - move.begin + 1) clear->before_arrival -= 1;
  return clear;
}

namespace {

struct Vec {
  Wide x, y, z;
};
Vec minus(const Point& p, const Point& q) {
  return {Wide((p.x - q.x).value()), Wide((p.y - q.y).value()), Wide((p.z - q.z).value())};
}
Wide dot(const Vec& p, const Vec& q) { return p.x * q.x + p.y * q.y + p.z * q.z; }
Vec cross(const Vec& p, const Vec& q) {
  return {p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x};
}

struct Line {
  Point from, to;
};

Square to_line(const Point& p, const Line& line) {
  const Vec along = minus(line.to, line.from), off = minus(p, line.from);
  const Wide share = dot(off, along), whole = dot(along, along);
  if (share <= 0) return {dot(off, off)};
  const Vec end = minus(p, line.to);
  if (share >= whole) return {dot(end, end)};
  return {dot(off, off) * whole - share * share, whole};
}

/// Of the distance: at an end of one of them, or where their common normal is within both.
Square between(const Line& a, const Line& b) {
  Square least = to_line(a.from, b);
  for (const Square& other : {to_line(a.to, b), to_line(b.from, a), to_line(b.to, a)})
    if (less(other, least)) least = other;
  const Vec u = minus(a.to, a.from), v = minus(b.to, b.from), w = minus(b.from, a.from);
  const Vec normal = cross(u, v);
  const Wide square = dot(normal, normal);
  const Wide s = dot(cross(w, v), normal), t = dot(cross(w, u), normal);
  if (square > 0 && 0 < s && s < square && 0 < t && t < square) {
    const Wide off = dot(w, normal);
    if (const Square inner{off * off, square}; less(inner, least)) least = inner;
  }
  return least;
}

/// The convex hull of points, grown by a radius.
struct Sweep {
  std::vector<Point> points;
  Length radius = 0;
};

Sweep sweep_of(const Element& e, const Body& body) {
  if (const auto* const disc = std::get_if<Disc>(&body)) return {{e.from, e.to}, disc->radius};
  Sweep sweep;
  for (const Point& corner : std::get<geometry::ConvexPolygon>(body).vertices())
    for (const Point& at : {e.from, e.to})
      sweep.points.push_back({at.x + corner.x, at.y + corner.y, at.z});
  return sweep;
}

/// Whether a line along two points of the one or the other has all of the one on one side and all
/// of the other on the other side, in the plane.
bool are_separated(const Sweep& a, const Sweep& b) {
  for (const Sweep* const sides : {&a, &b})
    for (const Point& p : sides->points)
      for (const Point& q : sides->points) {
        const Vec axis{Wide((p.y - q.y).value()), Wide((q.x - p.x).value()), 0};
        if (axis.x == 0 && axis.y == 0) continue;
        const auto along = [&](const Point& point) -> Wide {
          return axis.x * point.x.value() + axis.y * point.y.value();
        };
        Wide most_a = along(a.points[0]), least_b = along(b.points[0]);
        for (const Point& point : a.points) most_a = std::max(most_a, along(point));
        for (const Point& point : b.points) least_b = std::min(least_b, along(point));
        if (most_a <= least_b) return true;
      }
  return false;
}

}  // namespace

bool sweeps_meet(const Element& a, const Body& body_a, const Element& b, const Body& body_b) {
  const Sweep p = sweep_of(a, body_a), q = sweep_of(b, body_b);
  const bool has_area_p = p.points.size() > 2, has_area_q = q.points.size() > 2;
  if ((has_area_p || has_area_q) && !are_separated(p, q)) return true;
  const Wide reach = (p.radius + q.radius).value();
  for (const Point& p0 : p.points)
    for (const Point& p1 : p.points)
      for (const Point& q0 : q.points)
        for (const Point& q1 : q.points)
          if (less(between({p0, p1}, {q0, q1}), {reach * reach})) return true;
  return false;
}

Meetings::Meetings(const Instance& instance) : instance_(instance) {
  const std::size_t edges = instance.roadmap().num_edges();
  const std::size_t pairs = instance.num_classes() * instance.num_classes();
  moves_.resize(pairs * edges * edges);
  stays_.resize(pairs * edges * instance.roadmap().num_vertices());
}

const std::optional<Run>& Meetings::moves(ClassId a, EdgeId e, ClassId b, EdgeId f) {
  const std::size_t edges = instance_.roadmap().num_edges();
  Known<Run>& known =
      moves_[((a.index() * instance_.num_classes() + b.index()) * edges + e.index()) * edges +
             f.index()];
  if (known.is_known) return known.value;
  const Roadmap& roadmap = instance_.roadmap();
  known = {true, meeting_starts(element(a, e), instance_.body(a, roadmap.edge(e).shape),
                                element(b, f), instance_.body(b, roadmap.edge(f).shape))};
  if (have_shapes(a, b)) known.value = without_ends(known.value, element(a, e), element(b, f));
  if (instance_.has_whole_moves() &&
      sweeps_meet(element(a, e), instance_.body(a, roadmap.edge(e).shape), element(b, f),
                  instance_.body(b, roadmap.edge(f).shape))) {
    Run& run = known.value ? *known.value : known.value.emplace();
    run.first = std::min(run.first, 1 - element(b, f).end);
    run.last = std::max(run.last, element(a, e).end - 1);
  }
  return known.value;
}

const std::optional<Clearance>& Meetings::stay(ClassId a, EdgeId e, ClassId b, VertexId v) {
  const std::size_t edges = instance_.roadmap().num_edges();
  const std::size_t vertices = instance_.roadmap().num_vertices();
  Known<Clearance>& known =
      stays_[((a.index() * instance_.num_classes() + b.index()) * edges + e.index()) * vertices +
             v.index()];
  if (known.is_known) return known.value;
  const Roadmap& roadmap = instance_.roadmap();
  known = {true, clearance(element(a, e), instance_.body(a, roadmap.edge(e).shape),
                           roadmap.position(v), instance_.body(b, roadmap.shape(v)))};
  if (have_shapes(a, b)) known.value = without_ends(known.value, element(a, e));
  return known.value;
}

Element Meetings::element(ClassId c, EdgeId e) const {
  const Roadmap& roadmap = instance_.roadmap();
  return {roadmap.position(roadmap.edge(e).from), roadmap.position(roadmap.edge(e).to), 0,
          instance_.duration(c, e)};
}

}  // namespace quadrille::continuous::test
