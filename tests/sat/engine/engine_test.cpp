// SPDX-License-Identifier: MIT
#include "quadrille/sat/engine.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <vector>

#include "quadrille/sat/cost_search.hpp"
#include "support/environment.hpp"

namespace quadrille::sat {
namespace {

using Clause = std::vector<Lit>;

void add(Engine& engine, const Clause& clause) {
  engine.add_clause({why::Path{}, clause, {}, false});
}

Verdict solve(Engine& engine, const std::vector<Lit>& assumptions = {}) {
  LimitMonitor limits{Limits{}};
  return engine.solve(assumptions, limits);
}

/// Demands that exactly `sum` of the variables are true, and says so only about assignments that it
/// sees: with eager conflicts, with propagations and reasons, or at complete assignments only.
class ExactlySum final : public Theory {
 public:
  enum class Style { complete, eager, propagating };
  ExactlySum(std::size_t sum, Style style) : sum_(sum), style_(style) {}

  void watch(Lit lit) { lits_.push_back(lit); }
  void on_assign(std::span<const Lit> newly_true) override {
    stack_.insert(stack_.end(), newly_true.begin(), newly_true.end());
  }
  void on_retract(std::size_t kept) override { stack_.resize(kept); }

  void check(Extent extent, TheoryContext& context) override {
    if (extent == Extent::partial && style_ == Style::complete) return;
    std::vector<Lit> yes, no;
    for (const Lit lit : lits_) {
      if (context.value(lit) == Truth::is_true) yes.push_back(lit);
      if (context.value(lit) == Truth::is_false) no.push_back(lit);
    }
    if (yes.size() > sum_) {
      Clause clause;
      for (std::size_t i = 0; i <= sum_; ++i) clause.push_back(~yes[i]);
      context.add_lemma({why::Path{}, clause, {}, false});
    } else if (no.size() > lits_.size() - sum_) {
      Clause clause(no.begin(), no.begin() + static_cast<std::ptrdiff_t>(lits_.size() - sum_ + 1));
      context.add_lemma({why::Path{}, clause, {}, false});
    } else if (style_ == Style::propagating && yes.size() == sum_) {
      for (const Lit lit : lits_) {
        if (context.value(lit) != Truth::unassigned) continue;
        because_.resize(std::max(because_.size(), static_cast<std::size_t>(lit.variable()) + 1));
        because_[static_cast<std::size_t>(lit.variable())] = yes;
        context.propagate(~lit);
      }
    }
  }
  Lemma explain(Lit implied, Clause& clause) override {
    clause.push_back(implied);
    for (const Lit lit : because_[static_cast<std::size_t>(implied.variable())])
      clause.push_back(~lit);
    return {why::Path{}, {}, {}, true};
  }

 private:
  std::size_t sum_;
  Style style_;
  std::vector<Lit> lits_, stack_;
  std::vector<Clause> because_;
};

/// Whether some assignment of `n` variables satisfies the clauses and has `sum` of them true.
bool exists(int n, const std::vector<Clause>& clauses, std::size_t sum,
            const std::vector<Lit>& assumptions) {
  for (unsigned bits = 0; bits < (1u << n); ++bits) {
    if (static_cast<std::size_t>(__builtin_popcount(bits)) != sum) continue;
    const auto is_true = [&](Lit lit, int first) {
      return ((bits >> (lit.variable() - first)) & 1u) == (lit.positive() ? 1u : 0u);
    };
    const int first = 2;  // variable 1 is the engine's own
    bool good = std::all_of(assumptions.begin(), assumptions.end(),
                            [&](Lit l) { return is_true(l, first); });
    for (const Clause& clause : clauses)
      good = good &&
             std::any_of(clause.begin(), clause.end(), [&](Lit l) { return is_true(l, first); });
    if (good) return true;
  }
  return false;
}

TEST(Engine, AgreesWithEnumerationForEveryStyleOfTheory) {
  const std::size_t cases = support::scaled(600);
  std::size_t num_sat = 0, num_unsat = 0;
  for (std::size_t seed = 0; seed < cases; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    const int n = 8;
    const std::size_t sum = 2 + random() % 4;
    ExactlySum theory(sum, static_cast<ExactlySum::Style>(seed % 3));
    EngineOptions options;
    options.seed = static_cast<std::uint32_t>(seed);
    options.inprocessing = seed % 2 == 0;
    Engine engine(&theory, options);
    std::vector<Lit> lits;
    for (int i = 0; i < n; ++i) {
      lits.push_back(engine.new_lit());
      theory.watch(lits.back());
    }
    const auto random_lit = [&] {
      const Lit lit = lits[random() % lits.size()];
      return random() % 2 == 0 ? lit : ~lit;
    };
    std::vector<Clause> clauses;
    for (int round = 0; round < 6; ++round) {  // incremental
      for (int c = 0; c < 5; ++c) {
        clauses.push_back({random_lit(), random_lit(), random_lit()});
        add(engine, clauses.back());
      }
      std::vector<Lit> assumptions;
      for (int a = 0; a < 2; ++a) {
        const Lit lit = random_lit();
        if (std::find(assumptions.begin(), assumptions.end(), ~lit) == assumptions.end())
          assumptions.push_back(lit);
      }
      const Verdict verdict = solve(engine, assumptions);
      ASSERT_EQ(verdict, exists(n, clauses, sum, assumptions) ? Verdict::sat : Verdict::unsat);
      if (verdict == Verdict::sat) {
        ++num_sat;
        std::size_t trues = 0;
        for (const Lit lit : lits) trues += engine.model_value(lit) ? 1u : 0u;
        ASSERT_EQ(trues, sum);
        for (const Lit lit : assumptions) ASSERT_TRUE(engine.model_value(lit));
      } else {
        ++num_unsat;
        const std::vector<Lit> core = engine.core();
        for (const Lit lit : core)
          ASSERT_NE(std::find(assumptions.begin(), assumptions.end(), lit), assumptions.end());
        ASSERT_FALSE(exists(n, clauses, sum, core));
      }
    }
  }
  EXPECT_GT(num_sat, cases / 10);
  EXPECT_GT(num_unsat, cases / 10);
}

/// n+1 pigeons in n holes: many conflicts.
void add_pigeons(Engine& engine, int holes) {
  std::vector<Clause> in(static_cast<std::size_t>(holes) + 1);
  for (auto& pigeon : in)
    for (int h = 0; h < holes; ++h) pigeon.push_back(engine.new_lit());
  for (std::size_t p = 0; p < in.size(); ++p) {
    add(engine, in[p]);
    for (std::size_t q = 0; q < p; ++q)
      for (std::size_t h = 0; h < in[p].size(); ++h) add(engine, {~in[p][h], ~in[q][h]});
  }
}

TEST(Engine, StopsAtEachLimitAndNamesIt) {
  Engine engine(nullptr);
  add_pigeons(engine, 12);
  Limits by_conflicts, by_time, by_memory, by_interrupt;
  by_conflicts.conflicts = 100;
  by_time.cpu_s = 0.05;
  by_memory.memory_mib = 1;
  const std::atomic<bool> interrupted = true;
  by_interrupt.interrupt = &interrupted;
  const std::pair<Limits, StopReason> cases[] = {{by_conflicts, StopReason::conflicts},
                                                 {by_time, StopReason::cpu_time},
                                                 {by_memory, StopReason::memory},
                                                 {by_interrupt, StopReason::interrupt}};
  for (const auto& [limits, reason] : cases) {
    LimitMonitor monitor(limits);
    EXPECT_EQ(engine.solve({}, monitor), Verdict::unknown);
    EXPECT_EQ(monitor.reason(), reason);
  }
  LimitMonitor unlimited{Limits{}};
  EXPECT_EQ(engine.solve({}, unlimited, {50, {}}), Verdict::unknown);
}

// What users do has no business inside of the solver.
TEST(Engine, HasNoPulseWhileItSolves) {
  Engine engine(nullptr);
  add_pigeons(engine, 8);
  LimitMonitor limits{Limits{}};
  int num_beats = 0;
  limits.set_pulse([&] { ++num_beats; });
  SolveBudget budget;
  budget.conflicts = 500;
  EXPECT_EQ(engine.solve({}, limits, budget), Verdict::unknown);
  EXPECT_EQ(num_beats, 0);
  static_cast<void>(limits.exhausted_now());
  EXPECT_EQ(num_beats, 1);
}

TEST(Engine, PausesWithTheSearchsStackWhenEffortIsUsedUp) {
  /// Agrees with everything and keeps what is assigned.
  struct Silent final : Theory {
    void on_assign(std::span<const Lit> newly_true) override { stack += newly_true.size(); }
    void on_retract(std::size_t kept) override { stack = kept; }
    void check(Extent, TheoryContext&) override {}
    Lemma explain(Lit, Clause&) override { return {why::Path{}, {}, {}, false}; }
    void on_pause() override {
      ++pauses;
      if (stack > 0) ++pauses_within;
    }
    std::size_t stack = 0;
    int pauses = 0, pauses_within = 0;
  } theory;
  Engine engine(&theory);
  add_pigeons(engine, 10);
  LimitMonitor unlimited{Limits{}};
  SolveBudget budget;
  budget.effort = Effort::microseconds(6250);
  for (int k = 1; k <= 20; ++k) {
    ASSERT_EQ(engine.solve({}, unlimited, budget), Verdict::unknown);
    EXPECT_EQ(theory.pauses, k);
  }
  EXPECT_GE(theory.pauses_within, 15);
  EXPECT_EQ(engine.solve({}, unlimited, {50, {}}), Verdict::unknown);
  EXPECT_EQ(theory.pauses, 20) << "conflicts were used up, not effort";
}

TEST(Engine, TellsTheObserverEachClauseAndEachConsequence) {
  struct Recorder final : ClauseObserver {
    void on_lemma(const Lemma&) override { ++lemmas; }
    void on_learned(std::span<const Lit> clause) override {
      ++learned;
      if (clause.empty()) refuted = true;
    }
    int lemmas = 0, learned = 0;
    bool refuted = false;
  } recorder;
  EngineOptions options;
  options.observer = &recorder;
  Engine engine(nullptr, options);
  add_pigeons(engine, 4);
  EXPECT_EQ(recorder.lemmas, 5 + 4 * 10);
  EXPECT_EQ(solve(engine), Verdict::unsat);
  EXPECT_GT(recorder.learned, 0);
  EXPECT_TRUE(recorder.refuted);
  EXPECT_TRUE(engine.core().empty());
}

TEST(Engine, TellsTheObserverTheCoreOfEachRefutation) {
  struct Recorder final : ClauseObserver {
    void on_lemma(const Lemma&) override {}
    void on_learned(std::span<const Lit>) override {}
    void on_core(std::span<const Lit> clause) override {
      cores.emplace_back(clause.begin(), clause.end());
    }
    std::vector<Clause> cores;
  } recorder;
  EngineOptions options;
  options.observer = &recorder;
  Engine engine(nullptr, options);
  LimitMonitor unlimited{Limits{}}, limits_over{Limits{}};
  const Lit a = engine.new_lit(), b = engine.new_lit(), c = engine.new_lit();
  add(engine, {~a, ~b});
  const std::vector<Lit> assumptions{c, b, a};
  ASSERT_EQ(engine.solve(assumptions, unlimited), Verdict::unsat);
  EXPECT_EQ(recorder.cores, (std::vector<Clause>{{~b, ~a}}));
  ASSERT_EQ(solve(engine), Verdict::sat);
  limits_over.stop(StopReason::conflicts);
  ASSERT_EQ(engine.solve(assumptions, limits_over), Verdict::unknown);
  EXPECT_EQ(recorder.cores.size(), 1u);
  add(engine, {a});
  add(engine, {b});
  ASSERT_EQ(engine.solve(assumptions, unlimited), Verdict::unsat);
  EXPECT_EQ(recorder.cores, (std::vector<Clause>{{~b, ~a}, {}}));
}

TEST(Engine, IsDeterministicForASeed) {
  Statistics first;
  for (int run = 0; run < 2; ++run) {
    Engine engine(nullptr);
    add_pigeons(engine, 7);
    EXPECT_EQ(solve(engine), Verdict::unsat);
    Statistics statistics;
    engine.add_statistics(statistics);
    EXPECT_GT(statistics.conflicts, 0);
    EXPECT_EQ(statistics.sat_calls, 1);
    if (run == 0) first = statistics;
    EXPECT_EQ(statistics.conflicts, first.conflicts);
    EXPECT_EQ(statistics.decisions, first.decisions);
  }
}

/// Throws when it is asked for the k-th time, whatever it is asked.
class Throwing final : public Theory, public ClauseObserver {
 public:
  struct Thrown {};
  Throwing(Theory& inner, int k) : inner_(inner), calls_left_(k) {}
  void on_assign(std::span<const Lit> newly_true) override {
    count();
    inner_.on_assign(newly_true);
  }
  void on_retract(std::size_t kept) override {
    if (calls_left_ > 0) count();  // an engine goes back to the start before it ends
    inner_.on_retract(kept);
  }
  void check(Extent extent, TheoryContext& context) override {
    count();
    inner_.check(extent, context);
  }
  Lit decide(TheoryContext& context) override {
    count();
    return inner_.decide(context);
  }
  Lemma explain(Lit implied, Clause& clause) override {
    count();
    return inner_.explain(implied, clause);
  }
  void on_lemma(const Lemma&) override { count(); }
  void on_learned(std::span<const Lit>) override { count(); }
  void on_core(std::span<const Lit>) override { count(); }

 private:
  void count() {
    ASSERT_GE(calls_left_, 1) << "asked after it had thrown";
    if (--calls_left_ == 0) throw Thrown{};
  }
  Theory& inner_;
  int calls_left_;
};

TEST(Engine, WhatATheoryThrowsComesOutOfIt) {
  int num_thrown = 0;
  for (int k = 1; k <= 400; ++k) {
    SCOPED_TRACE(k);
    ExactlySum sum(3, static_cast<ExactlySum::Style>(k % 3));
    Throwing theory(sum, k);
    EngineOptions options;
    options.seed = static_cast<std::uint32_t>(k);
    options.observer = &theory;
    options.chronological = k % 2 == 0;
    bool has_thrown = false;
    try {
      Engine engine(&theory, options);
      std::vector<Lit> lits;
      for (int i = 0; i < 10; ++i) {
        lits.push_back(engine.new_lit());
        sum.watch(lits.back());
      }
      std::mt19937_64 random(static_cast<std::uint64_t>(k));
      for (int round = 0; round < 30; ++round) {
        Clause clause;
        for (int i = 0; i < 3; ++i) {
          const Lit lit = lits[random() % lits.size()];
          clause.push_back(random() % 2 == 0 ? lit : ~lit);
        }
        add(engine, clause);
        static_cast<void>(solve(engine));
      }
    } catch (const Throwing::Thrown&) {
      has_thrown = true;
    }
    num_thrown += has_thrown ? 1 : 0;
  }
  EXPECT_GT(num_thrown, 300);
}

/// Holds what the solver says against itself: each clause follows from its antecedents by unit
/// propagation.
class Derivations final : public DerivationObserver {
 public:
  void on_given(Number number, Clause clause) override { keep(number, clause); }
  void on_derived(Number number, Clause clause, std::span<const Number> antecedents) override {
    std::set<int> is_false(clause.begin(), clause.end());
    // Of assumptions that contradict each other.
    bool follows =
        std::any_of(clause.begin(), clause.end(), [&](int lit) { return is_false.contains(-lit); });
    for (const Number antecedent : antecedents) {
      std::set<int> left;
      for (const int lit : clauses_.at(antecedent))
        if (!is_false.contains(lit)) left.insert(lit);
      follows = follows || left.empty();
      if (left.size() == 1) is_false.insert(-*left.begin());
      if (follows) break;
    }
    EXPECT_TRUE(follows) << "clause " << number;
    keep(number, clause);
    ++num_derived_;
  }
  void on_refuted(Number number, Clause clause, std::span<const Number> antecedents) override {
    on_derived(number, clause, antecedents);
    refuted_.emplace(clause.begin(), clause.end());
  }

  [[nodiscard]] bool has_refuted(const std::vector<Lit>& core) const {
    std::set<int> clause;
    for (const Lit lit : core) clause.insert(-lit.dimacs());
    return refuted_.contains(clause);
  }
  [[nodiscard]] int num_derived() const { return num_derived_; }

 private:
  void keep(Number number, Clause clause) {
    EXPECT_TRUE(clauses_.try_emplace(number, clause.begin(), clause.end()).second);
  }

  std::map<Number, std::vector<int>> clauses_;
  std::set<std::set<int>> refuted_;
  int num_derived_ = 0;
};

TEST(Engine, TellsHowItComesToItsClausesAndSearchesAsBefore) {
  int num_derived = 0, num_cores = 0;
  for (std::uint64_t seed = 0; seed < quadrille::support::scaled(40); ++seed) {
    SCOPED_TRACE(seed);
    Derivations derivations;
    std::vector<Statistics> statistics;
    for (const bool listens : {true, false}) {
      std::mt19937_64 random(seed);
      EngineOptions options;
      options.inprocessing = seed % 2 == 0;
      if (listens) options.derivations = &derivations;
      ExactlySum sum(20, ExactlySum::Style::eager);
      Engine engine(options.inprocessing ? nullptr : &sum, options);
      std::vector<Lit> lits;
      for (int i = 0; i < 50; ++i) {
        lits.push_back(engine.new_lit());
        sum.watch(lits.back());
      }
      const auto draw = [&] {
        const Lit lit = lits[random() % lits.size()];
        return random() % 2 == 0 ? lit : ~lit;
      };
      for (int i = 0; i < 190; ++i) {
        Clause clause{draw(), draw(), draw()};
        add(engine, clause);
      }
      for (int round = 0; round < 10; ++round) {
        std::vector<Lit> assumptions;
        for (int i = 0; i < 6; ++i) assumptions.push_back(draw());
        if (solve(engine, assumptions) != Verdict::unsat || engine.core().empty()) continue;
        if (!listens) continue;
        EXPECT_TRUE(derivations.has_refuted(engine.core()));
        ++num_cores;
      }
      engine.add_statistics(statistics.emplace_back());
    }
    EXPECT_EQ(statistics[0].conflicts, statistics[1].conflicts);
    EXPECT_EQ(statistics[0].decisions, statistics[1].decisions);
    num_derived += derivations.num_derived();
  }
  EXPECT_GT(num_derived, 0);
  EXPECT_GT(num_cores, 0);
}

}  // namespace
}  // namespace quadrille::sat
