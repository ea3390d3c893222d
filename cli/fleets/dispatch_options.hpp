// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "fleets/dispatch.hpp"
#include "quadrille/core/effort.hpp"
#include "quadrille/dispatch/task.hpp"

namespace quadrille::cli {

/// A time of the command line in ticks of this size, at least one.
[[nodiscard]] inline dispatch::Ticks whole_ticks(double time, double tick) {
  return std::max(dispatch::Ticks{1},
                  dispatch::Ticks(static_cast<std::int64_t>(std::llround(time / tick))));
}

/// Of a call.
[[nodiscard]] inline Effort effort_of(const DispatchArguments& arguments) {
  constexpr double kMilliseconds = 20;
  return Effort::nanoseconds(
      static_cast<std::int64_t>(1e6 * arguments.effort.value_or(kMilliseconds)));
}

}  // namespace quadrille::cli
