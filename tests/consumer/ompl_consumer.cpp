// SPDX-License-Identifier: MIT
// A user of the installed component ompl.
#include <ompl/base/spaces/RealVectorStateSpace.h>

#include <quadrille/ompl/planner_data.hpp>

int main() {
  const auto space = std::make_shared<ompl::base::RealVectorStateSpace>(2);
  const auto info = std::make_shared<ompl::base::SpaceInformation>(space);
  quadrille::fleet::RoadmapBuilder roads;
  const auto added = quadrille::ompl_bridge::add_planner_data(roads, ompl::base::PlannerData(info));
  return added && added->empty() ? 0 : 1;
}
