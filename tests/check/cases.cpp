// SPDX-License-Identifier: MIT
#include "check/cases.hpp"

#include <vector>

#include "solve/tuning.hpp"
#include "support/generators.hpp"

namespace quadrille::discrete::support {

using quadrille::support::Random;

SolveOutcome solve_at(const Instance& instance, const SolveOptions& options, const Pace& pace) {
  const Tuner usual = tuner_for(instance);
  return solve_tuned(instance, options,
                     [&](const SolveOptions& of_one) {
                       Tuning tuning = usual(of_one);
                       if (pace.first_turn == 0) return tuning;
                       tuning.settings.core_turn = pace.first_turn;
                       tuning.settings.core_head_start = 1;
                       tuning.settings.above_candidates_within = pace.candidates_within;
                       return tuning;
                     })
      .value();
}

namespace {

Instance draw_instance(Random& random) {
  if (random.percent(25)) return random_graph(random, 9, 4);
  return random_grid(random, {2, 5, 40, 2, 5});
}

}  // namespace

Case draw(std::uint64_t seed) {
  Random random(seed);
  Case drawn{draw_instance(random), {}, {}};
  drawn.options.proof = true;
  drawn.options.seed = static_cast<std::uint32_t>(random.below(3));
  if (random.percent(25)) drawn.options.objective = Objective::makespan;
  if (random.percent(20)) drawn.options.cost_search = CostSearch::iterative;
  drawn.options.first_plan = random.percent(70);
  drawn.options.lazy.forbid_first = random.percent(20);
  if (random.percent(30)) drawn.options.lazy.chronological = random.percent(50);
  if (random.percent(60))
    drawn.pace = {static_cast<std::int64_t>(random.between(1, 60)),
                  static_cast<Cost>(random.pick(std::vector<int>{0, 3, 20}))};
  return drawn;
}

}  // namespace quadrille::discrete::support
