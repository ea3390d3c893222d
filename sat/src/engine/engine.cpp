// SPDX-License-Identifier: MIT
// The only file that knows CaDiCaL, with derived_clause_tracer.hpp and derivation_tracer.hpp. What
// it uses of CaDiCaL is in cmake/cadical_check.cpp, too.
#include "quadrille/sat/engine.hpp"

#include <cadical.hpp>
#include <exception>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "engine/derivation_tracer.hpp"
#include "engine/derived_clause_tracer.hpp"
#include "engine/theory_host.hpp"
#include "quadrille/core/contract.hpp"

namespace quadrille::sat {
namespace {

/// The border between C++ with exceptions and CaDiCaL, whose state is lost when one passes through
/// it.
///
/// What a callback throws is kept until CaDiCaL has returned; callbacks say no more than what lets
/// it return soon. What CaDiCaL throws itself, for want of memory, passes; nothing may be done with
/// the solver after that, not even destroy it.
class Border {
 public:
  /// A callback's work; `otherwise` is the answer once something was thrown.
  template <class Answer, class Work>
  Answer callback(Answer otherwise, const Work& work) {
    if (thrown_) return otherwise;
    try {
      return work();
    } catch (...) {
      if (is_solver_lost_) throw;  // by a call of the solver within the callback
      thrown_ = std::current_exception();
      return otherwise;
    }
  }
  template <class Work>
  void notification(const Work& work) {
    static_cast<void>(callback(0, [&] {
      work();
      return 0;
    }));
  }
  /// A call of the solver.
  template <class Call>
  decltype(auto) solver(const Call& call) {
    try {
      return call();
    } catch (...) {
      is_solver_lost_ = true;
      throw;
    }
  }

  [[nodiscard]] bool has_thrown() const noexcept { return thrown_ != nullptr; }
  [[nodiscard]] bool is_solver_lost() const noexcept { return is_solver_lost_; }
  void lose_solver() noexcept { is_solver_lost_ = true; }
  void rethrow() const {
    if (thrown_) std::rethrow_exception(thrown_);
  }

 private:
  std::exception_ptr thrown_;
  bool is_solver_lost_ = false;
};

/// What the solver tells a DerivationObserver.
class DerivationReceiver {
 public:
  using Number = DerivationObserver::Number;
  using Clause = std::vector<int>;
  DerivationReceiver(DerivationObserver& observer, Border& border)
      : observer_(observer), border_(border) {}
  void given(Number number, const Clause& clause) {
    border_.notification([&] { observer_.on_given(number, clause); });
  }
  void derived(Number number, const Clause& clause, const std::vector<Number>& antecedents) {
    border_.notification([&] { observer_.on_derived(number, clause, antecedents); });
  }
  void refuted(Number number, const Clause& clause, const std::vector<Number>& antecedents) {
    border_.notification([&] { observer_.on_refuted(number, clause, antecedents); });
  }

 private:
  DerivationObserver& observer_;
  Border& border_;
};

/// A theory that has no opinion, for plain SAT solving: the solver's decisions are still counted.
class NoTheory final : public Theory {
 public:
  void on_assign(std::span<const Lit>) override {}
  void on_retract(std::size_t) override {}
  void check(Extent, TheoryContext&) override {}
  Lemma explain(Lit, std::vector<Lit>&) override {
    QUADRILLE_REQUIRE(false, "nothing was propagated");
    return {};
  }
};

}  // namespace

class Engine::Impl final : public CaDiCaL::ExternalPropagator,
                           public CaDiCaL::Terminator,
                           public CaDiCaL::Learner {
 public:
  Impl(Theory* theory, const EngineOptions& options)
      : observed_(theory != nullptr),
        keeps_clauses_(options.keep_clauses),
        effort_of_conflict_(options.effort_of_conflict),
        observer_(options.observer),
        theory_(theory != nullptr ? *theory : no_theory_),
        host_(theory_,
              {[this] { return new_lit(); }, [this](const Lemma& lemma) { count(lemma); }}),
        solver_(std::make_unique<CaDiCaL::Solver>()) {
    try {
      set_up(options);
    } catch (...) {
      abandon_solver();
      throw;
    }
  }

  ~Impl() override {
    if (border_.is_solver_lost()) {
      abandon_solver();
      return;
    }
    solver_->disconnect_external_propagator();
    if (tracer_) solver_->disconnect_proof_tracer(tracer_.get());
    if (derivation_tracer_) solver_->disconnect_proof_tracer(derivation_tracer_.get());
    solver_->disconnect_learner();
    solver_->disconnect_terminator();
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  Lit new_lit() {
    const int variable = ++num_variables_;
    host_.add_variable(variable);
    // Observed before it occurs anywhere: the solver is silently wrong otherwise.
    if (observed_) border_.solver([&] { solver_->add_observed_var(variable); });
    return Lit::from_dimacs(variable);
  }

  void count(const Lemma& lemma) {
    ++num_clauses_;
    if (is_collision(lemma.why)) ++num_collision_clauses_;
    if (observer_ != nullptr) observer_->on_lemma(lemma);
    if (!keeps_clauses_) return;
    kept_.insert(kept_.end(), lemma.clause.begin(), lemma.clause.end());
    kept_.push_back(Lit());
  }

  void add_clause(const Lemma& lemma) {
    count(lemma);
    add_to_solver(lemma.clause);
  }

  Verdict solve(std::span<const Lit> assumptions, LimitMonitor& limits, const SolveBudget& budget) {
    QUADRILLE_REQUIRE(!border_.has_thrown() && !border_.is_solver_lost(),
                      "no earlier call has thrown an exception");
    ++num_solves_;
    limits_ = &limits;
    last_effort_ = budget.effort ? effort() + *budget.effort : Effort::most();
    has_paused_ = false;
    host_.begin_solve();
    assumptions_.assign(assumptions.begin(), assumptions.end());
    // What users do has no business inside of the solver: they have their turn between two calls.
    const LimitMonitor::Quiet quiet(limits);
    const int answer = limits.exhausted_now() ? 0 : border_.solver([&] { return search(budget); });
    limits_ = nullptr;
    border_.rethrow();
    // Adding a clause ends the solver's knowledge of its answer: fetch that first.
    fetch(answer);
    // After a conflict the solver leaves the rest of the queue alone; it is still true.
    for (const QueuedLemma& rest : host_.take_queue()) add_to_solver(rest.clause);
    // A theory that stops has not looked at the model.
    const bool is_model = answer == 10 && !host_.wants_stop();
    last_ = is_model ? Verdict::sat : answer == 20 ? Verdict::unsat : Verdict::unknown;
    if (last_ == Verdict::unsat && observer_ != nullptr) {
      std::vector<Lit> clause = failed_;
      for (Lit& lit : clause) lit = ~lit;
      observer_->on_core(clause);
    }
    return last_;
  }

  bool model_value(Lit lit) const {
    QUADRILLE_REQUIRE(last_ == Verdict::sat, "there is a model");
    const auto v = static_cast<std::size_t>(lit.variable());
    QUADRILLE_REQUIRE(v < model_.size(), "the variable is older than the model");
    return model_[v] == lit.positive();
  }

  const std::vector<Lit>& failed() const {
    QUADRILLE_REQUIRE(last_ == Verdict::unsat, "the last verdict was unsat");
    return failed_;
  }

  int num_variables() const { return num_variables_; }
  Effort effort() const { return num_conflicts_ * effort_of_conflict_ + theory_.effort(); }

  std::vector<Lit> take_clauses() {
    QUADRILLE_REQUIRE(keeps_clauses_, "the engine keeps its clauses");
    return std::exchange(kept_, {});
  }

  void set_phase(Lit lit) {
    border_.solver([&] { solver_->phase(lit.dimacs()); });
  }
  void clear_phase(Lit lit) {
    border_.solver([&] { solver_->unphase(lit.variable()); });
  }

  void add_statistics(Statistics& statistics) const {
    statistics.sat_calls += num_solves_;
    statistics.conflicts += num_conflicts_;
    statistics.decisions += host_.num_levels_opened();
    statistics.variables += num_variables_;
    statistics.clauses += num_clauses_;
    statistics.collision_clauses += num_collision_clauses_;
    statistics.models_checked += host_.num_models_checked();
  }

 private:
  void set_up(const EngineOptions& options) {
    // Options can be set only before anything else is done with the solver.
    if (!options.inprocessing) solver_->configure("plain");
    set("quiet", 1);
    set("seed", static_cast<int>(options.seed));
    // A propagator's clauses make these useless or wrong: incremental lazy backtracking, local
    // search and lucky phases look at the clauses alone.
    set("ilb", 0);
    set("walk", 0);
    set("lucky", 0);
    set("phase", options.initial_phase ? 1 : 0);  // 0: few of the many usages happen
    set("exteagerreasons", 0);
    set("exteagerrecalc", 0);
    set("chrono", options.chronological ? 1 : 0);
    set("chronolevelim", 20);
    set("bumpreason", options.bump_reasons ? 1 : 0);
    are_reasons_forgettable = true;
    solver_->connect_terminator(this);
    solver_->connect_learner(this);
    if (observer_ != nullptr && observer_->wants_learned()) {
      tracer_ = std::make_unique<DerivedClauseTracer>(
          [this](const std::vector<int>& clause) { pass_on_learned(clause); });
      solver_->connect_proof_tracer(tracer_.get(), false);
    }
    if (options.derivations != nullptr) {
      receiver_.emplace(*options.derivations, border_);
      derivation_tracer_ = std::make_unique<DerivationTracer<DerivationReceiver>>(*receiver_);
      solver_->connect_proof_tracer(derivation_tracer_.get(), true);
    }
    solver_->connect_external_propagator(this);
    // Without any observed variable the solver would not ask the propagator for clauses.
    if (observed_) static_cast<void>(new_lit());
  }

  void pass_on_learned(const std::vector<int>& clause) {
    border_.notification([&] {
      learned_.clear();
      for (const int literal : clause) learned_.push_back(Lit::from_dimacs(literal));
      observer_->on_learned(learned_);
    });
  }

  void set(const char* name, int value) {
    QUADRILLE_REQUIRE(solver_->set(name, value), "the solver knows its option");
  }

  /// Its memory is not given back: only the solver knows where it is, and what it knows is wrong.
  void abandon_solver() noexcept {
    static_cast<void>(solver_.release());
    static_cast<void>(tracer_.release());
    static_cast<void>(derivation_tracer_.release());
  }

  int search(const SolveBudget& budget) {
    for (const Lit lit : assumptions_) solver_->assume(lit.dimacs());
    if (budget.conflicts) solver_->limit("conflicts", *budget.conflicts);
    if (budget.decisions) solver_->limit("decisions", *budget.decisions);
    return solver_->solve();
  }

  void fetch(int answer) {
    failed_.clear();
    model_.clear();
    if (answer == 20) failed_.reserve(assumptions_.size());
    if (answer == 10) model_.resize(static_cast<std::size_t>(num_variables_) + 1);
    border_.solver([&] {
      if (answer == 20)
        for (const Lit lit : assumptions_)
          if (solver_->failed(lit.dimacs())) failed_.push_back(lit);
      for (std::size_t v = 1; v < model_.size(); ++v)
        model_[v] = solver_->val(static_cast<int>(v)) > 0;
      if (answer == 0) solver_->reset_assumptions();
    });
  }

  void add_to_solver(std::span<const Lit> clause) {
    border_.solver([&] {
      for (const Lit lit : clause) solver_->add(lit.dimacs());
      solver_->add(0);
    });
    border_.rethrow();
  }

  // CaDiCaL::ExternalPropagator
  void notify_assignment(const std::vector<int>& lits) override {
    border_.notification([&] { host_.notify_assignment(lits); });
  }
  void notify_new_decision_level() override {
    border_.notification([&] { host_.notify_new_decision_level(); });
  }
  void notify_backtrack(std::size_t level) override {
    border_.notification([&] { host_.notify_backtrack(level); });
  }
  bool cb_check_found_model(const std::vector<int>&) override {
    return border_.callback(true, [&] { return host_.check_found_model(); });
  }
  int cb_propagate() override {
    return border_.callback(0, [&] { return host_.propagate(); });
  }
  int cb_decide() override {
    return border_.callback(0, [&] { return host_.decide(); });
  }
  // Once something was thrown: that it was implied by nothing, which ends the search soon and is
  // as good as any reason then.
  int cb_add_reason_clause_lit(int propagated) override {
    const int literal = border_.callback(0, [&] { return host_.next_reason_literal(propagated); });
    if (!border_.has_thrown()) return literal;
    is_bare_reason_told_ = !is_bare_reason_told_;
    return is_bare_reason_told_ ? propagated : 0;
  }
  bool cb_has_external_clause(bool& forgettable) override {
    return border_.callback(false, [&] { return host_.has_clause(forgettable); });
  }
  int cb_add_external_clause_lit() override {
    return border_.callback(0, [&] { return host_.next_clause_literal(); });
  }

  // CaDiCaL::Terminator
  bool terminate() override {
    return border_.callback(true, [&] {
      if (host_.wants_stop() || (limits_ != nullptr && limits_->exhausted())) return true;
      if (effort() < last_effort_) return false;
      if (!has_paused_) theory_.on_pause();
      has_paused_ = true;
      return true;
    });
  }

  // CaDiCaL::Learner
  bool learning(int) override {
    border_.notification([&] {
      ++num_conflicts_;
      if (limits_ != nullptr) limits_->add_conflicts(1);
    });
    return false;
  }
  void learn(int) override {}

  NoTheory no_theory_;
  const bool observed_, keeps_clauses_;
  const Effort effort_of_conflict_;
  ClauseObserver* const observer_;
  Border border_;
  Theory& theory_;
  TheoryHost host_;
  std::unique_ptr<CaDiCaL::Solver> solver_;
  std::unique_ptr<DerivedClauseTracer> tracer_;
  std::optional<DerivationReceiver> receiver_;
  std::unique_ptr<DerivationTracer<DerivationReceiver>> derivation_tracer_;
  LimitMonitor* limits_ = nullptr;
  int num_variables_ = 0;
  Effort last_effort_ = Effort::most();  // of the running solve
  bool has_paused_ = false;              // the running solve has come to its last effort
  bool is_bare_reason_told_ = false;
  std::vector<Lit> assumptions_, failed_, kept_, learned_;
  std::vector<bool> model_;
  Verdict last_ = Verdict::unknown;
  std::int64_t num_solves_ = 0, num_conflicts_ = 0, num_clauses_ = 0, num_collision_clauses_ = 0;
};

Engine::Engine(Theory* theory, const EngineOptions& options)
    : impl_(std::make_unique<Impl>(theory, options)), proof_(options.proof) {}
Engine::~Engine() = default;

Lit Engine::new_lit() { return impl_->new_lit(); }
void Engine::add_clause(const Lemma& lemma) { impl_->add_clause(lemma); }
void Engine::set_phase(Lit lit) { impl_->set_phase(lit); }
void Engine::clear_phase(Lit lit) { impl_->clear_phase(lit); }
Verdict Engine::solve(std::span<const Lit> assumptions, LimitMonitor& limits,
                      const SolveBudget& budget) {
  return impl_->solve(assumptions, limits, budget);
}
bool Engine::model_value(Lit lit) const { return impl_->model_value(lit); }
std::vector<Lit> Engine::core() const { return impl_->failed(); }
int Engine::num_variables() const { return impl_->num_variables(); }
Effort Engine::effort() const { return impl_->effort(); }
std::vector<Lit> Engine::take_clauses() { return impl_->take_clauses(); }
void Engine::add_statistics(Statistics& statistics) const { impl_->add_statistics(statistics); }

}  // namespace quadrille::sat
