// SPDX-License-Identifier: MIT
#pragma once

#include <ompl/base/Planner.h>
#include <ompl/base/PlannerData.h>

#include <cstddef>
#include <optional>
#include <vector>

#include "quadrille/core/export.hpp"
#include "quadrille/core/ids.hpp"
#include "quadrille/core/result.hpp"
#include "quadrille/fleet/roadmap.hpp"

QUADRILLE_API_BEGIN

// The namespace is not called `ompl`, so that `using namespace quadrille` leaves `ompl::base` what
// it is. Spaces that are known: RealVectorStateSpace of dimension 2 or 3, in metres, and
// SE2StateSpace, of which x and y count: robots do not turn, so validity must not depend on the
// yaw. In three dimensions robots have to be discs, which are spheres there. Other spaces are
// refused, among them those with curves such as Dubins'.

namespace quadrille::ompl_bridge {

/// Adds the states of a roadmap that OMPL has made as vertices, and its edges, which are directed,
/// as lanes. Returns the vertex of each state, in the order of the planner data. States that the
/// resolution puts into the same place become one vertex, and edges between them nothing; vertices
/// that were there before stay apart, so that a roadmap for each class of robots is one call for
/// each: a robot keeps to the roadmap on which it starts, and all mind each other.
///
/// That motions are valid has been checked by OMPL, for the robot its validity checker knows. The
/// ends of a lane move by up to 0.71 `length` of the resolution, in space 0.87, and OMPL checks
/// motions at points only: see docs/robots.md for the margin this asks of the checker.
///
/// Errors: invalid_instance for a space that is not known and a state without finite coordinates;
/// `roads` is then as it was. Those of RoadmapBuilder::build come there. O((V + E) log V).
[[nodiscard]] Result<std::vector<VertexId>> add_planner_data(fleet::RoadmapBuilder& roads,
                                                             const ::ompl::base::PlannerData& data);

/// The same for what a planner has found so far, such as the roadmap of a PRM.
[[nodiscard]] Result<std::vector<VertexId>> add_roadmap(fleet::RoadmapBuilder& roads,
                                                        const ::ompl::base::Planner& planner);

struct JoinOptions {
  std::size_t neighbours = 6;  ///< How many to be joined with, if there are that many.
  /// These only, such as the vertices of the roadmap of one class; by default all there are.
  std::optional<std::vector<VertexId>> among = {};
};

/// Joins a vertex, such as the station of a robot, with the nearest other ones, by a road where
/// both directions are valid motions and a lane where one is. Returns how many it has been joined
/// with; 0 if the place itself is not valid. Vertices nearer than twice the resolution's `length`
/// are left aside: they may be the same place; so are those with heights in a flat space. Requires
/// vertices of the roadmap. Errors: invalid_instance for a space that is not known, and for a
/// vertex with a height in a flat one. O(V log V) and two checks of a motion for each vertex that
/// is tried.
[[nodiscard]] Result<std::size_t> join(fleet::RoadmapBuilder& roads,
                                       const ::ompl::base::SpaceInformation& space, VertexId v,
                                       const JoinOptions& options = {});

}  // namespace quadrille::ompl_bridge

QUADRILLE_API_END
