// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "quadrille/continuous/instance.hpp"
#include "quadrille/dispatch/dispatcher.hpp"

namespace quadrille::dispatch {

/// A robot of a dispatcher.
struct Robot {
  struct Open {
    Task task;
    std::uint64_t number = 0;  // in the order of assignments
  };

  continuous::Agent agent;
  Course course;
  Ticks clock = 0, limit = 0;
  std::deque<Open> tasks;
  bool is_bound = false;                    // its course ends at a goal of its first task
  std::optional<Ticks> busy_until = {};     // it is there, until then
  bool is_held = false;                     // it waits for those that are late
  std::int64_t next_try = 0, patience = 1;  // calls: after looking for a path in vain
  Ticks clock_at_origin = -1;               // when there was a new origin for the last time

  [[nodiscard]] bool has_arrived() const { return clock >= end_of(course); }
  [[nodiscard]] bool wants_path() const { return !tasks.empty() && !is_bound && !busy_until; }
};

/// Whether the first one's task comes first: the earlier deadline, or else the earlier assignment.
[[nodiscard]] inline bool is_more_urgent(const Robot& a, const Robot& b) {
  if (a.tasks.empty() || b.tasks.empty()) return !a.tasks.empty();
  const auto &x = a.tasks.front().task.deadline, &y = b.tasks.front().task.deadline;
  if (x && y && *x != *y) return *x < *y;
  if (x.has_value() != y.has_value()) return x.has_value();
  return a.tasks.front().number < b.tasks.front().number;
}

}  // namespace quadrille::dispatch
