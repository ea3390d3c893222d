// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "quadrille/discrete/instance.hpp"
#include "quadrille/discrete/solver.hpp"

namespace quadrille::discrete::support {

/// Passes, retired counters, searches from above and candidates occur on small instances, too.
struct Pace {
  std::int64_t first_turn = 0;  ///< 0: as usual.
  Cost candidates_within = 8;
};

/// A small instance that is to be solved with a certificate.
struct Case {
  Instance instance;
  SolveOptions options;
  Pace pace;
};
[[nodiscard]] Case draw(std::uint64_t seed);
/// Most of them have no plan, for all reasons that there are.
[[nodiscard]] Instance draw_crowded(std::uint64_t seed);

[[nodiscard]] SolveOutcome solve_at(const Instance& instance, const SolveOptions& options,
                                    const Pace& pace);

}  // namespace quadrille::discrete::support
