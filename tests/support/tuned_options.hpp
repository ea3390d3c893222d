// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

#include "quadrille/discrete/solver.hpp"

namespace quadrille::discrete::support {

/// Options with settings that users do not choose, but tests do.
struct TunedOptions : SolveOptions {
  std::optional<std::int64_t> first_turn;  ///< Settings::core_turn
  std::optional<std::int64_t> round;       ///< Settings::grid_round
  /// From so many path lemmas on agents have explicit paths, however large.
  std::optional<std::int64_t> first_explicit;
  std::optional<bool> open;  ///< Cost search as on open maps, or others.
};

/// As the function without settings.
[[nodiscard]] Result<SolveOutcome> solve(const Instance& instance, const TunedOptions& options);

}  // namespace quadrille::discrete::support
