// SPDX-License-Identifier: MIT
#include "roads.hpp"

#include <algorithm>
#include <cstdint>
#include <string>
#include <unordered_set>

#include "open_task.hpp"

namespace quadrille::dispatch {
namespace {

/// Where robots may go that have to go nowhere: so many places.
constexpr std::size_t kPlacesNear = 16;

std::string lane_name(VertexId from, VertexId to) {
  return "the lane from vertex " + std::to_string(from.value()) + " to vertex " +
         std::to_string(to.value());
}

bool has_lane(const continuous::Roadmap& roadmap, VertexId from, VertexId to) {
  if (from.index() >= roadmap.num_vertices() || to.index() >= roadmap.num_vertices()) return false;
  const auto edges = roadmap.out_edges(from);
  return std::any_of(edges.begin(), edges.end(),
                     [&](continuous::EdgeId e) { return roadmap.edge(e).to == to; });
}

}  // namespace

std::optional<Error> Roads::close(VertexId from, VertexId to) {
  if (!has_lane(*roadmap_, from, to)) return invalid("there is not " + lane_name(from, to));
  if (!closed_.emplace(from, to).second) return invalid(lane_name(from, to) + " is closed already");
  return std::nullopt;
}

std::optional<Error> Roads::open(VertexId from, VertexId to) {
  if (!has_lane(*roadmap_, from, to)) return invalid("there is not " + lane_name(from, to));
  if (closed_.erase({from, to}) == 0) return invalid(lane_name(from, to) + " is not closed");
  return std::nullopt;
}

std::vector<continuous::EdgeId> Roads::closed_edges() const {
  std::vector<continuous::EdgeId> edges;
  for (const auto& [from, to] : closed_)
    for (const continuous::EdgeId e : roadmap_->out_edges(from))
      if (roadmap_->edge(e).to == to) edges.push_back(e);
  return edges;
}

std::optional<Ticks> Roads::barrier(const Course& course, Ticks since) const {
  if (are_open()) return std::nullopt;
  for (std::size_t k = 0; k + 1 < course.size(); ++k) {
    const Spot &here = course[k].spot, &next = course[k + 1].spot;
    if (!here.is_vertex() || course[k].depart < since) continue;
    if (closed_.contains({here.from, next.is_vertex() ? next.from : next.to}))
      return course[k].depart;
  }
  return std::nullopt;
}

std::vector<VertexId> Roads::reach(const continuous::Agent& agent, VertexId from,
                                   std::size_t most) const {
  std::unordered_set<std::uint32_t> is_found{from.value()};
  std::vector<VertexId> found{from};
  for (std::size_t k = 0; k < found.size() && found.size() < most; ++k)
    for (const continuous::EdgeId e : roadmap_->out_edges(found[k])) {
      const continuous::Edge& edge = roadmap_->edge(e);
      if (!edge.open_to.contains(agent.group) || closed_.contains({edge.from, edge.to})) continue;
      if (is_found.insert(edge.to.value()).second) found.push_back(edge.to);
    }
  return found;
}

bool Roads::lead(const continuous::Agent& agent, VertexId from, const Goals& goals) const {
  const std::vector<VertexId> found = reach(agent, from, SIZE_MAX);
  return std::any_of(found.begin(), found.end(), [&](VertexId v) { return goals.contains(v); });
}

Goals Roads::near(const continuous::Agent& agent, VertexId vertex) const {
  std::vector<VertexId> places = reach(agent, vertex, kPlacesNear);
  if (places.size() == 1) places.emplace_back(vertex.index() == 0 ? 1 : 0);
  return Goals(std::move(places));
}

}  // namespace quadrille::dispatch
