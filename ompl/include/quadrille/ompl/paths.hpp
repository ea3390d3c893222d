// SPDX-License-Identifier: MIT
#pragma once

#include <ompl/base/SpaceInformation.h>
#include <ompl/geometric/PathGeometric.h>

#include <vector>

#include "quadrille/core/export.hpp"
#include "quadrille/core/result.hpp"
#include "quadrille/fleet/timed_plan.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::ompl_bridge {

/// A path of OMPL with a time for each of its states. Where a robot waits, one state follows on an
/// equal one. (OMPL's PathControl has durations, too, but rounds them to propagation steps.)
struct TimedGeometric {
  ::ompl::geometric::PathGeometric path;
  std::vector<fleet::Seconds> times;  ///< One per state, not decreasing.
};

/// What one robot does, as OMPL has it. `space`: of a space that is known, see planner_data.hpp.
/// `yaw`: of all states in SE2; robots do not turn. Errors: invalid_instance for another space,
/// and for a path with heights in a flat one.
[[nodiscard]] Result<TimedGeometric> to_geometric(const fleet::TimedPath& path,
                                                  const ::ompl::base::SpaceInformationPtr& space,
                                                  double yaw = 0);

}  // namespace quadrille::ompl_bridge

QUADRILLE_API_END
