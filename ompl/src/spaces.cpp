// SPDX-License-Identifier: MIT
#include "spaces.hpp"

#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/base/spaces/SE2StateSpace.h>

#include <string>
#include <typeinfo>

namespace quadrille::ompl_bridge {

using ::ompl::base::RealVectorStateSpace;
using ::ompl::base::SE2StateSpace;

namespace {

// Spaces that are derived from it have motions of their own, such as Dubins curves.
bool is_se2(const ::ompl::base::StateSpace& space) {
  return typeid(space) == typeid(SE2StateSpace);
}

}  // namespace

std::optional<Error> refuse(const ::ompl::base::StateSpace& space) {
  if (is_se2(space)) return std::nullopt;
  std::string reason = "only straight motions in R2, R3 and SE2 become lanes";
  if (typeid(space) == typeid(RealVectorStateSpace)) {
    const unsigned dimensions = space.getDimension();
    if (dimensions == 2 || dimensions == 3) return std::nullopt;
    reason = "it has " + std::to_string(dimensions) + " dimensions, and roadmaps have 2 or 3";
  }
  return Error{ErrorCode::invalid_instance,
               "the state space '" + space.getName() + "' is not supported: " + reason,
               {}};
}

std::optional<Error> refuse(const ::ompl::base::StateSpace& space, const fleet::Point& place) {
  const bool has_heights = !is_se2(space) && space.getDimension() == 3;
  if (has_heights || place.z == fleet::Metres(0)) return std::nullopt;
  return Error{ErrorCode::invalid_instance,
               "a place at height " + to_string(place.z) + " is none of the state space '" +
                   space.getName() + "', which is flat",
               {}};
}

fleet::Point place_of(const ::ompl::base::StateSpace& space, const ::ompl::base::State& state) {
  if (is_se2(space)) {
    const auto& pose = *state.as<SE2StateSpace::StateType>();
    return {fleet::Metres(pose.getX()), fleet::Metres(pose.getY())};
  }
  const double* const values = state.as<RealVectorStateSpace::StateType>()->values;
  const double height = space.getDimension() == 3 ? values[2] : 0;
  return {fleet::Metres(values[0]), fleet::Metres(values[1]), fleet::Metres(height)};
}

void set_state(const ::ompl::base::StateSpace& space, ::ompl::base::State& state,
               const fleet::Point& place, double yaw) {
  if (is_se2(space)) {
    auto& pose = *state.as<SE2StateSpace::StateType>();
    pose.setXY(place.x.value(), place.y.value());
    pose.setYaw(yaw);
    return;
  }
  double* const values = state.as<RealVectorStateSpace::StateType>()->values;
  values[0] = place.x.value();
  values[1] = place.y.value();
  if (space.getDimension() == 3) values[2] = place.z.value();
}

}  // namespace quadrille::ompl_bridge
