// SPDX-License-Identifier: MIT
#include "quadrille/ompl/planner_data.hpp"

#include <ompl/base/ScopedState.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "spaces.hpp"

namespace quadrille::ompl_bridge {

using ::ompl::base::PlannerData;
using ::ompl::base::ScopedState;

Result<std::vector<VertexId>> add_planner_data(fleet::RoadmapBuilder& roads,
                                               const PlannerData& data) {
  const auto& space = *data.getSpaceInformation()->getStateSpace();
  if (auto error = refuse(space)) return *error;
  std::vector<fleet::Point> places;
  for (unsigned i = 0; i < data.numVertices(); ++i) {
    places.push_back(place_of(space, *data.getVertex(i).getState()));
    const auto& [x, y, z] = places[i];
    if (!std::isfinite(x.value()) || !std::isfinite(y.value()) || !std::isfinite(z.value()))
      return Error{ErrorCode::invalid_instance,
                   "state " + std::to_string(i) + " of the planner data has no finite coordinates",
                   {}};
  }
  // In steps of the resolution, as the builder rounds. What is too far away is for it to refuse.
  const double step = roads.resolution().length.value();
  std::map<std::array<double, 3>, VertexId> known;
  std::vector<VertexId> vertices;
  for (const fleet::Point& place : places) {
    const auto steps = [&](fleet::Metres value) { return std::round(value.value() / step); };
    const std::array rounded{steps(place.x), steps(place.y), steps(place.z)};
    const auto found = known.find(rounded);
    vertices.push_back(found == known.end() ? roads.vertex(place) : found->second);
    known.emplace(rounded, vertices.back());
  }
  for (unsigned i = 0; i < data.numVertices(); ++i) {
    std::vector<unsigned> ends;
    data.getEdges(i, ends);
    for (const unsigned end : ends)
      if (vertices[i] != vertices[end]) roads.lane(vertices[i], vertices[end]);
  }
  return vertices;
}

Result<std::vector<VertexId>> add_roadmap(fleet::RoadmapBuilder& roads,
                                          const ::ompl::base::Planner& planner) {
  PlannerData data(planner.getSpaceInformation());
  planner.getPlannerData(data);
  return add_planner_data(roads, data);
}

namespace {

/// What `v` may be joined with, the nearest first.
std::vector<VertexId> others_by_distance(const fleet::RoadmapBuilder& roads, VertexId v,
                                         const JoinOptions& options) {
  std::vector<std::pair<fleet::Metres, VertexId>> near;
  const auto add = [&](VertexId w) {
    QUADRILLE_REQUIRE(w.index() < roads.num_vertices(), "vertices of the roadmap");
    const fleet::Metres way = distance(roads.position(v), roads.position(w));
    if (way >= roads.resolution().length * 2) near.emplace_back(way, w);
  };
  if (options.among)
    for (const VertexId w : *options.among) add(w);
  else
    for (const VertexId w : IdRange<VertexId>(roads.num_vertices())) add(w);
  std::sort(near.begin(), near.end());
  // States in the same place are one vertex, which is then named several times.
  near.erase(std::unique(near.begin(), near.end()), near.end());
  std::vector<VertexId> vertices;
  for (const auto& entry : near) vertices.push_back(entry.second);
  return vertices;
}

}  // namespace

Result<std::size_t> join(fleet::RoadmapBuilder& roads, const ::ompl::base::SpaceInformation& space,
                         VertexId v, const JoinOptions& options) {
  QUADRILLE_REQUIRE(v.index() < roads.num_vertices(), "a vertex of the roadmap");
  if (auto error = refuse(*space.getStateSpace())) return *error;
  if (auto error = refuse(*space.getStateSpace(), roads.position(v))) return *error;
  const auto state = [&](VertexId w) {
    ScopedState<> made(space.getStateSpace());
    set_state(*space.getStateSpace(), *made, roads.position(w), 0);
    return made;
  };
  const ScopedState<> here = state(v);
  if (!space.isValid(here.get())) return std::size_t{0};
  std::size_t joined = 0;
  for (const VertexId w : others_by_distance(roads, v, options)) {
    if (joined == options.neighbours) break;
    if (refuse(*space.getStateSpace(), roads.position(w))) continue;
    const ScopedState<> there = state(w);
    // OMPL takes the beginning of a motion for valid.
    if (!space.isValid(there.get())) continue;
    const bool leaves = space.checkMotion(here.get(), there.get());
    const bool comes = space.checkMotion(there.get(), here.get());
    if (leaves) roads.lane(v, w);
    if (comes) roads.lane(w, v);
    joined += leaves || comes ? 1 : 0;
  }
  return joined;
}

}  // namespace quadrille::ompl_bridge
