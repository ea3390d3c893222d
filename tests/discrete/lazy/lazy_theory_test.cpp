// SPDX-License-Identifier: MIT
// The lazy path theory under every callback sequence that the protocol allows. At each callback,
// what the theory says is compared with what follows from the stack of literals alone.
#include "lazy/lazy_theory.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <vector>

#include "discrete/lazy/situation.hpp"
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
using sat::Truth;
using support::Random;
using support::Situation;
using VariableKind = LazyModel::VariableKind;

// ---- the theory, watched ------------------------------------------------------------------------

/// Passes everything on, and remembers what the theory said.
class Recorder final : public sat::TheoryContext {
 public:
  explicit Recorder(sat::TheoryContext& context) : context_(context) {}

  std::vector<std::vector<Lit>> lemmas;
  bool made_literal = false, stopped = false;

  [[nodiscard]] bool has_conflict(const Situation& now) const {
    return std::any_of(lemmas.begin(), lemmas.end(),
                       [&](const auto& clause) { return now.is_false(clause); });
  }

  [[nodiscard]] Truth value(Lit lit) const override { return context_.value(lit); }
  [[nodiscard]] std::size_t level(Lit lit) const override { return context_.level(lit); }
  [[nodiscard]] std::size_t num_assigned() const override { return context_.num_assigned(); }
  [[nodiscard]] std::size_t num_variables() const override { return context_.num_variables(); }
  void add_lemma(const sat::Lemma& lemma) override {
    lemmas.emplace_back(lemma.clause.begin(), lemma.clause.end());
    if (!is_trial) context_.add_lemma(lemma);
  }
  void propagate(Lit implied) override { context_.propagate(implied); }
  [[nodiscard]] Lit new_lit() override {
    made_literal = true;
    EXPECT_FALSE(is_trial) << "a literal for something that is known already";
    return context_.new_lit();
  }
  void stop() override {
    stopped = true;
    context_.stop();
  }

  bool is_trial = false;  // lemmas stay here

 private:
  sat::TheoryContext& context_;
};

struct Count {
  std::size_t silent = 0, conflicts = 0, accepted = 0, rejected = 0, decisions = 0, stops = 0,
              dead = 0, told = 0;
};

/// The theory between the host and a judge.
class WatchedTheory final : public sat::Theory {
 public:
  WatchedTheory(LazyModel& model, Count& count)
      : model_(model), theory_(model, limits_), count_(count) {}

  void on_solve(bool all_present) {
    is_part_ = !all_present;
    theory_.on_solve(all_present);
  }
  void on_assign(std::span<const Lit> newly_true) override {
    ASSERT_FALSE(newly_true.empty());
    stack_.insert(stack_.end(), newly_true.begin(), newly_true.end());
    theory_.on_assign(newly_true);
  }
  void on_retract(std::size_t kept) override {
    stack_.resize(kept);
    theory_.on_retract(kept);
    has_retracted_ = true;
  }
  /// The end of a solver.
  void forget() {
    if (!stack_.empty()) on_retract(0);
  }
  sat::Lemma explain(Lit implied, std::vector<Lit>& clause) override {
    ADD_FAILURE() << "asked for the reason of something that was never propagated";
    return theory_.explain(implied, clause);
  }
  void check(sat::Effort effort, sat::TheoryContext& context) override {
    Recorder said(context);
    std::vector<Path> before;
    for (const AgentId i : model_.instance().agents()) before.push_back(theory_.path(i));
    theory_.check(effort, said);
    const Situation now(model_, stack_);
    if (effort == sat::Effort::partial) {
      judge_partial(said, now);
      for (const AgentId i : model_.instance().agents())
        if (theory_.path(i) != before[i.index()]) expect_bound_told(i, said, now);
      if (has_retracted_ && stack_.size() % 4 == 0) compare_with_fresh(context, now);
      has_retracted_ = false;
    } else {
      judge_full(said, now);
    }
  }
  [[nodiscard]] Lit decide(sat::TheoryContext& context) override {
    Recorder said(context);
    const Lit choice = theory_.decide(said);
    const Situation now(model_, stack_);
    EXPECT_TRUE(!choice.valid() || !now.is_assigned(choice));
    EXPECT_TRUE(!choice.valid() || model_.variable(choice).kind != VariableKind::auxiliary);
    if (!is_part_) {
      EXPECT_TRUE(!choice.valid() && !said.stopped && said.lemmas.empty());
    }
    if (said.stopped) {
      EXPECT_FALSE(choice.valid());
      expect_good_paths(theory_, now);
      expect_no_collision(now);
      ++count_.stops;
    }
    count_.decisions += choice.valid() ? 1 : 0;
    return choice;
  }

 private:
  void judge_partial(const Recorder& said, const Situation& now) {
    const bool is_feasible = has_all_paths(now);
    if (!is_feasible) {
      EXPECT_TRUE(said.has_conflict(now)) << "an agent without a path went unnoticed";
    } else if (!said.has_conflict(now)) {
      expect_good_paths(theory_, now);
    }
    ++(is_feasible ? count_.silent : count_.conflicts);
  }
  /// A new path that is dearer than a bound which nobody has spoken of comes with a lemma that
  /// refutes the bound: the search that found the path has proved it.
  void expect_bound_told(AgentId i, const Recorder& said, const Situation& now) {
    const auto cost = static_cast<Timestep>(theory_.path(i).size()) - 1;
    Lit open;  // the largest one; ordered literals imply the others
    for (const auto& literal : model_.cost_literals(i))
      if (literal.cost < cost && !now.is_assigned(literal.above)) open = literal.above;
    if (!open.valid()) return;
    ++count_.told;
    EXPECT_TRUE(std::any_of(said.lemmas.begin(), said.lemmas.end(),
                            [&](const auto& clause) {
                              return std::find(clause.begin(), clause.end(), open) !=
                                         clause.end() &&
                                     std::all_of(clause.begin(), clause.end(), [&](Lit lit) {
                                       return lit == open || now.is_false(lit);
                                     });
                            }))
        << "agent " << i.value();
  }
  void judge_full(const Recorder& said, const Situation& now) {
    if (said.made_literal || said.has_conflict(now)) {
      ++count_.rejected;
      return;
    }
    // A lemma that is true does not complain about the assignment.
    ++count_.accepted;
    EXPECT_TRUE(has_all_paths(now));
    expect_good_paths(theory_, now);
    expect_no_collision(now);
    ASSERT_EQ(theory_.accepted().has_value(), now.all_present());
    if (!now.all_present()) return;
    EXPECT_EQ(support::replay(model_.instance(), *theory_.accepted()), "");
    for (const AgentId i : model_.instance().agents())
      EXPECT_EQ(theory_.accepted()->paths[i], theory_.path(i));
  }
  /// A theory that has never seen anything else than this stack finds the same.
  void compare_with_fresh(sat::TheoryContext& context, const Situation& now) {
    LimitMonitor limits{Limits{}};
    LazyTheory fresh(model_, limits);
    if (!stack_.empty()) fresh.on_assign(stack_);
    Recorder said(context);
    said.is_trial = true;
    fresh.check(sat::Effort::partial, said);
    EXPECT_EQ(said.has_conflict(now), !has_all_paths(now));
    if (said.has_conflict(now)) return;
    expect_good_paths(fresh, now);
  }

  [[nodiscard]] bool has_all_paths(const Situation& now) const {
    for (const AgentId i : model_.instance().agents())
      if (now.is_present(i) && !now.has_path(i)) return false;
    return true;
  }
  static void expect_good_paths(const LazyTheory& theory, const Situation& now) {
    for (const AgentId i : now.model.instance().agents()) {
      const std::string fault = now.is_present(i) ? now.find_fault(i, theory.path(i)) : "";
      EXPECT_EQ(fault, "") << "the path of agent " << i.value();
    }
  }
  void expect_no_collision(const Situation& now) const {
    for (const AgentId i : model_.instance().agents())
      for (const AgentId j : model_.instance().agents()) {
        const bool matters = i < j && now.is_present(i) && now.is_present(j);
        EXPECT_FALSE(matters && support::collide(theory_.path(i), theory_.path(j)));
      }
  }

  LazyModel& model_;
  LimitMonitor limits_{Limits{}};
  LazyTheory theory_;
  Count& count_;
  std::vector<Lit> stack_;
  bool is_part_ = false, has_retracted_ = false;
};

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
