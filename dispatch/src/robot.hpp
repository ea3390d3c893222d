// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "open_task.hpp"
#include "quadrille/continuous/instance.hpp"
#include "quadrille/dispatch/course.hpp"

namespace quadrille::dispatch {

/// A robot of a dispatcher.
struct Robot {
  continuous::Agent agent;
  Course course;
  Ticks clock = 0, limit = 0;
  std::deque<OpenTask> tasks;
  bool is_bound = false;                 // its course ends at a goal of its first task
  std::optional<Ticks> busy_until = {};  // it is there, until then
  bool is_barred = false;      // its course leads into a lane that is closed, or cannot be gone on
  std::int64_t num_stuck = 0;  // calls on end in which it was allowed nothing
  bool is_held = false;        // it waits for those that are late
  std::int64_t next_try = 0, patience = 1;  // calls: after looking for a path in vain
  Ticks clock_at_origin = -1;               // when there was a new origin for the last time

  [[nodiscard]] bool has_arrived() const { return clock >= end_of(course); }
  [[nodiscard]] bool wants_path() const {
    return !tasks.empty() && !is_bound && !busy_until && !is_barred;
  }
};

/// Whether the first one's task comes first.
[[nodiscard]] inline bool is_more_urgent(const Robot& a, const Robot& b) {
  if (a.tasks.empty() || b.tasks.empty()) return !a.tasks.empty();
  return comes_first(a.tasks.front(), b.tasks.front());
}

}  // namespace quadrille::dispatch
