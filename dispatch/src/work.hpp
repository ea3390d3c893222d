// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "roads.hpp"
#include "robot.hpp"

namespace quadrille::dispatch {

/// Who is to get a path, the most urgent first, then those that have one and wait on it for others
/// that are late; and where each robot may go. First of all come those whose ways are closed, which
/// are to wait where they can.
struct Work {
  std::vector<AgentId> order;
  std::vector<Goals> goals;  ///< By robot.
};

/// Of robots that are sent to one place, or to places that overlap, one goes at a time: others get
/// no path before it is done there. Robots that need no path have the end of their course as a
/// goal, and some vertices near it.
[[nodiscard]] Work next_work(std::span<const Robot> robots, const continuous::Roadmap& roadmap,
                             const Roads& roads, std::int64_t call, Ticks now);

}  // namespace quadrille::dispatch
