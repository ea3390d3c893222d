// SPDX-License-Identifier: MIT
// The clauses of one agent, with one goal and with several, under random assumptions: no path that
// fits is excluded, and what a model contains is a path that costs no more than it says.
#include "mdd/mdd_model.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <optional>
#include <vector>

#include "support/environment.hpp"
#include "support/generators.hpp"

namespace quadrille::discrete {
namespace {

using sat::Lit;
using support::Random;
using VariableKind = MddModel::VariableKind;

const AgentId kAgent(0);

/// Whether what the literal says holds for the path.
bool holds(const MddModel& model, Lit lit, const Path& path) {
  const auto use = model.variable(lit);
  bool value = false;
  if (use.kind == VariableKind::vertex) value = position(path, use.number) == use.vertex;
  if (use.kind == VariableKind::end) value = path.back() == use.vertex;
  if (use.kind == VariableKind::delay)
    value = arrival(path) >= model.mdd(kAgent).distance() + use.number;
  return value == lit.positive();
}

/// Whether a path that ends at a goal by the last timestep of the diagram fits all literals.
bool some_path_fits(const MddModel& model, const std::vector<Lit>& lits) {
  const Mdd& mdd = model.mdd(kAgent);
  const auto last = static_cast<std::size_t>(mdd.distance() + model.cap(kAgent));
  Path path{mdd.task().start};
  const std::function<bool()> go_on = [&] {
    if (path.size() > last) {
      if (!mdd.is_goal(path.back())) return false;
      for (const Lit lit : lits)
        if (!holds(model, lit, path)) return false;
      return true;
    }
    const VertexId from = path.back();
    std::vector<VertexId> next{from};
    for (const VertexId w : model.instance().graph().neighbours(from)) next.push_back(w);
    for (const VertexId w : next) {
      path.push_back(w);
      if (go_on()) return true;
      path.pop_back();
    }
    return false;
  };
  return go_on();
}

/// Places at goals more often than others: there an agent may rest, or pass.
std::vector<Lit> draw_assumptions(Random& random, MddModel& model, const std::vector<Lit>& places) {
  const Timestep cap = model.cap(kAgent);
  std::vector<Lit> lits{~model.delay_at_least(kAgent, cap + 1)};
  if (model.objective() == Objective::sum_of_costs && random.percent(70)) {
    const auto most = static_cast<Timestep>(random.below(static_cast<std::size_t>(cap) + 1));
    lits.push_back(~model.delay_at_least(kAgent, most + 1));
  }
  for (std::size_t k = random.below(6); k > 0; --k) {
    Lit lit = random.pick(places);
    for (int draws = 0; draws < 3 && !model.mdd(kAgent).is_goal(model.variable(lit).vertex);
         ++draws)
      lit = random.pick(places);
    lits.push_back(random.percent(50) ? lit : ~lit);
  }
  return lits;
}

/// What is wrong with the path of a model; empty: nothing.
std::string find_fault(const MddModel& model, const sat::Engine& engine, const Path& path) {
  const Mdd& mdd = model.mdd(kAgent);
  const auto is_true = [&](Lit lit) { return engine.model_value(lit); };
  if (path.front() != mdd.task().start || !mdd.is_goal(path.back())) return "start or end";
  for (std::size_t t = 1; t < path.size(); ++t)
    if (path[t - 1] != path[t] && !model.instance().graph().adjacent(path[t - 1], path[t]))
      return "no such move";
  for (Timestep t = 0; t <= mdd.distance() + model.cap(kAgent); ++t)
    if (!is_true(model.at(kAgent, position(path, t), t))) return "a place that is false";
  if (const Lit end = model.end_at(kAgent, path.back()); end.valid() && !is_true(end))
    return "it ends where it does not";
  if (model.objective() == Objective::sum_of_costs)
    for (Timestep late = 1; late <= arrival(path) - mdd.distance(); ++late)
      if (!is_true(model.find_delay(kAgent, late))) return "it is later than it says";
  return "";
}

TEST(MddModel, PathsFitAndModelsContainPaths) {
  int sat = 0, unsat = 0, with_sets = 0;
  for (std::uint64_t seed = 0; seed < quadrille::support::scaled(1500); ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Instance drawn = support::with_more_goals(
        random, random.percent(50) ? support::random_graph(random, 6, 2)
                                   : support::random_grid(random, {1, 3, 30, 1, 2}));
    const Agent task = *drawn.agents().begin();
    if (distances_to_nearest(drawn.graph(), task.goals)[task.start] == kUnreachable) continue;
    const Instance instance = drawn.with_agents({task}).value();
    const auto objective = random.percent(70) ? Objective::sum_of_costs : Objective::makespan;
    MddModel model(instance, objective);
    sat::Engine engine(nullptr, {.initial_phase = random.percent(50)});
    LimitMonitor limits{Limits{}};
    ASSERT_TRUE(model.attach(engine, limits));
    with_sets += task.goals.is_single() ? 0 : 1;
    // Grown in one or more steps, and asked in between.
    for (Timestep cap = static_cast<Timestep>(random.below(2)); cap <= 4;
         cap += static_cast<Timestep>(random.between(1, 3))) {
      if (model.mdd(kAgent).distance() + cap > 6) break;
      ASSERT_TRUE(model.extend(kAgent, cap, limits));
      std::vector<Lit> places;
      for (int v = 1; v < model.variable_end(); ++v)
        if (const auto kind = model.variable(Lit::from_dimacs(v)).kind;
            kind == VariableKind::vertex || kind == VariableKind::end)
          places.push_back(Lit::from_dimacs(v));
      for (int query = 0; query < 6; ++query) {
        const std::vector<Lit> lits = draw_assumptions(random, model, places);
        const bool is_sat = engine.solve(lits, limits) == sat::Verdict::sat;
        if (is_sat)
          ASSERT_EQ(
              find_fault(model, engine,
                         model.extract_path(kAgent, [&](Lit l) { return engine.model_value(l); })),
              "");
        else
          ASSERT_FALSE(some_path_fits(model, lits));
        ++(is_sat ? sat : unsat);
      }
    }
  }
  EXPECT_GT(sat, 0);
  EXPECT_GT(unsat, 0);
  EXPECT_GT(with_sets, 0);
}

}  // namespace
}  // namespace quadrille::discrete
