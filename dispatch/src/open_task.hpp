// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "quadrille/core/result.hpp"
#include "quadrille/dispatch/task.hpp"

namespace quadrille::dispatch {

/// A task that is not done yet.
struct OpenTask {
  Task task;
  std::int64_t number = 0;  // in the order of assignments
};

/// The earlier deadline, or else the earlier assignment.
[[nodiscard]] inline bool comes_first(const OpenTask& a, const OpenTask& b) {
  const auto &x = a.task.deadline, &y = b.task.deadline;
  if (x && y && *x != *y) return *x < *y;
  if (x.has_value() != y.has_value()) return x.has_value();
  return a.number < b.number;
}

// What is wrong with what a dispatcher is told.

[[nodiscard]] inline std::string robot_name(AgentId robot) {
  return "robot " + std::to_string(robot.index());
}
[[nodiscard]] inline Error invalid(const std::string& message) {
  return {ErrorCode::invalid_instance, message, {}};
}
[[nodiscard]] inline Error out_of_range(const std::string& message) {
  return {ErrorCode::out_of_range, message, {}};
}
/// A robot that there is not, or times that are negative or longer than `longest`.
[[nodiscard]] inline std::optional<Error> refuse_task(AgentId robot, std::size_t num_robots,
                                                      const Task& task, Ticks longest) {
  if (robot.index() >= num_robots) return invalid("there is no " + robot_name(robot));
  if (task.service < 0 || task.service > longest || (task.deadline && *task.deadline < 0))
    return out_of_range("the task of " + robot_name(robot) +
                        " has a time that is negative or too long");
  return std::nullopt;
}

}  // namespace quadrille::dispatch
