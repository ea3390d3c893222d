// SPDX-License-Identifier: MIT
#include "solve/tuning.hpp"

#include "model/open_maps.hpp"

namespace quadrille::discrete {
namespace {

/// Measured: from this number of agents on chronological backtracking is the better way.
constexpr std::size_t kManyAgents = 175;

/// Whether the search for the least cost also looks for plans from above. The MDD model would have
/// to grow for plans far above the lower bound.
bool searches_from_above(const SolveOptions& options) noexcept {
  return options.system == System::dpll && options.first_plan &&
         options.objective == Objective::sum_of_costs &&
         options.cost_search.value_or(CostSearch::core_guided) == CostSearch::core_guided;
}

}  // namespace

Features features_of(const Instance& instance) {
  return {is_open(instance.graph()), instance.num_agents() >= kManyAgents};
}

/// Measured: on open maps the search from above closes most of the gap; elsewhere it takes time
/// from the cores.
Tuning choose_tuning(const Features& features, const SolveOptions& options) {
  Tuning tuning;
  if (options.system != System::dpll) return tuning;
  tuning.chronological = options.lazy.chronological.value_or(features.has_many_agents);
  tuning.bump_reasons = !features.is_open;
  if (features.is_open) tuning.explicit_paths = {1, 16};
  sat::CoreGuidedOptions& cores = tuning.cores;
  cores.from_above = searches_from_above(options);
  cores.raise_cores = true;
  if (features.is_open) {
    cores.descent_share = 3;
    cores.candidates_within = 3;
  }
  return tuning;
}

Tuner tuner_for(const Instance& instance) {
  return [features = features_of(instance)](const SolveOptions& options) {
    return choose_tuning(features, options);
  };
}

}  // namespace quadrille::discrete
