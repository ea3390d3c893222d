// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "quadrille/core/export.hpp"
#include "quadrille/exports/samples.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::exports {

/// Whose fields messages have: in ROS 1 times are `secs` and `nsecs`, in ROS 2 `sec` and `nanosec`.
enum class RosVersion { one = 1, two = 2 };

/// The last second that times of messages can name, in either version.
inline constexpr double kLastRosSecond = std::numeric_limits<std::int32_t>::max();

/// trajectory_msgs/MultiDOFJointTrajectory of one robot: a trajectory begins when its header says,
/// and its times count from there. Requires samples, none later than kLastRosSecond.
/// One line of JSON.
[[nodiscard]] std::string multidof_message(const std::string& robot,
                                           const std::vector<Sample>& samples, RosVersion version);
/// nav_msgs/Path of one robot. Requires the same.
[[nodiscard]] std::string path_message(const std::vector<Sample>& samples, RosVersion version);

}  // namespace quadrille::exports

QUADRILLE_API_END
