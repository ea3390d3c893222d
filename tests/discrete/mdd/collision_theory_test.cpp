// SPDX-License-Identifier: MIT
#include "mdd/collision_theory.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <set>
#include <vector>

#include "engine/theory_host.hpp"
#include "support/environment.hpp"
#include "support/mock_solver.hpp"

namespace quadrille::discrete {
namespace {

using sat::Lit;
using sat::Truth;
using VariableKind = MddModel::VariableKind;

/// A small random instance with its formula. The engine only makes literals here.
struct Fixture {
  explicit Fixture(std::uint64_t seed) : random(seed) {
    const auto draw = [&](std::uint64_t bound) { return random() % bound; };
    const auto width = static_cast<std::int32_t>(2 + draw(2));
    const auto height = static_cast<std::int32_t>(2 + draw(2));
    Graph graph = Graph::grid(width, height,
                              std::vector<bool>(static_cast<std::size_t>(width * height), true));
    std::vector<VertexId> starts, goals;
    for (const VertexId v : IdRange<VertexId>(graph.num_vertices())) {
      starts.push_back(v);
      goals.push_back(v);
    }
    for (std::size_t i = starts.size(); i > 1; --i) {
      std::swap(starts[i - 1], starts[draw(i)]);
      std::swap(goals[i - 1], goals[draw(i)]);
    }
    std::vector<Agent> tasks;
    const bool has_sets = draw(2) == 0;
    for (std::size_t i = 0; i < 2 + draw(2); ++i) {
      std::vector<VertexId> own{goals[i]};
      for (std::uint64_t more = has_sets ? draw(3) : 0; more > 0; --more)
        own.push_back(goals[draw(4)]);
      tasks.push_back({starts[i], Goals(std::move(own))});
    }
    // Two may have the same only goal, which instances refuse.
    if (!Instance::make(graph, tasks))
      for (std::size_t i = 0; i < tasks.size(); ++i) tasks[i].goals = goals[i];
    const auto objective = draw(2) == 0 ? Objective::sum_of_costs : Objective::makespan;
    model = std::make_unique<MddModel>(Instance::make(std::move(graph), tasks).value(), objective);
    engine = std::make_unique<sat::Engine>(nullptr);
    LimitMonitor limits{Limits{}};
    EXPECT_TRUE(model->attach(*engine, limits));
    Timestep longest = 0;
    for (const AgentId i : model->instance().agent_ids())
      longest = std::max(longest, model->mdd(i).distance());
    for (const AgentId i : model->instance().agent_ids()) {
      // For the makespan all agents' MDDs end together.
      const Timestep cap = objective == Objective::makespan ? longest + 1 - model->mdd(i).distance()
                                                            : static_cast<Timestep>(draw(3));
      EXPECT_TRUE(model->extend(i, cap, limits));
    }
    for (int v = 1; v < model->variable_end(); ++v)
      if (const auto kind = model->variable(Lit::from_dimacs(v)).kind;
          kind == VariableKind::vertex || kind == VariableKind::end)
        place_lits.push_back(Lit::from_dimacs(v));
  }

  std::mt19937_64 random;
  std::unique_ptr<MddModel> model;
  std::unique_ptr<sat::Engine> engine;
  std::vector<Lit> place_lits;  // Of being in a vertex, and of ending there.
};

/// Of clauses with "ends there": two agents do not both, where one that has no other goal does for
/// certain; and who ends there comes later than somebody else passes.
bool is_clause_of_ends(const MddModel& model, const std::vector<Lit>& clause) {
  std::optional<MddModel::Variable> end, other, late;
  for (const Lit lit : clause) {
    const auto use = model.variable(lit);
    if (lit.positive() != (use.kind == VariableKind::delay)) return false;
    if (use.kind == VariableKind::delay)
      late = use;
    else if (use.kind == VariableKind::end && !end)
      end = use;
    else
      other = use;
  }
  if (!end || clause.size() > 3) return false;
  if (clause.size() == 1)
    for (const AgentId i : model.instance().agent_ids())
      if (i != end->agent && model.mdd(i).task().goals == Goals(end->vertex)) return true;
  if (!other || other->agent == end->agent || other->vertex != end->vertex) return false;
  if (clause.size() == 2) return other->kind == VariableKind::end;
  return other->kind == VariableKind::vertex && late && late->agent == end->agent &&
         model.mdd(late->agent).distance() + late->number == other->number + 1;
}

/// True if `clause` forbids something that two agents may not do together: derived from the meaning
/// of its literals alone.
bool is_collision_clause(const MddModel& model, const std::vector<Lit>& clause) {
  std::vector<MddModel::Variable> uses;
  for (const Lit lit : clause) uses.push_back(model.variable(lit));
  if (std::any_of(uses.begin(), uses.end(),
                  [](const auto& use) { return use.kind == VariableKind::end; }))
    return is_clause_of_ends(model, clause);
  if (clause.size() == 2 && clause[0].positive() == clause[1].positive())  // vertex
    return !clause[0].positive() && uses[0].kind == VariableKind::vertex &&
           uses[1].kind == VariableKind::vertex && uses[0].agent != uses[1].agent &&
           uses[0].vertex == uses[1].vertex && uses[0].number == uses[1].number;
  if (clause.size() == 2) {  // rest
    const auto& use = clause[0].positive() ? uses[1] : uses[0];
    const auto& late = clause[0].positive() ? uses[0] : uses[1];
    return use.kind == VariableKind::vertex && late.kind == VariableKind::delay &&
           use.agent != late.agent && model.mdd(late.agent).task().goals == Goals(use.vertex) &&
           model.mdd(late.agent).distance() + late.number == use.number + 1;
  }
  if (clause.size() != 4) return false;  // swap: u@t, v@t+1 of one, v@t, u@t+1 of the other
  std::set<std::uint32_t> agents;
  for (std::size_t i = 0; i < 4; ++i) {
    if (clause[i].positive() || uses[i].kind != VariableKind::vertex) return false;
    agents.insert(uses[i].agent.value());
  }
  std::sort(uses.begin(), uses.end(), [](const auto& a, const auto& b) {
    return std::pair(a.agent, a.number) < std::pair(b.agent, b.number);
  });
  return agents.size() == 2 && uses[0].agent == uses[1].agent &&
         uses[0].number + 1 == uses[1].number && uses[2].number == uses[0].number &&
         uses[3].number == uses[1].number && uses[0].vertex == uses[3].vertex &&
         uses[1].vertex == uses[2].vertex && uses[0].vertex != uses[1].vertex;
}

/// True if two of the announced literals, or two pairs of them, collide: recomputed from nothing.
bool has_collision(const MddModel& model, const std::set<Lit>& lits) {
  std::vector<MddModel::Variable> uses;
  for (const Lit lit : lits)
    if (lit.positive() && model.variable(lit).kind == VariableKind::vertex)
      uses.push_back(model.variable(lit));
  const auto is_at = [&](AgentId agent, VertexId v, Timestep t) {
    const Lit lit = model.at(agent, v, t);
    return lit.valid() && lits.contains(lit);
  };
  const auto ends_at = [&](AgentId agent, VertexId v) {
    if (!model.mdd(agent).is_goal(v)) return false;
    const Lit lit = model.end_at(agent, v);
    return !lit.valid() || lits.contains(lit);
  };
  for (const VertexId v : IdRange<VertexId>(model.instance().graph().num_vertices())) {
    int there = 0;
    for (const AgentId i : model.instance().agent_ids()) there += ends_at(i, v) ? 1 : 0;
    if (there > 1) return true;
  }
  for (const auto& a : uses) {
    for (const AgentId resident : model.instance().agent_ids()) {
      if (resident == a.agent || !ends_at(resident, a.vertex)) continue;
      const Lit late = model.arrival_after(resident, a.number);
      if (late.valid() && lits.contains(~late)) return true;
    }
    for (const auto& b : uses) {
      if (a.agent == b.agent || a.number != b.number) continue;
      if (a.vertex == b.vertex) return true;
      if (model.instance().graph().adjacent(a.vertex, b.vertex) &&
          is_at(a.agent, b.vertex, a.number + 1) && is_at(b.agent, a.vertex, a.number + 1))
        return true;
    }
  }
  return false;
}

CheckSchedule random_schedule(std::mt19937_64& random) {
  CheckSchedule schedule;
  switch (random() % 3) {
    case 0:
      break;
    case 1:
      schedule.kind = CheckSchedule::Kind::propagate;
      break;
    default:
      schedule.kind = CheckSchedule::Kind::fractions;
      schedule.fractions = {{1, 10}, {1, 2}};
  }
  return schedule;
}

// Random partial assignments, which need not be anything like paths.
TEST(CollisionTheory, FindsWhatARecomputationFindsUnderAnyCallbacks) {
  const std::size_t num_fixtures = support::scaled(300), per_fixture = 50;
  std::size_t silent = 0, clauses = 0, reasons = 0;
  for (std::size_t f = 0; f < num_fixtures; ++f) {
    Fixture fixture(f);
    const MddModel& model = *fixture.model;
    for (std::size_t s = 0; s < per_fixture; ++s) {
      SCOPED_TRACE(testing::Message() << "fixture " << f << " sequence " << s);
      const CheckSchedule schedule = random_schedule(fixture.random);
      CollisionTheory theory(model, schedule);
      theory.on_extended();
      sat::TheoryHost host(theory, {[] { return Lit(); }, [](const sat::Lemma&) {}});
      for (int v = 1; v < model.variable_end(); ++v) host.add_variable(v);
      support::MockSolver solver(host, model.variable_end() - 1, f * per_fixture + s);
      for (int step = 0; step < 30 && !solver.dead(); ++step) {
        switch (solver.draw(10)) {
          case 0:
            solver.open_level();
            break;
          case 1:
            solver.backtrack(solver.draw(solver.level() + 1));
            break;
          case 2:
            solver.backtrack_unannounced_levels();
            break;
          case 3:
            solver.ask_late_reason();
            break;
          case 4:
            solver.assign(Lit::from_dimacs(-static_cast<int>(solver.draw(static_cast<std::uint64_t>(
                                               model.variable_end() - 1))) -
                                           1));
            break;
          default: {
            // Few cells, so that agents meet.
            const Lit x = fixture.place_lits[solver.draw(fixture.place_lits.size())];
            solver.assign(x);
            bool forgettable = false;
            if (!solver.propagate() || solver.dead() || host.has_clause(forgettable)) break;
            if (schedule.kind == CheckSchedule::Kind::fractions) break;
            ++silent;
            ASSERT_FALSE(has_collision(model, solver.announced()));
          }
        }
      }
      ASSERT_FALSE(solver.has_bad_reason());
      for (const auto& clause : solver.clauses()) ASSERT_TRUE(is_collision_clause(model, clause));
      for (const auto& [implied, reason] : solver.reasons()) {
        ASSERT_TRUE(is_collision_clause(model, reason));
        ASSERT_TRUE(std::find(reason.begin(), reason.end(), implied) != reason.end());
      }
      clauses += solver.clauses().size();
      reasons += solver.reasons().size();
    }
  }
  EXPECT_GT(silent, num_fixtures);
  EXPECT_GT(clauses, num_fixtures);
  EXPECT_GT(reasons, num_fixtures / 4);
}

/// A random path of the agent within its cap.
Path random_path(const MddModel& model, AgentId agent, std::mt19937_64& random) {
  const Mdd& mdd = model.mdd(agent);
  Path path{mdd.task().start};
  for (Timestep t = 1; t <= mdd.distance() + model.cap(agent); ++t) {
    std::vector<VertexId> next;
    if (model.at(agent, path.back(), t).valid()) next.push_back(path.back());
    for (const VertexId w : model.instance().graph().neighbours(path.back()))
      if (model.at(agent, w, t).valid()) next.push_back(w);
    path.push_back(next[random() % next.size()]);
  }
  return path;
}

// Complete assignments made of random paths: accepted exactly if no two paths collide.
TEST(CollisionTheory, AcceptsAModelExactlyIfItsPathsDoNotCollide) {
  const std::size_t num_fixtures = support::scaled(250), per_fixture = 20;
  std::size_t accepted = 0, rejected = 0;
  for (std::size_t f = 0; f < num_fixtures; ++f) {
    Fixture fixture(1000 + f);
    const MddModel& model = *fixture.model;
    for (std::size_t s = 0; s < per_fixture; ++s) {
      SCOPED_TRACE(testing::Message() << "fixture " << f << " sequence " << s);
      CheckSchedule schedule;
      schedule.kind = CheckSchedule::Kind::fractions;  // complete assignments only
      CollisionTheory theory(model, schedule);
      theory.on_extended();
      sat::TheoryHost host(theory, {[] { return Lit(); }, [](const sat::Lemma&) {}});
      for (int v = 1; v < model.variable_end(); ++v) host.add_variable(v);
      support::MockSolver solver(host, model.variable_end() - 1, s);
      Plan plan;
      for (const AgentId i : model.instance().agent_ids())
        plan.paths.push_back(random_path(model, i, fixture.random));
      for (int v = 1; v < model.variable_end(); ++v) {
        const Lit x = Lit::from_dimacs(v);
        const auto use = model.variable(x);
        bool is_true = false;
        if (use.kind == VariableKind::vertex)
          is_true = position(plan.paths[use.agent], use.number) == use.vertex;
        else if (use.kind == VariableKind::delay)
          is_true = arrival(plan.paths[use.agent]) >= model.mdd(use.agent).distance() + use.number;
        else if (use.kind == VariableKind::end)
          is_true = plan.paths[use.agent].back() == use.vertex;
        if (solver.draw(8) == 0) solver.open_level();
        solver.assign(is_true ? x : ~x);
        if (solver.draw(16) == 0) solver.backtrack_unannounced_levels();
      }
      bool collides = false;
      const auto end = static_cast<Timestep>(12);
      for (Timestep t = 0; t < end; ++t)
        for (const AgentId i : model.instance().agent_ids())
          for (const AgentId j : model.instance().agent_ids()) {
            if (i == j) continue;
            const auto at = [&](AgentId k, Timestep when) { return position(plan.paths[k], when); };
            collides = collides || at(i, t) == at(j, t) ||
                       (at(i, t) == at(j, t + 1) && at(i, t + 1) == at(j, t));
          }
      ASSERT_EQ(solver.check_found_model(), !collides);
      ++(collides ? rejected : accepted);
      solver.fetch_clauses();
      for (const auto& clause : solver.clauses()) {
        ASSERT_TRUE(is_collision_clause(model, clause));
        for (const Lit lit : clause) ASSERT_TRUE(solver.is_true(~lit));
      }
    }
  }
  EXPECT_GT(accepted, num_fixtures);
  EXPECT_GT(rejected, num_fixtures);
}

}  // namespace
}  // namespace quadrille::discrete
