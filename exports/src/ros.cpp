// SPDX-License-Identifier: MIT
#include "quadrille/exports/ros.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

namespace quadrille::exports {
namespace {

using Json = nlohmann::ordered_json;

Json point(double x, double y, double z) { return {{"x", x}, {"y", y}, {"z", z}}; }
/// About the axis of z.
Json rotation(double yaw) {
  return {{"x", 0.0}, {"y", 0.0}, {"z", std::sin(yaw / 2)}, {"w", std::cos(yaw / 2)}};
}
/// A time or a duration.
Json stamp(double time, RosVersion version) {
  const auto nanoseconds = std::llround(time * 1e9);
  const bool is_old = version == RosVersion::one;
  return {{is_old ? "secs" : "sec", nanoseconds / 1'000'000'000},
          {is_old ? "nsecs" : "nanosec", nanoseconds % 1'000'000'000}};
}
Json header(double time, RosVersion version) {
  return {{"stamp", stamp(time, version)}, {"frame_id", "map"}};
}

}  // namespace

std::string multidof_message(const std::string& robot, const std::vector<Sample>& samples,
                             RosVersion version) {
  const double begin = samples.front().time;
  Json points = Json::array();
  for (const Sample& s : samples)
    points.push_back(
        {{"transforms", {{{"translation", point(s.x, s.y, s.z)}, {"rotation", rotation(s.yaw)}}}},
         {"velocities",
          {{{"linear", point(s.vx, s.vy, s.vz)}, {"angular", point(0, 0, s.turning)}}}},
         {"accelerations", Json::array()},
         {"time_from_start", stamp(s.time - begin, version)}});
  return Json({{"header", header(begin, version)}, {"joint_names", {robot}}, {"points", points}})
      .dump();
}

std::string path_message(const std::vector<Sample>& samples, RosVersion version) {
  Json poses = Json::array();
  for (const Sample& s : samples)
    poses.push_back(
        {{"header", header(s.time, version)},
         {"pose", {{"position", point(s.x, s.y, s.z)}, {"orientation", rotation(s.yaw)}}}});
  return Json({{"header", header(samples.front().time, version)}, {"poses", poses}}).dump();
}

}  // namespace quadrille::exports
