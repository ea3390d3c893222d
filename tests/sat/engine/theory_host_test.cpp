// SPDX-License-Identifier: MIT
#include "engine/theory_host.hpp"

#include <gtest/gtest.h>

#include <set>
#include <vector>

#include "support/environment.hpp"
#include "support/mock_solver.hpp"

namespace quadrille::sat {
namespace {

Lit lit(int dimacs) { return Lit::from_dimacs(dimacs); }

/// Forbids that two neighbouring variables v, v+1 are both true, in the laziest way a theory may:
/// nothing is remembered but the stack.
class NoNeighbours final : public Theory {
 public:
  explicit NoNeighbours(int num_variables, bool propagates)
      : num_variables_(num_variables), propagates_(propagates) {}

  void on_assign(std::span<const Lit> newly_true) override {
    EXPECT_FALSE(newly_true.empty());
    for (const Lit l : newly_true) {
      for (const Lit other : stack) EXPECT_NE(other.variable(), l.variable());
      stack.push_back(l);
    }
  }
  void on_retract(std::size_t kept) override {
    ASSERT_LT(kept, stack.size());
    stack.resize(kept);
  }
  void check(Extent, TheoryContext& context) override {
    EXPECT_EQ(context.num_assigned(), stack.size());
    for (const Lit a : stack) {
      EXPECT_EQ(context.value(a), Truth::is_true);
      EXPECT_EQ(context.value(~a), Truth::is_false);
      if (!a.positive()) continue;
      for (const int next : {a.variable() - 1, a.variable() + 1}) {
        if (next < 1 || next > num_variables_) continue;
        const Lit b = lit(next);
        if (context.value(b) == Truth::is_true && a < b) {
          const Lit clause[] = {~a, ~b};
          context.add_lemma({why::Vertex{}, clause, {}, false});
        } else if (propagates_ && context.value(b) == Truth::unassigned) {
          context.propagate(~b);
        }
      }
    }
  }
  Lemma explain(Lit implied, std::vector<Lit>& clause) override {
    // Any true neighbour will do; late questions may find none, then any neighbour is valid.
    const int v = implied.variable();
    Lit because = lit(v > 1 ? v - 1 : v + 1);
    for (const Lit l : stack)
      if (l.positive() && std::abs(l.variable() - v) == 1) because = l;
    clause = {implied, ~because};
    return {why::Vertex{}, {}, {}, true};
  }

  std::vector<Lit> stack;

 private:
  int num_variables_;
  bool propagates_;
};

TEST(TheoryHost, ShowsTheTheoryAStackWhateverTheSolverDoes) {
  constexpr int kVariables = 9;
  const auto sequences = static_cast<std::uint64_t>(support::scaled(5000));
  std::size_t lemmas = 0, reasons = 0;
  for (std::uint64_t seed = 0; seed < sequences; ++seed) {
    SCOPED_TRACE(seed);
    NoNeighbours theory(kVariables, seed % 2 == 0);
    TheoryHost host(theory, {[] { return Lit(); }, [](const Lemma&) {}});
    for (int v = 1; v <= kVariables; ++v) host.add_variable(v);
    support::MockSolver solver(host, kVariables, seed);
    for (int step = 0; step < 25 && !solver.dead(); ++step) {
      switch (solver.draw(8)) {
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
          solver.announce();
          break;
        default: {
          const int v = static_cast<int>(solver.draw(kVariables)) + 1;
          solver.assign(lit(solver.draw(3) == 0 ? -v : v));
          if (solver.draw(2) == 0 && solver.propagate() && !solver.dead()) {
            for (int w = 1; w < kVariables; ++w)
              ASSERT_FALSE(solver.is_true(lit(w)) && solver.is_true(lit(w + 1)) &&
                           solver.announced().contains(lit(w)) &&
                           solver.announced().contains(lit(w + 1)) && [&] {
                             bool forgettable;
                             return !host.has_clause(forgettable);
                           }());
          }
        }
      }
      const std::set<Lit> seen(theory.stack.begin(), theory.stack.end());
      ASSERT_EQ(seen, solver.announced());
    }
    for (const auto& [implied, reason] : solver.reasons()) {
      ASSERT_EQ(reason.size(), 2u);
      ASSERT_EQ(std::abs(reason[0].variable() - reason[1].variable()), 1);
    }
    lemmas += solver.clauses().size();
    reasons += solver.reasons().size();
  }
  EXPECT_GT(lemmas, sequences / 10);
  EXPECT_GT(reasons, sequences / 10);
}

TEST(TheoryHost, RejectsAModelUntilItsClauseIsFetched) {
  NoNeighbours theory(2, false);
  TheoryHost host(theory, {[] { return Lit(); }, [](const Lemma&) {}});
  host.add_variable(1);
  host.add_variable(2);
  const int both[] = {1, 2};
  host.notify_assignment(both);
  EXPECT_FALSE(host.check_found_model());
  EXPECT_FALSE(host.check_found_model());  // the theory is not asked again
  bool forgettable = true;
  ASSERT_TRUE(host.has_clause(forgettable));
  EXPECT_FALSE(forgettable);
  EXPECT_EQ(host.next_clause_literal(), -1);
  EXPECT_EQ(host.next_clause_literal(), -2);
  EXPECT_EQ(host.next_clause_literal(), 0);
  EXPECT_FALSE(host.has_clause(forgettable));
  EXPECT_EQ(host.num_models_checked(), 1);
}

TEST(TheoryHost, HandsOverWhatTheSolverDidNotFetch) {
  NoNeighbours theory(3, false);
  TheoryHost host(theory, {[] { return Lit(); }, [](const Lemma&) {}});
  for (int v = 1; v <= 3; ++v) host.add_variable(v);
  const int all[] = {1, 2, 3};
  host.notify_assignment(all);
  EXPECT_EQ(host.propagate(), 0);
  for (const int expected : {-1, -2, 0}) EXPECT_EQ(host.next_clause_literal(), expected);
  const auto rest = host.take_queue();
  ASSERT_EQ(rest.size(), 1u);
  EXPECT_EQ(rest[0].clause, (std::vector<Lit>{lit(-2), lit(-3)}));
}

}  // namespace
}  // namespace quadrille::sat
