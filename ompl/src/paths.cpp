// SPDX-License-Identifier: MIT
#include "quadrille/ompl/paths.hpp"

#include <ompl/base/ScopedState.h>

#include "spaces.hpp"

namespace quadrille::ompl_bridge {

Result<TimedGeometric> to_geometric(const fleet::TimedPath& path,
                                    const ::ompl::base::SpaceInformationPtr& space, double yaw) {
  QUADRILLE_REQUIRE(space != nullptr, "a space");
  if (auto error = refuse(*space->getStateSpace())) return *error;
  TimedGeometric result{::ompl::geometric::PathGeometric(space), {}};
  ::ompl::base::ScopedState<> state(space);
  for (const fleet::Stop& stop : path.stops()) {
    if (auto error = refuse(*space->getStateSpace(), stop.place)) return *error;
    set_state(*space->getStateSpace(), *state, stop.place, yaw);
    result.path.append(state.get());
    result.times.push_back(stop.arrive);
    if (stop.depart == stop.arrive) continue;
    result.path.append(state.get());
    result.times.push_back(stop.depart);
  }
  return result;
}

}  // namespace quadrille::ompl_bridge
