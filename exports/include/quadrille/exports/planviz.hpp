// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "quadrille/continuous/pose_grid.hpp"
#include "quadrille/continuous/verify.hpp"
#include "quadrille/core/export.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::exports {

/// A plan of robots that turn as PlanViz shows it, the viewer of the League of Robot Runners: the
/// result of a simulation, in which robot k does task k, to get to its goal. Requires a valid plan
/// on these poses, on which a quarter turn takes one timestep; `report`: what `verify` says of it.
[[nodiscard]] std::string export_planviz(const continuous::PoseGrid& poses,
                                         const continuous::Plan& plan,
                                         const continuous::VerifyReport& report);

}  // namespace quadrille::exports

QUADRILLE_API_END
