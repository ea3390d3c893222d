// SPDX-License-Identifier: MIT
#include "support/tuned_options.hpp"

#include "solve/tuning.hpp"

namespace quadrille::discrete::support {

Result<SolveOutcome> solve(const Instance& instance, const TunedOptions& options) {
  return solve_tuned(instance, options, [&](const SolveOptions& of_one) {
    Features features = features_of(instance);
    Tuning tuning = choose_tuning(features, of_one);
    if (options.open) {
      features.is_open = *options.open;
      tuning.cores = choose_tuning(features, of_one).cores;
    }
    tuning.round = options.round.value_or(tuning.round);
    tuning.cores.first_turn = options.first_turn.value_or(tuning.cores.first_turn);
    return tuning;
  });
}

}  // namespace quadrille::discrete::support
