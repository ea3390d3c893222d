// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>

#include "quadrille/continuous/solver.hpp"
#include "solve/cost_report.hpp"
#include "solve/inheritance.hpp"
#include "theory/model.hpp"

namespace quadrille::continuous {

/// How often searches exchange what they know, see Rounds.
struct Pace {
  /// Elementary steps between two exchanges, a tenth of a second.
  std::int64_t round = 2'000'000;
  /// Some parts of a search take longer than a round, and others would wait for them. Measured on
  /// eight hard rows, mean wall time: without lag 7 s, with 4 rounds 4.3 s, with 8 rounds 4.7 s,
  /// without any waiting 4.0 s; one thread 5.2 s.
  std::int64_t lag = 4;
};

/// Several searches as by search_alone, each in a thread of its own: the first one, in the calling
/// thread with `scene`, `limits` and `inheritance`, raises the bound; the second one makes the plan
/// cheaper, and then finds cores for the first one, as further ones do. They exchange bounds, plans
/// and cores. The first proof is the answer. `account`: that of `limits`. Requires options.threads
/// > 1.
///
/// Unless options.race, all pass through rounds of equal effort together, and of the proofs in the
/// earliest round that has one, that of the first search is taken: the same answer at any speed.
[[nodiscard]] SolveOutcome search_side_by_side(Scene& scene, const SolveOptions& options,
                                               const CostReport& known, LimitMonitor& limits,
                                               const std::shared_ptr<ResourceAccount>& account,
                                               const Pace& pace = {},
                                               const Inheritance& inheritance = {});

}  // namespace quadrille::continuous
