// SPDX-License-Identifier: MIT
#include "quadrille/execution/clearance.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <variant>

namespace quadrille::execution {
namespace {

double real(Ticks ticks) { return static_cast<double>(ticks.value()); }
double real(geometry::Length length) { return static_cast<double>(length.value()); }

/// How far the body reaches in the direction of a unit vector.
double extent(const geometry::Body& body, double ux, double uy) {
  if (const auto* disc = std::get_if<geometry::Disc>(&body)) return real(disc->radius);
  double most = -std::numeric_limits<double>::infinity();
  for (const geometry::Point& p : std::get<geometry::ConvexPolygon>(body).vertices())
    most = std::max(most, real(p.x) * ux + real(p.y) * uy);
  return most;
}

bool is_disc(const geometry::Body& body) { return std::holds_alternative<geometry::Disc>(body); }

}  // namespace

ClearanceWatch::ClearanceWatch(const continuous::Instance& instance, const continuous::Plan& plan)
    : instance_(instance),
      plan_(plan),
      stops_(plan.paths.size(), 0),
      ways_(plan.paths.size()),
      gone_(plan.paths.size(), 2) {
  double size = 1;
  for (const geometry::Point& p : instance.roadmap().positions())
    size = std::max({size, std::abs(real(p.x)), std::abs(real(p.y)), std::abs(real(p.z))});
  touch_ = -1e-10 * size;
}

ClearanceWatch::Vector ClearanceWatch::place(AgentId agent, double clock) const {
  const continuous::Path& path = plan_.paths[agent];
  std::size_t k = stops_[agent];
  while (k + 1 < path.size() && real(path[k + 1].arrive) <= clock) ++k;
  const geometry::Place here = instance_.roadmap().place(path[k].vertex);
  const auto between = [](const geometry::Point& from, const geometry::Point& to, double share) {
    return Vector{real(from.x) + real(to.x - from.x) * share,
                  real(from.y) + real(to.y - from.y) * share,
                  real(from.z) + real(to.z - from.z) * share};
  };
  const double behind = real(here.behind) / real(here.whole);
  if (k + 1 == path.size() || clock <= real(path[k].depart))
    return between(here.from, here.to, behind);
  const geometry::Point& to = instance_.roadmap().position(path[k + 1].vertex);
  const double share = (clock - real(path[k].depart)) / real(path[k + 1].arrive - path[k].depart);
  return between(here.from, to, behind + (1 - behind) * share);
}

continuous::ShapeId ClearanceWatch::shape(AgentId agent, Ticks tick, bool stands_still) const {
  const continuous::Path& path = plan_.paths[agent];
  const continuous::Roadmap& roadmap = instance_.roadmap();
  std::size_t k = stops_[agent];
  while (k + 1 < path.size() && path[k + 1].arrive <= tick) ++k;
  const bool has_left = stands_still ? tick > path[k].depart : tick >= path[k].depart;
  if (k + 1 == path.size() || !has_left) return roadmap.shape(path[k].vertex);
  return roadmap.shape(path[k].vertex, path[k + 1].vertex);
}

void ClearanceWatch::lay_out(AgentId agent, Ticks before, Ticks after) {
  const continuous::Path& path = plan_.paths[agent];
  std::vector<Knot>& way = ways_[agent];
  way.clear();
  std::size_t& stop = stops_[agent];
  while (stop + 1 < path.size() && path[stop + 1].arrive <= before) ++stop;
  const bool stands_still = after <= before;
  way.push_back({0, place(agent, real(before)), shape(agent, before, stands_still)});
  if (after > before)
    for (std::size_t k = stop; k < path.size() && path[k].arrive < after; ++k)
      for (const Ticks tick : {path[k].arrive, path[k].depart})
        if (before < tick && tick < after)
          way.push_back({real(tick - before) / real(after - before), place(agent, real(tick)),
                         shape(agent, tick, false)});
  way.push_back({1, place(agent, real(after))});
  gone_[agent] = 2;
  if (!instance_.agent(agent).leaves) return;
  const Ticks end = path.back().arrive;
  if (before >= end)
    gone_[agent] = 0;
  else if (after > end)
    gone_[agent] = real(end - before) / real(after - before);
}

// Polygons are flat, and so is all that is done with them.
double ClearanceWatch::gap(const geometry::Body& a, const geometry::Body& b, const Vector& offset) {
  double most = -std::numeric_limits<double>::infinity();
  // The gap along a direction is no more than the distance, and is the distance for one of these.
  const auto along = [&](double x, double y) {
    const double length = std::hypot(x, y);
    if (length == 0) return;
    x /= length;
    y /= length;
    most = std::max(most, offset.x * x + offset.y * y - extent(a, x, y) - extent(b, -x, -y));
  };
  along(offset.x, offset.y);
  if (offset.x == 0 && offset.y == 0) along(1, 0);
  const auto add_polygon = [&](const geometry::Body& body, double sign) {
    const auto* polygon = std::get_if<geometry::ConvexPolygon>(&body);
    if (polygon == nullptr) return;
    const auto& corners = polygon->vertices();
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const geometry::Point &p = corners[k], &q = corners[(k + 1) % corners.size()];
      along(sign * real(q.y - p.y), sign * real(p.x - q.x));
      along(offset.x - sign * real(p.x), offset.y - sign * real(p.y));
      if (const auto* other = std::get_if<geometry::ConvexPolygon>(sign > 0 ? &b : &a))
        for (const geometry::Point& r : other->vertices())
          along(offset.x - sign * real(p.x - r.x), offset.y - sign * real(p.y - r.y));
    }
  };
  add_polygon(a, 1);
  add_polygon(b, -1);
  return most;
}

double ClearanceWatch::least_gap(const geometry::Body& a, const geometry::Body& b, double reach,
                                 const Vector& from, const Vector& to) const {
  const Vector way{to.x - from.x, to.y - from.y, to.z - from.z};
  const auto at = [&](double share) {
    return Vector{from.x + way.x * share, from.y + way.y * share, from.z + way.z * share};
  };
  const double square = way.x * way.x + way.y * way.y + way.z * way.z;
  const double towards = -(from.x * way.x + from.y * way.y + from.z * way.z);
  const Vector nearest = at(square == 0 ? 0 : std::clamp(towards / square, 0.0, 1.0));
  const double room = std::hypot(nearest.x, nearest.y, nearest.z) - reach;
  if (is_disc(a) && is_disc(b)) return room;
  if (room > std::max(0.0, least_)) return room;
  // A convex function of the share as long as it is positive.
  double low = 0, high = 1, least = std::min(gap(a, b, from), gap(a, b, to));
  for (int round = 0; round < 60; ++round) {
    const double p = low + (high - low) / 3, q = high - (high - low) / 3;
    const double at_p = gap(a, b, at(p)), at_q = gap(a, b, at(q));
    least = std::min({least, at_p, at_q});
    if (at_p < at_q)
      high = q;
    else
      low = p;
  }
  return least;
}

void ClearanceWatch::look_at(AgentId i, AgentId j) {
  const std::vector<Knot>&a = ways_[i], &b = ways_[j];
  const auto between = [](const std::vector<Knot>& way, std::size_t k, double share) {
    const Knot &p = way[k], &q = way[k + 1];
    const double part = q.share > p.share ? (share - p.share) / (q.share - p.share) : 1;
    return Vector{p.place.x + (q.place.x - p.place.x) * part,
                  p.place.y + (q.place.y - p.place.y) * part,
                  p.place.z + (q.place.z - p.place.z) * part};
  };
  const double reach =
      real(instance_.reach(instance_.class_of(i))) + real(instance_.reach(instance_.class_of(j)));
  std::size_t m = 0, n = 0;
  double share = 0;
  while (share < std::min(gone_[i], gone_[j])) {
    const double next = std::min(a[m + 1].share, b[n + 1].share);
    const Vector p0 = between(a, m, share), p1 = between(a, m, next);
    const Vector q0 = between(b, n, share), q1 = between(b, n, next);
    // At a moment between two steps a body has the shape of neither.
    if (next > share) {
      const double free = least_gap(
          instance_.agent(i).body_as(a[m].shape), instance_.agent(j).body_as(b[n].shape), reach,
          {q0.x - p0.x, q0.y - p0.y, q0.z - p0.z}, {q1.x - p1.x, q1.y - p1.y, q1.z - p1.z});
      least_ = std::min(least_, free);
      if (free < touch_) contacts_.emplace(i, j);
    }
    if (next >= 1) return;
    if (a[m + 1].share <= next) ++m;
    if (b[n + 1].share <= next) ++n;
    share = next;
  }
}

void ClearanceWatch::add(std::span<const Ticks> before, std::span<const Ticks> after) {
  for (const AgentId i : instance_.agent_ids()) lay_out(i, before[i.index()], after[i.index()]);
  for (const AgentId i : instance_.agent_ids())
    for (std::size_t j = i.index() + 1; j < before.size(); ++j) look_at(i, AgentId(j));
}

void ConflictWatch::add(std::span<const Ticks> before, std::span<const Ticks> after) {
  std::multimap<VertexId, AgentId> was, is;
  const auto place = [&](std::size_t i, Ticks clock) {
    return discrete::position(plan_.paths[AgentId(i)],
                              static_cast<Timestep>(clock.value() - plan_.now));
  };
  const auto meet = [&](AgentId i, AgentId j) {
    contacts_.emplace(std::min(i, j), std::max(i, j));
  };
  const auto is_gone = [&](std::size_t i) {
    const AgentId agent(i);
    return !leaves_.empty() && leaves_[agent] &&
           before[i].value() >= plan_.now + discrete::arrival(plan_.paths[agent]);
  };
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (is_gone(i)) continue;
    was.emplace(place(i, before[i]), AgentId(i));
    is.emplace(place(i, after[i]), AgentId(i));
  }
  for (auto at = is.begin(); at != is.end(); ++at)
    for (auto other = std::next(at); other != is.end() && other->first == at->first; ++other)
      meet(at->second, other->second);
  for (const auto& [vertex, i] : is) {
    const VertexId from = place(i.index(), before[i.index()]);
    if (from == vertex) continue;
    const auto [first, last] = was.equal_range(vertex);
    for (auto other = first; other != last; ++other)
      if (place(other->second.index(), after[other->second.index()]) == from)
        meet(i, other->second);
  }
}

}  // namespace quadrille::execution
