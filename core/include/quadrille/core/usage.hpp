// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <optional>

#include "quadrille/core/export.hpp"
#include "quadrille/core/limits.hpp"

QUADRILLE_API_BEGIN

namespace quadrille {

/// What was used of what Limits speak of, since some moment; not negative.
struct Usage {
  double wall_s = 0, cpu_s = 0;
  double memory_mib = 0;  ///< By which the process has grown.
};

/// What `used` leaves of the limits of time and memory; not negative.
[[nodiscard]] inline Limits limits_left(Limits limits, const Usage& used) {
  const auto take = [](std::optional<double>& limit, double part) {
    if (limit) limit = std::max(0.0, *limit - part);
  };
  take(limits.wall_s, used.wall_s);
  take(limits.cpu_s, used.cpu_s);
  take(limits.memory_mib, used.memory_mib);
  return limits;
}

}  // namespace quadrille

QUADRILLE_API_END
