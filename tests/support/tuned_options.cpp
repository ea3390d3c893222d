// SPDX-License-Identifier: MIT
#include "support/tuned_options.hpp"

#include <cstdint>

#include "solve/tuning.hpp"

namespace quadrille::discrete::support {

Result<SolveOutcome> solve(const Instance& instance, const TunedOptions& options) {
  return solve_tuned(instance, options, [&](const SolveOptions& of_one) {
    Features features = features_of(instance);
    Tuning tuning = choose_tuning(features, of_one);
    if (options.open) {
      features.is_open = *options.open;
      const Tuning other = choose_tuning(features, of_one);
      tuning.cores = other.cores;
      tuning.settings = other.settings;
    }
    if (options.first_explicit && of_one.system == System::dpll)
      tuning.explicit_paths = {INT32_MAX, 1, *options.first_explicit};
    Settings& settings = tuning.settings;
    settings.grid_round = options.round.value_or(settings.grid_round);
    settings.core_turn = options.first_turn.value_or(settings.core_turn);
    return tuning;
  });
}

}  // namespace quadrille::discrete::support
