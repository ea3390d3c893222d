// SPDX-License-Identifier: MIT
#include "quadrille/exports/planviz.hpp"

#include <cctype>
#include <nlohmann/json.hpp>
#include <vector>

namespace quadrille::exports {
namespace {

using continuous::Path;
using continuous::Pose;
using continuous::PoseGrid;
using Json = nlohmann::ordered_json;

/// What a robot does between two stops, in one timestep.
char action(const Pose& from, const Pose& to) {
  if (from.heading == to.heading) return 'F';
  return to.heading == right_of(from.heading) ? 'R' : 'C';
}

/// One letter per timestep, with commas. It waits at the end, until all have arrived.
std::string actions(const PoseGrid& poses, const Path& path, std::int64_t length) {
  std::string letters;
  for (std::size_t k = 0; k < path.size(); ++k) {
    letters.append(static_cast<std::size_t>((path[k].depart - path[k].arrive).value()), 'W');
    if (k + 1 < path.size())
      letters += action(poses.pose(path[k].vertex), poses.pose(path[k + 1].vertex));
  }
  letters.resize(static_cast<std::size_t>(length), 'W');
  std::string text;
  for (const char letter : letters) text += (text.empty() ? "" : ",") + std::string(1, letter);
  return text;
}

/// Row, column, and the heading as E, S, W or N.
Json start(const Pose& pose) {
  const auto letter = static_cast<char>(std::toupper(to_string(pose.heading).front()));
  return {pose.cell.y, pose.cell.x, std::string(1, letter)};
}

}  // namespace

std::string export_planviz(const PoseGrid& poses, const continuous::Plan& plan,
                           const continuous::VerifyReport& report) {
  Json starts = Json::array(), paths = Json::array(), events = Json::array();
  Json tasks = Json::array(), schedule = Json::array();
  std::size_t task = 0;
  for (const Path& path : plan.paths) {
    starts.push_back(start(poses.pose(path.front().vertex)));
    paths.push_back(actions(poses, path, report.makespan));
    const Pose end = poses.pose(path.back().vertex);
    tasks.push_back({task, 0, {end.cell.y, end.cell.x}});
    schedule.push_back("0:" + std::to_string(task));
    events.push_back({cost(path), task, task, 1});
    ++task;
  }
  const Json result = {{"actionModel", "MAPF_T"},
                       {"version", "2024 LoRR"},
                       {"teamSize", plan.paths.size()},
                       {"start", starts},
                       {"numTaskFinished", plan.paths.size()},
                       {"sumOfCost", report.sum_of_costs},
                       {"makespan", report.makespan},
                       {"actualPaths", paths},
                       {"plannerPaths", paths},
                       {"plannerTimes", Json::array()},
                       {"errors", Json::array()},
                       {"actualSchedule", schedule},
                       {"plannerSchedule", schedule},
                       {"scheduleErrors", Json::array()},
                       {"events", events},
                       {"tasks", tasks}};
  // A line for each member.
  std::string text;
  for (const auto& [key, value] : result.items())
    text += (text.empty() ? "{\n" : ",\n") + Json(key).dump() + ": " + value.dump();
  return text + "\n}\n";
}

}  // namespace quadrille::exports
