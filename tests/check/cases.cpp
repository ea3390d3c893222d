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
  // Long ways round, so that cores raise the bound by more than one.
  if (random.percent(25)) return random_grid(random, {4, 8, 60, 3, 6});
  return random_grid(random, {2, 5, 40, 2, 5});
}

/// Half of them: dpll.
void draw_system(Random& random, SolveOptions& options) {
  using Kind = CheckSchedule::Kind;
  if (random.percent(50)) return;
  options.system = random.pick(
      std::vector{System::dpll_mdd, System::smt_cbs, System::mdd_sat, System::dpll_mdd});
  if (random.percent(50)) options.cost_search = CostSearch::core_guided;
  if (random.percent(30)) options.mdd.growth = MddGrowth::full;
  options.mdd.check.kind = random.pick(std::vector{Kind::watch, Kind::propagate, Kind::fractions});
  if (options.mdd.check.kind == Kind::fractions) options.mdd.check.fractions = {{1, 2}, {3, 4}};
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
  draw_system(random, drawn.options);
  if (random.percent(10)) drawn.options.threads = static_cast<std::size_t>(random.between(2, 5));
  return drawn;
}

Instance draw_crowded(std::uint64_t seed) {
  Random random(seed);
  const Instance drawn = random_graph(random, random.percent(50) ? 6 : 12, 1);
  const std::size_t size = drawn.graph().num_vertices();
  const std::size_t num_free = random.percent(40) ? 0 : random.below(size);
  return random_tasks(random, drawn.graph(), size - num_free);
}

}  // namespace quadrille::discrete::support
