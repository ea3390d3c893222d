// SPDX-License-Identifier: MIT
#include "execution/replay.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <variant>

namespace quadrille::execution::test {
namespace {

using Real = Replay::Real;

Real real(geometry::Ticks ticks) { return static_cast<Real>(ticks.value()); }
Real real(geometry::Length length) { return static_cast<Real>(length.value()); }

/// The moments of [x0, x1], as shares of it, at which a path begins or ends a move.
void add_breaks(const continuous::Path& path, Real x0, Real x1, std::vector<Real>& shares) {
  for (const continuous::Stop& stop : path)
    for (const Real clock : {real(stop.arrive), real(stop.depart)})
      if (x0 < clock && clock < x1) shares.push_back((clock - x0) / (x1 - x0));
}

/// max over p in the body of p . u
Real support(const geometry::Body& body, Real ux, Real uy) {
  if (const auto* disc = std::get_if<geometry::Disc>(&body))
    return real(disc->radius) * std::hypot(ux, uy);
  Real most = -std::numeric_limits<Real>::infinity();
  for (const geometry::Point& p : std::get<geometry::ConvexPolygon>(body).vertices())
    most = std::max(most, real(p.x) * ux + real(p.y) * uy);
  return most;
}

}  // namespace

Replay::Vector Replay::place(AgentId agent, Real clock) const {
  const continuous::Path& path = plan_.paths[agent];
  std::size_t k = 0;
  while (k + 1 < path.size() && real(path[k + 1].arrive) <= clock) ++k;
  const auto at = [&](VertexId v) {
    const geometry::Point& p = instance_.roadmap().position(v);
    return Vector{real(p.x), real(p.y), real(p.z)};
  };
  const Vector from = at(path[k].vertex);
  if (k + 1 == path.size() || clock <= real(path[k].depart)) return from;
  const Vector to = at(path[k + 1].vertex);
  const Real share =
      (clock - real(path[k].depart)) / (real(path[k + 1].arrive) - real(path[k].depart));
  return {from.x + (to.x - from.x) * share, from.y + (to.y - from.y) * share,
          from.z + (to.z - from.z) * share};
}

/// Of bodies in the plane: the largest gap between them along any direction that can be the one of
/// least distance.
Real Replay::apart(const geometry::Body& a, const geometry::Body& b, const Vector& offset) {
  Real most = -std::numeric_limits<Real>::infinity();
  const auto look = [&](Real ux, Real uy) {
    const Real length = std::hypot(ux, uy);
    if (length == 0) return;
    ux /= length;
    uy /= length;
    most =
        std::max(most, offset.x * ux + offset.y * uy - support(a, ux, uy) - support(b, -ux, -uy));
  };
  look(offset.x, offset.y);
  const auto look_at = [&](const geometry::Body& body, Real sign) {
    const auto* polygon = std::get_if<geometry::ConvexPolygon>(&body);
    if (polygon == nullptr) return;
    const auto& corners = polygon->vertices();
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const geometry::Point &p = corners[k], &q = corners[(k + 1) % corners.size()];
      look(sign * real(q.y - p.y), -sign * real(q.x - p.x));           // out of the edge
      look(offset.x - sign * real(p.x), offset.y - sign * real(p.y));  // from a corner to a disc
    }
  };
  look_at(a, 1);
  look_at(b, -1);
  const auto *of_a = std::get_if<geometry::ConvexPolygon>(&a),
             *of_b = std::get_if<geometry::ConvexPolygon>(&b);
  if (of_a != nullptr && of_b != nullptr)
    for (const geometry::Point& p : of_a->vertices())
      for (const geometry::Point& q : of_b->vertices())
        look(offset.x + real(q.x) - real(p.x), offset.y + real(q.y) - real(p.y));
  return most;
}

const geometry::Body& Replay::body(AgentId agent, Real clock) const {
  const continuous::Path& path = plan_.paths[agent];
  const continuous::Roadmap& roadmap = instance_.roadmap();
  std::size_t k = 0;
  while (k + 1 < path.size() && real(path[k + 1].arrive) <= clock) ++k;
  const bool stands = k + 1 == path.size() || clock <= real(path[k].depart);
  return instance_.agent(agent).body_as(stands ? roadmap.shape(path[k].vertex)
                                               : roadmap.shape(path[k].vertex, path[k + 1].vertex));
}

Real Replay::straight(const geometry::Body& a, const geometry::Body& b, const Vector& from,
                      const Vector& to) {
  const Vector way{to.x - from.x, to.y - from.y, to.z - from.z};
  const Real square = way.x * way.x + way.y * way.y + way.z * way.z;
  const auto at = [&](Real share) {
    return Vector{from.x + way.x * share, from.y + way.y * share, from.z + way.z * share};
  };
  const Real towards = -(from.x * way.x + from.y * way.y + from.z * way.z);
  const Real nearest = square == 0 ? 0 : std::clamp<Real>(towards / square, 0, 1);
  const Vector closest = at(nearest);
  const auto *disc_a = std::get_if<geometry::Disc>(&a), *disc_b = std::get_if<geometry::Disc>(&b);
  if (disc_a != nullptr && disc_b != nullptr)
    return std::hypot(closest.x, closest.y, closest.z) - real(disc_a->radius) -
           real(disc_b->radius);
  const auto reach = [](const geometry::Body& body) {
    return real(geometry::enclosing_radius(body));
  };
  const Real room = std::hypot(closest.x, closest.y) - reach(a) - reach(b);
  if (room > 1) return room;
  // The distance of convex bodies is a convex function of the offset.
  Real low = 0, high = 1;
  Real least = std::min(apart(a, b, from), apart(a, b, to));
  for (int round = 0; round < 50; ++round) {
    const Real p = low + (high - low) / 3, q = high - (high - low) / 3;
    const Real at_p = apart(a, b, at(p)), at_q = apart(a, b, at(q));
    least = std::min({least, at_p, at_q});
    (at_p < at_q ? high : low) = at_p < at_q ? q : p;
  }
  return least;
}

Real Replay::separation(AgentId i, Real x0, Real x1, AgentId j, Real y0, Real y1) const {
  std::vector<Real> shares{0, 1};
  add_breaks(plan_.paths[i], x0, x1, shares);
  add_breaks(plan_.paths[j], y0, y1, shares);
  std::sort(shares.begin(), shares.end());
  const auto offset = [&](Real share) {
    const Vector a = place(i, x0 + (x1 - x0) * share), b = place(j, y0 + (y1 - y0) * share);
    return Vector{b.x - a.x, b.y - a.y, b.z - a.z};
  };
  const auto is_gone = [&](AgentId a, Real clock) {
    return instance_.agent(a).leaves && clock >= real(plan_.paths[a].back().arrive);
  };
  Real least = std::numeric_limits<Real>::infinity();
  for (std::size_t k = 0; k + 1 < shares.size(); ++k) {
    // At a moment between two steps a body has the shape of neither.
    if (shares[k] >= shares[k + 1]) continue;
    const Real middle = (shares[k] + shares[k + 1]) / 2;
    const Real x = x0 + (x1 - x0) * middle, y = y0 + (y1 - y0) * middle;
    if (!is_gone(i, x) && !is_gone(j, y))
      least = std::min(least,
                       straight(body(i, x), body(j, y), offset(shares[k]), offset(shares[k + 1])));
  }
  return least;
}

Real Replay::least_separation(const std::vector<Real>& before,
                              const std::vector<Real>& after) const {
  Real least = std::numeric_limits<Real>::infinity();
  for (std::size_t i = 0; i < before.size(); ++i)
    for (std::size_t j = i + 1; j < before.size(); ++j)
      if (before[i] != after[i] || before[j] != after[j])
        least = std::min(
            least, separation(AgentId(i), before[i], after[i], AgentId(j), before[j], after[j]));
  return least;
}

bool collide(const discrete::Instance& instance, const discrete::Plan& plan,
             const std::vector<std::size_t>& before, const std::vector<std::size_t>& after) {
  std::map<VertexId, std::size_t> at_before, at_after;
  const auto place = [&](std::size_t i, std::size_t t) {
    return discrete::position(plan.paths[AgentId(i)], static_cast<Timestep>(t));
  };
  // Who leaves is nowhere after the step in which it comes to its end.
  const auto is_gone = [&](std::size_t i) {
    return instance.agents()[AgentId(i)].leaves && before[i] + 1 >= plan.paths[AgentId(i)].size();
  };
  for (std::size_t i = 0; i < before.size(); ++i)
    if (!is_gone(i) && (!at_before.emplace(place(i, before[i]), i).second ||
                        !at_after.emplace(place(i, after[i]), i).second))
      return true;
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (is_gone(i)) continue;
    const auto other = at_before.find(place(i, after[i]));
    if (other == at_before.end() || other->second == i) continue;
    if (place(other->second, after[other->second]) == place(i, before[i])) return true;
  }
  return false;
}

}  // namespace quadrille::execution::test
