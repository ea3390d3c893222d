// SPDX-License-Identifier: MIT
#include "solve/tuning.hpp"

#include "model/open_maps.hpp"

namespace quadrille::discrete {
namespace {

/// Whether the search for the least cost may look for plans from above, too. The MDD model would
/// have to grow for plans far above the lower bound.
bool may_search_from_above(const SolveOptions& options) noexcept {
  return options.system == System::dpll && options.first_plan &&
         options.objective == Objective::sum_of_costs &&
         options.cost_search.value_or(CostSearch::core_guided) == CostSearch::core_guided;
}

}  // namespace

Features features_of(const Instance& instance) {
  return {is_open(instance.graph()), instance.num_agents(), instance.is_plain()};
}

/// Measured: on open maps the search from above closes most of the gap; elsewhere it takes time
/// from the cores.
Tuning choose_tuning(const Features& features, const SolveOptions& options) {
  Tuning tuning;
  Settings& settings = tuning.settings = options.settings;
  if (options.system != System::dpll) return tuning;
  const auto num_agents = static_cast<std::int64_t>(features.num_agents);
  tuning.chronological =
      options.lazy.chronological.value_or(num_agents >= settings.lazy_chronological_agents);
  tuning.bump_reasons = !features.is_open;
  tuning.explicit_paths = {settings.explicit_variables, settings.explicit_lemmas};
  if (features.is_open) {
    if (settings.explicit_variables > 0) tuning.explicit_paths = {1, settings.explicit_lemmas_open};
    settings.above_share = settings.above_share_open;
    settings.above_candidates_within = settings.above_candidates_within_open;
  }
  tuning.cores = {settings.above_share > 0 && features.is_plain && may_search_from_above(options),
                  settings.core_most_lift > 1};
  return tuning;
}

Tuner tuner_for(const Instance& instance) {
  return [features = features_of(instance)](const SolveOptions& options) {
    return choose_tuning(features, options);
  };
}

}  // namespace quadrille::discrete
