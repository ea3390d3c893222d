// SPDX-License-Identifier: MIT
#pragma once

#include "read/records.hpp"
#include "timed/road.hpp"

namespace quadrille_check {

/// Setting out along an edge at one of the ticks from `begin` to before `end`; or being at a vertex
/// at some moment between the two.
struct TimedBan {
  bool is_stay = false;
  int place = 0;
  Int begin = 0, end = 0;  // kNever: for ever
};

/// Of numbers in a file; `kind` is 0 or 1. Throws Rejected.
[[nodiscard]] TimedBan read_ban(const Road& road, Int kind, Int place, Int begin, Int end);

[[nodiscard]] Motion move_along(const Road& road, int agent, int edge, Int begin);
[[nodiscard]] Motion stay_at(const Road& road, int agent, int vertex, Int begin, Int end);

/// Whether all that breaks the ban, by that agent, meets the motion of another one.
[[nodiscard]] bool is_in_the_way(const Road& road, const Motion& other, int agent,
                                 const TimedBan& ban);

}  // namespace quadrille_check
