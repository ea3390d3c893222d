// SPDX-License-Identifier: MIT
// The theory of the lazy path model under any callbacks that a solver may make.
#include "lazy/lazy_theory.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <set>
#include <vector>

#include "lazy/lazy_auditor.hpp"
#include "quadrille/discrete/verify.hpp"
#include "support/distances.hpp"
#include "support/environment.hpp"
#include "support/mock_solver.hpp"
#include "theory_host.hpp"

namespace quadrille::discrete {
namespace {

using sat::Lit;

Instance random_instance(std::mt19937_64& random) {
  const auto draw = [&](std::uint64_t bound) { return random() % bound; };
  const auto width = static_cast<std::int32_t>(2 + draw(2));
  const auto height = static_cast<std::int32_t>(2 + draw(2));
  Graph graph =
      Graph::grid(width, height, std::vector<bool>(static_cast<std::size_t>(width * height), true));
  std::vector<std::size_t> starts(graph.num_vertices()), goals;
  for (std::size_t v = 0; v < starts.size(); ++v) starts[v] = v;
  goals = starts;
  for (std::size_t i = starts.size(); i > 1; --i) {
    std::swap(starts[i - 1], starts[draw(i)]);
    std::swap(goals[i - 1], goals[draw(i)]);
  }
  std::vector<Task> tasks;
  const std::size_t num_agents = 2 + draw(3);
  for (std::size_t i = 0; i < num_agents; ++i)
    tasks.push_back({VertexId(starts[i]), VertexId(goals[i])});
  return Instance::make(std::move(graph), tasks).value();
}

/// A theory, its host, and a mock solver that knows the bounds of all agents from the beginning.
class Play final : private FormulaWriter {
 public:
  explicit Play(std::uint64_t seed)
      : random_(seed),
        instance_(random_instance(random_)),
        limits_(Limits{}),
        model(instance_, support::distances_of(instance_)),
        theory(model, limits_),
        auditor(model, true, std::nullopt),
        host(theory, {[this] { return new_lit(); },
                      [this](const sat::Lemma& lemma) { auditor.on_lemma(lemma); }}),
        solver(host, 0, seed) {
    for (const AgentId i : instance_.agents())
      for (Timestep k = 0; k < 4; ++k)
        static_cast<void>(model.cost_above(i, model.distances(i).free_cost() + k, *this));
  }

  /// One move of the solver.
  void step() {
    switch (solver.draw(8)) {
      case 0:
        return solver.open_level();
      case 1:
        return solver.backtrack(solver.draw(solver.level() + 1));
      case 2:
        return solver.backtrack_unannounced_levels();
      case 3:
      case 4:
        return assign_all();
      default:
        assign(1 + static_cast<int>(solver.draw(num_variables_)));
        if (solver.draw(2) == 0) static_cast<void>(solver.propagate());
    }
  }

  /// Usages are mostly allowed; costs are bounded as often as not.
  void assign(int variable) {
    if (solver.level() == 0 || solver.draw(4) == 0) solver.open_level();
    const Lit lit = Lit::from_dimacs(variable);
    const bool is_cost = model.variable(lit).kind == LazyModel::VariableKind::cost;
    solver.assign(solver.draw(is_cost ? 2 : 6) == 0 ? lit : ~lit);
  }

  /// Assigns what is missing and shows the theory the complete assignment, if no clause is false.
  void assign_all() {
    for (int v = 1; v <= static_cast<int>(num_variables_); ++v) assign(v);
    const std::uint64_t before = num_variables_;
    bool forgettable = false;
    if (!solver.propagate() || solver.dead() || host.has_clause(forgettable)) return;
    if (num_variables_ != before) return;
    const bool accepted = solver.check_found_model();
    if (accepted) {
      ++num_accepted;
      check_accepted();
    } else {
      ++num_rejected;
      EXPECT_TRUE(host.has_clause(forgettable) || num_variables_ > before);
      static_cast<void>(solver.propagate());
    }
  }

  std::size_t num_accepted = 0, num_rejected = 0, num_plans = 0;

 private:
  [[nodiscard]] Lit new_lit() override {
    host.add_variable(static_cast<int>(++num_variables_));
    return Lit::from_dimacs(static_cast<int>(num_variables_));
  }
  void add(const sat::Lemma& lemma) override {
    solver.add_clause({lemma.clause.begin(), lemma.clause.end()});
  }

  /// What the literals say about each agent, from nothing, against the paths.
  void check_accepted() {
    bool all_present = true;
    for (const AgentId i : instance_.agents()) {
      bool present = false;
      for (const auto& c : model.cost_literals(i)) present = present || solver.is_true(~c.above);
      all_present = all_present && present;
    }
    ASSERT_EQ(theory.accepted().has_value(), all_present);
    if (!all_present) return;
    ++num_plans;
    const Plan& plan = *theory.accepted();
    EXPECT_TRUE(verify(instance_, plan).valid());
    for (const AgentId i : instance_.agents())
      for (const auto& c : model.cost_literals(i))
        EXPECT_TRUE(!solver.is_true(~c.above) || arrival(plan.paths[i]) <= c.cost);
    for (std::size_t o = 0; o < model.obstacles().size(); ++o) {
      const Obstacle& obstacle = model.obstacles()[ObstacleId(o)];
      EXPECT_FALSE(solver.is_true(~obstacle.allowed) &&
                   model.obstacles().hits(ObstacleId(o), plan.paths[obstacle.agent]));
    }
  }

  std::mt19937_64 random_;
  Instance instance_;
  LimitMonitor limits_;
  std::uint64_t num_variables_ = 0;

 public:
  LazyModel model;
  LazyTheory theory;
  LazyAuditor auditor;
  sat::TheoryHost host;
  quadrille::support::MockSolver solver;
};

TEST(LazyTheory, AcceptsPlansOnlyAndMakesTrueLemmasUnderAnyCallbacks) {
  std::size_t rejected = 0, plans = 0;
  const std::size_t sequences = quadrille::support::scaled(10'000);
  for (std::uint64_t seed = 0; seed < sequences; ++seed) {
    SCOPED_TRACE(seed);
    const quadrille::support::AbortNote note("# lazy theory, sequence " + std::to_string(seed) + "\n");
    Play play(seed);
    for (int step = 0; step < 150 && !play.solver.dead() && !HasFailure(); ++step) play.step();
    ASSERT_EQ(play.auditor.complaint(), std::nullopt);
    ASSERT_FALSE(HasFailure());
    rejected += play.num_rejected;
    plans += play.num_plans;
  }
  EXPECT_GT(rejected, sequences / 20);
  EXPECT_GT(plans, sequences / 4);
}

}  // namespace
}  // namespace quadrille::discrete
