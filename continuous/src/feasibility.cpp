// SPDX-License-Identifier: MIT
//
// The joint positions of two agents on two edges e and f are a square: how far the one has come on
// e and how far the other on f. Where they collide is an open convex part of it, since their
// relative position is an affine function and discs are convex. So on each side of the square it is
// one interval, which leaves only pieces that contain a corner; and two corners are connected in
// the rest of the square unless the convex part separates them, that is, unless it reaches the
// boundary on both ways around from the one to the other. Squares meet along their sides. So the
// corners, pairs of vertices, tell which joint positions can be reached from which.
#include "quadrille/continuous/feasibility.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include "quadrille/geometry/body_pair.hpp"

namespace quadrille::continuous {
namespace {

using Segment = std::pair<std::size_t, std::size_t>;

/// The edges without direction, each once.
std::vector<Segment> segments_of(const Roadmap& roadmap) {
  std::vector<Segment> segments;
  for (const Edge& edge : roadmap.edges())
    segments.push_back(std::minmax({edge.from.index(), edge.to.index()}));
  std::sort(segments.begin(), segments.end());
  segments.erase(std::unique(segments.begin(), segments.end()), segments.end());
  return segments;
}

/// What is connected, for two discs whose radii have a given sum.
class JointPositions {
 public:
  JointPositions(const Roadmap& roadmap, const std::vector<Segment>& segments, Length reach)
      : num_vertices_(roadmap.num_vertices()), parent_(num_vertices_ * num_vertices_) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
    // Only the sum of the radii matters, which is 2 at least.
    const geometry::BodyPair pair(geometry::Disc{reach - reach / 2}, geometry::Disc{reach / 2});
    const auto at = [&](std::size_t v) { return roadmap.positions()[v]; };
    for (std::size_t v = 0; v < num_vertices_; ++v)
      for (std::size_t w = 0; w < num_vertices_; ++w)
        overlaps_.push_back(pair.overlap(at(v), at(w)));
    for (const auto& [from, to] : segments)
      for (std::size_t v = 0; v < num_vertices_; ++v)
        hinders_.push_back(
            pair.can_meet(geometry::rest(at(v), 1), geometry::Motion{at(from), at(to), 1}));
    for (std::size_t e = 0; e < segments.size(); ++e) {
      for (std::size_t v = 0; v < num_vertices_; ++v) connect_side(segments[e], e, v);
      for (std::size_t f = 0; f < segments.size(); ++f)
        connect_square(segments[e], e, segments[f], f);
    }
  }

  [[nodiscard]] bool connected(Segment one, Segment other) {
    return find(joint(one)) == find(joint(other));
  }

 private:
  [[nodiscard]] std::size_t joint(Segment places) const {
    return places.first * num_vertices_ + places.second;
  }

  std::size_t find(std::size_t x) {
    while (parent_[x] != x) x = parent_[x] = parent_[parent_[x]];
    return x;
  }

  /// One of the two moves along an edge and nobody is in the way at `v`.
  void connect_side(const Segment& a, std::size_t e, std::size_t v) {
    if (hinders_[e * num_vertices_ + v]) return;
    unite(joint({a.first, v}), joint({a.second, v}));
    unite(joint({v, a.first}), joint({v, a.second}));
  }

  /// Whatever one convex part does not separate; free sides are connected already.
  void connect_square(const Segment& a, std::size_t e, const Segment& b, std::size_t f) {
    // Around the square; side k is between corners k and k + 1.
    const std::array<std::size_t, 4> corners = {
        joint({a.first, b.first}), joint({a.second, b.first}), joint({a.second, b.second}),
        joint({a.first, b.second})};
    const std::array<bool, 4> blocked_sides = {
        hinders_[e * num_vertices_ + b.first], hinders_[f * num_vertices_ + a.second],
        hinders_[e * num_vertices_ + b.second], hinders_[f * num_vertices_ + a.first]};
    // Runs of what is blocked, counted where they end: at a free corner after a blocked side.
    int runs = 0;
    for (std::size_t k = 0; k < 4; ++k)
      runs += blocked_sides[k] && !overlaps_[corners[(k + 1) % 4]] ? 1 : 0;
    if (runs > 1) return;
    std::size_t free = 4;
    for (std::size_t k = 0; k < 4; ++k) {
      if (overlaps_[corners[k]]) continue;
      if (free < 4) unite(corners[free], corners[k]);
      free = k;
    }
  }

  void unite(std::size_t x, std::size_t y) { parent_[find(x)] = find(y); }

  const std::size_t num_vertices_;
  std::vector<std::size_t> parent_;  // by pair of vertices
  std::vector<bool> overlaps_;       // by pair of vertices
  std::vector<bool> hinders_;        // by edge, then vertex: who stands there is in the way of it
};

}  // namespace

std::string describe(const StuckPair& pair) {
  return "agents " + std::to_string(pair.first.index()) + " and " +
         std::to_string(pair.second.index()) +
         " cannot both get to their goals: these edges have no room for them to pass each other";
}

std::optional<StuckPair> find_stuck_pair(const Instance& instance, std::int64_t effort) {
  const Roadmap& roadmap = instance.roadmap();
  const std::vector<Segment> segments = segments_of(roadmap);
  std::map<Length, std::vector<StuckPair>> pairs;  // by the sum of the radii
  for (const AgentId i : instance.agent_ids())
    for (const AgentId j : instance.agent_ids())
      if (i < j) pairs[instance.agent(i).radius + instance.agent(j).radius].push_back({i, j});

  // As floating-point numbers, which do not overflow; exact where it matters.
  const auto vertices = static_cast<double>(roadmap.num_vertices());
  const auto edges = static_cast<double>(segments.size());
  const double steps = vertices * vertices + 4 * vertices * edges + edges * edges;
  double left = static_cast<double>(effort);
  for (const auto& [reach, of_reach] : pairs) {
    left -= steps;
    if (left < 0) break;
    JointPositions joint(roadmap, segments, reach);
    for (const StuckPair& pair : of_reach) {
      const Agent &a = instance.agent(pair.first), &b = instance.agent(pair.second);
      if (!joint.connected({a.start.index(), b.start.index()}, {a.goal.index(), b.goal.index()}))
        return pair;
    }
  }
  return std::nullopt;
}

}  // namespace quadrille::continuous
