// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

#include "quadrille/discrete/solver.hpp"

namespace quadrille::discrete::support {

/// Options with settings that users do not choose, but tests do.
struct TunedOptions : SolveOptions {
  std::optional<std::int64_t> first_turn;  ///< See sat::CoreGuidedOptions. 1 .. 2^31 - 1.
  std::optional<std::int64_t> round;       ///< See Tuning. 1 or more.
  std::optional<bool> open;                ///< Cost search as on open maps, or others.
};

/// As the function without settings.
[[nodiscard]] Result<SolveOutcome> solve(const Instance& instance, const TunedOptions& options);

}  // namespace quadrille::discrete::support
