// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>

#include "lazy/explicit_paths.hpp"
#include "quadrille/core/result.hpp"
#include "quadrille/discrete/solver.hpp"
#include "quadrille/sat/cost_search.hpp"

namespace quadrille::discrete {

/// What the settings of a search depend on.
struct Features {
  bool is_open = false;  ///< See model/open_maps.hpp.
  std::size_t num_agents = 0;
  bool is_plain = true;  ///< Searches from above know no rules.
};
[[nodiscard]] Features features_of(const Instance& instance);

/// What one search is set to: what depends on the instance is chosen.
struct Tuning {
  bool chronological = true;
  bool bump_reasons = true;  ///< Of CaDiCaL.
  ExplicitPaths::Price explicit_paths;
  sat::CoreGuidedOptions cores;
  Settings settings;
};
[[nodiscard]] Tuning choose_tuning(const Features& features, const SolveOptions& options);

/// Chooses the settings of one search; those of a portfolio have options of their own.
using Tuner = std::function<Tuning(const SolveOptions& options)>;
[[nodiscard]] Tuner tuner_for(const Instance& instance);

/// As `solve`, with settings that are chosen by `tuner`, in their ranges.
[[nodiscard]] Result<SolveOutcome> solve_tuned(const Instance& instance,
                                               const SolveOptions& options, const Tuner& tuner);

}  // namespace quadrille::discrete
