// SPDX-License-Identifier: MIT
// The lazy path theory under every callback sequence that the protocol allows. At each callback,
// what the theory says is compared with what follows from the stack of literals alone.
#include "lazy/lazy_theory.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <vector>

#include "discrete/lazy/watched_theory.hpp"
#include "lazy/lazy_auditor.hpp"
#include "support/distances.hpp"
#include "support/environment.hpp"
#include "support/generators.hpp"
#include "support/joint_search.hpp"
#include "support/mock_solver.hpp"
#include "support/patience.hpp"

namespace quadrille::discrete {
namespace {

using sat::Lit;
using support::Count;
using support::Random;
using support::WatchedTheory;
using VariableKind = LazyModel::VariableKind;

// ---- the solver's side --------------------------------------------------------------------------

/// An instance all of whose goals can be reached. Small: the audit of one lemma is a joint search.
Instance random_instance(Random& random) {
  while (true) {
    const Instance instance = random.percent(65) ? support::random_grid(random, {2, 4, 25, 2, 5})
                                                 : support::random_graph(random, 9, 4);
    const bool all_reach =
        std::all_of(instance.tasks().begin(), instance.tasks().end(), [&](const Task& task) {
          return distances_from(instance.graph(), task.start)[task.goal] != kUnreachable;
        });
    if (all_reach && instance.num_agents() > 1) return instance;
  }
}

/// Clauses and literals outlive a sequence, and so does the theory: as from solve to solve.
class Session final : private FormulaWriter {
 public:
  Session(Random& random, Count& count)
      : random_(random), instance_(random_instance(random)), count_(count) {
    model_ = std::make_unique<LazyModel>(instance_, support::distances_of(instance_));
    theory_ = std::make_unique<WatchedTheory>(*model_, count);
    const auto answer = support::joint_search(instance_, Objective::makespan);
    const bool is_feasible = answer.status == Status::optimal;
    auditor_ = std::make_unique<LazyAuditor>(
        *model_, true, is_feasible ? std::optional(answer.plan) : std::nullopt);
  }

  void run_sequence(std::uint64_t seed) {
    host_ = std::make_unique<sat::TheoryHost>(
        *theory_,
        sat::TheoryHost::Hooks{[this] { return new_lit(); },
                               [this](const sat::Lemma& lemma) { auditor_->on_lemma(lemma); }});
    for (int v = 1; v < end_; ++v) host_->add_variable(v);
    solver_ = std::make_unique<quadrille::support::MockSolver>(*host_, end_ - 1, seed);
    for (auto& clause : clauses_) solver_->add_clause(std::move(clause));
    begin_solve();
    for (std::size_t step = 0; step < 40 && goes_on(); ++step) make_move();
    for (int tries = 0; tries < 4 && goes_on() && !check_model(); ++tries) {
    }
    EXPECT_EQ(auditor_->complaint().value_or(""), "");
    EXPECT_TRUE(solver_->reasons().empty());
    count_.dead += solver_->dead() ? 1 : 0;
    clauses_ = solver_->clauses();
    for (const auto& rest : host_->take_queue()) clauses_.push_back(rest.clause);
    theory_->forget();
  }
  /// Whether an agent has got explicit paths.
  [[nodiscard]] bool has_explicit_paths() { return draw_literal(VariableKind::vertex).has_value(); }

 private:
  [[nodiscard]] Lit new_lit() override {
    host_->add_variable(end_);
    return Lit::from_dimacs(end_++);
  }
  void add(const sat::Lemma& lemma) override {
    auditor_->on_lemma(lemma);
    solver_->add_clause({lemma.clause.begin(), lemma.clause.end()});
  }
  [[nodiscard]] bool goes_on() const { return !solver_->dead() && !testing::Test::HasFailure(); }

  /// Between solves: cost literals are made, then assumed.
  void begin_solve() {
    solver_->backtrack(0);
    host_->begin_solve();
    const bool all_present = random_.percent(50);
    theory_->on_solve(all_present);
    for (const AgentId i : instance_.agents()) {
      const auto delay = static_cast<Timestep>(random_.below(5));
      const Lit above = model_->cost_above(i, model_->distances(i).free_cost() + delay, *this);
      if (!all_present && random_.percent(40)) continue;
      solver_->open_level();
      solver_->assign(~above);
    }
  }
  /// A literal at random; `usage` and `cost` are those that do something.
  [[nodiscard]] std::optional<Lit> draw_literal(VariableKind kind) {
    std::vector<Lit> fitting;
    for (int v = 1; v < end_; ++v)
      if (model_->variable(Lit::from_dimacs(v)).kind == kind)
        fitting.push_back(Lit::from_dimacs(v));
    if (fitting.empty()) return std::nullopt;
    return random_.pick(fitting);
  }
  /// True if the theory agrees with a complete assignment.
  bool check_model() {
    for (int tries = 0; tries < 8 && goes_on(); ++tries) {
      if (random_.percent(80) && !solver_->propagate()) continue;
      if (!solver_->complete(end_)) continue;
      if (random_.percent(80) && !solver_->propagate()) continue;
      if (solver_->num_assigned() + 1 != static_cast<std::size_t>(end_)) continue;  // new literals
      if (solver_->check_found_model()) return true;
      solver_->fetch_clauses();
      solver_->resolve_conflicts();
    }
    return false;
  }
  void decide() {
    bool forgettable = false;
    if (!solver_->propagate() || solver_->dead() || host_->has_clause(forgettable)) return;
    // Without an answer, the solver may decide for a literal that it does not announce.
    while (!solver_->decide().valid() && random_.percent(50)) {
    }
    if (host_->wants_stop()) begin_solve();
  }
  void make_move() {
    switch (random_.below(16)) {
      case 0:
        solver_->open_level();
        break;
      case 1:
      case 2:
        solver_->backtrack(random_.below(solver_->level() + 1));
        break;
      case 3:
        solver_->backtrack_unannounced_levels();
        break;
      case 4:
        solver_->ask_late_reason();
        break;
      case 5:
        solver_->assign(Lit::from_dimacs(
            -1 - static_cast<int>(random_.below(static_cast<std::size_t>(end_ - 1)))));
        break;
      case 6:
        if (const auto cost = draw_literal(VariableKind::cost)) solver_->assign(*cost);
        break;
      case 7:
        begin_solve();
        break;
      case 8:
      case 9:
        decide();
        break;
      case 10:
        static_cast<void>(check_model());
        break;
      case 11:
        solver_->announce();  // and do not ask
        break;
      default:
        if (random_.percent(50)) solver_->open_level();
        if (const auto usage = draw_literal(VariableKind::usage)) solver_->assign(*usage);
        if (random_.percent(70)) static_cast<void>(solver_->propagate());
    }
  }

  Random& random_;
  const Instance instance_;
  Count& count_;
  std::unique_ptr<LazyModel> model_;
  std::unique_ptr<WatchedTheory> theory_;
  std::unique_ptr<LazyAuditor> auditor_;
  std::unique_ptr<sat::TheoryHost> host_;
  std::unique_ptr<quadrille::support::MockSolver> solver_;
  std::vector<std::vector<Lit>> clauses_;
  int end_ = 1;  // of the variables
};

class LazyTheoryCallbacks : public testing::TestWithParam<int> {};

TEST_P(LazyTheoryCallbacks, AgreeWithARecomputation) {
  const std::size_t num_sessions = quadrille::support::scaled(50);
  std::size_t sequences = 0, num_explicit = 0;
  Count count;
  for (std::size_t s = 0; s < num_sessions && !HasFailure(); ++s) {
    const std::uint64_t seed = static_cast<std::uint64_t>(GetParam()) * 1'000'000 + s;
    const quadrille::support::AbortNote note("session " + std::to_string(seed) + "\n");
    const quadrille::support::Patience patience(20);
    Random random(seed);
    Session session(random, count);
    // Some go on until agents get explicit paths.
    const std::size_t length = s % 10 == 0 ? 500 : 60;
    for (std::size_t n = 0; n < length && !HasFailure(); ++n, ++sequences) {
      SCOPED_TRACE(testing::Message() << "session " << seed << " sequence " << n);
      session.run_sequence(n);
    }
    num_explicit += session.has_explicit_paths() ? 1 : 0;
  }
  if (HasFailure() || num_sessions < 50) return;  // too few to count on chance
  EXPECT_GT(count.silent, sequences);
  EXPECT_GT(count.conflicts, sequences / 20);
  EXPECT_GT(count.accepted, sequences / 4);
  EXPECT_GT(count.rejected, sequences / 20);
  EXPECT_GT(count.decisions, sequences / 50);
  EXPECT_GT(count.stops, sequences / 4);
  EXPECT_GT(count.told, sequences / 20);
  EXPECT_LT(count.dead, sequences / 2);
  EXPECT_GT(num_explicit, 0u);
}

INSTANTIATE_TEST_SUITE_P(Shard, LazyTheoryCallbacks, testing::Range(0, 4));

}  // namespace
}  // namespace quadrille::discrete
