// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "quadrille/continuous/instance.hpp"
#include "quadrille/dispatch/dispatcher.hpp"
#include "roadmap/dispatch_roadmap.hpp"

namespace quadrille::cli {

/// A time of the command line in ticks, at least one.
[[nodiscard]] inline continuous::Ticks whole_ticks(double time,
                                                   const continuous::Resolution& resolution) {
  return std::max(
      continuous::Ticks{1},
      continuous::Ticks(static_cast<std::int64_t>(std::llround(time / resolution.time))));
}

/// What the dispatcher is asked.
[[nodiscard]] inline dispatch::Options dispatcher_options(
    const DispatchArguments& arguments, const continuous::Resolution& resolution) {
  constexpr double kMilliseconds = 20;
  dispatch::Options options;
  options.effort = Effort::nanoseconds(
      static_cast<std::int64_t>(1e6 * arguments.effort.value_or(kMilliseconds)));
  if (arguments.reach) options.reach = whole_ticks(*arguments.reach, resolution);
  if (arguments.patience) options.patience = whole_ticks(*arguments.patience, resolution);
  options.improves = !arguments.does_not_improve;
  return options;
}

}  // namespace quadrille::cli
