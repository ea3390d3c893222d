// SPDX-License-Identifier: MIT
// The checker's rules, with neighbours that are false: against enumeration where that is possible.
#include "rules/rules.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "check/support.hpp"
#include "support/environment.hpp"
#include "support/random.hpp"

namespace quadrille_check::support {
namespace {

using quadrille::support::Random;
using quadrille::support::scaled;

// ---- rule 1 -------------------------------------------------------------------------------------

// Agent 0 from 0 to 4 along a lane, agent 1 beside it.
const Instance kLane = grid("...../.....", {{0, 4}, {5, 9}});

TEST(Rules, OneAgentCostsMoreOrIsSomewhere) {
  const std::string lane =
      "c 1 0 4\nf 2 0 0 2 2\nf 3 0 0 2 3\nf 4 0 0 7 3\nc 5 0 5\nf 6 0 1 1 2 1\n";
  EXPECT_TRUE(accepts(kLane, lane + "f 7 0 2 5 1 -1\na 1 0 | -1 -2 -7\n"));
  EXPECT_FALSE(accepts(kLane, lane + "a 1 0 | -5 -2\n"));  // it may wait
  EXPECT_FALSE(accepts(kLane, lane + "a 1 0 | -1 -3\n"));  // in 2 at 2, not at 3
  EXPECT_FALSE(accepts(kLane, lane + "a 1 1 | -1 -2\n"));  // about the other agent
  EXPECT_FALSE(accepts(kLane, lane + "a 1 0 | -2\n"));     // at any cost
  EXPECT_FALSE(accepts(kLane, lane + "a 1 0 | -5 1\n"));   // it may cost 5
  EXPECT_TRUE(accepts(kLane, lane + "a 1 0 | 5 -1\n"));    // 5 or more than 4
  EXPECT_FALSE(accepts(kLane, lane + "a 1 0 | 1 2\n"));
}

TEST(Rules, OneAgentKeepsOffTheGoalsOfThoseWhoRest) {
  // A lane with one way: agent 0 has to pass the goal of agent 1.
  const Instance lane = grid(".....", {{0, 4}, {1, 2}});
  EXPECT_TRUE(accepts(lane, "c 1 0 4\nc 2 1 1\na 1 0 | -1 -2\n"));
  EXPECT_TRUE(accepts(lane, "c 1 0 4\nc 2 1 2\na 1 0 | -1 -2\n"));   // both would be there at 2
  EXPECT_FALSE(accepts(lane, "c 1 0 4\nc 2 1 3\na 1 0 | -1 -2\n"));  // it has passed by then
  EXPECT_FALSE(accepts(lane, "c 1 0 4\nc 2 1 1\na 1 0 | -1 2\n"));
}

/// All paths of agent 0 that are `steps` long.
void for_each_path(const Instance& instance, std::vector<int>& path, std::size_t steps,
                   const std::function<void(const std::vector<int>&)>& visit) {
  if (path.size() == steps + 1) return visit(path);
  const int here = path.back();
  const auto go = [&](int next) {
    path.push_back(next);
    for_each_path(instance, path, steps, visit);
    path.pop_back();
  };
  go(here);
  for (const int next : instance.neighbours(here)) go(next);
}

std::string random_literal_of(Random& random, int variable, int steps, int places) {
  const auto time = [&] { return std::to_string(random.below(static_cast<std::size_t>(steps))); };
  const auto place = [&] { return std::to_string(random.below(static_cast<std::size_t>(places))); };
  const std::string name = std::to_string(variable);
  switch (random.below(6)) {
    case 0:
      return "c " + name + " 0 " + time() + "\n";
    case 1:
      return "c " + name + " 1 " + time() + "\n";
    case 2:
      return "x " + name + " 0 " + place() + " " + time() + "\n";
    case 3:
      return "f " + name + " 0 3 " + place() + " " + time() + " " + place() + " " + time() + "\n";
    case 4:
      return "f " + name + " 0 2 " + place() + " " + std::to_string(random.below(3)) + " " +
             (random.percent(50) ? "-1" : std::to_string(2 + random.below(4))) + "\n";
    default:
      return "f " + name + " 0 0 " + place() + " " + time() + "\n";
  }
}

// A clause that is accepted is true for all paths; most that are true for all are accepted.
TEST(Rules, OneAgentAgreesWithEnumeration) {
  constexpr int kSteps = 6;
  int num_accepted = 0, num_missed = 0;
  for (std::uint64_t seed = 0; seed < scaled(400); ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Instance instance =
        random.percent(50) ? grid("../..", {{0, 3}, {1, 2}}) : grid(".../.@.", {{0, 2}, {2, 3}});
    Checker checker(instance);
    checker.check({'i', {2, 0}});
    std::string text;
    constexpr int kVariables = 6;
    for (int v = 1; v <= kVariables; ++v) {
      const std::string line = random_literal_of(random, v, kSteps, 4);
      for (const Record& record : records_of("qcert 1 text\n" + line)) checker.check(record);
      text += line;
    }
    for (int trial = 0; trial < 8; ++trial) {
      Ints clause;
      for (int v = 1; v <= kVariables; ++v)
        if (random.percent(60)) clause.push_back(random.percent(85) ? -v : v);
      bool is_true = true;
      std::vector<int> path{instance.agents()[0].start};
      for_each_path(instance, path, kSteps, [&](const std::vector<int>& whole) {
        if (!is_true || whole.back() != instance.agents()[0].goal) return;
        const Interpretation plan(checker.meanings(), {whole, {instance.agents()[1].goal}});
        const auto may_be_false = [&](Int lit) {
          const Variable& x = checker.meanings().variable(lit);
          if (x.agent == 0) return !plan.is_true(lit);
          if (lit > 0) return true;  // the other one may come late
          for (std::size_t t = static_cast<std::size_t>(x.number); t <= kSteps; ++t)
            if (whole[t] == instance.agents()[1].goal) return false;
          return true;
        };
        is_true = !std::all_of(clause.begin(), clause.end(), may_be_false);
      });
      Distances distances(instance);
      const bool is_accepted = OneAgent(instance, checker.meanings(), distances).holds(0, clause);
      // Paths that cost more than the steps were not looked at.
      const bool has_cap = std::any_of(clause.begin(), clause.end(), [&](Int lit) {
        const Variable& x = checker.meanings().variable(lit);
        return lit < 0 && x.kind == Variable::Kind::costs_at_most && x.agent == 0;
      });
      if (is_accepted) {
        ASSERT_TRUE(is_true) << text;
      }
      num_accepted += is_accepted ? 1 : 0;
      num_missed += is_true && has_cap && !is_accepted ? 1 : 0;
    }
  }
  EXPECT_GT(num_accepted, 0);
  EXPECT_LE(num_missed, num_accepted / 5);  // stretches are looked at one by one
}

// ---- counters and cores -------------------------------------------------------------------------

/// Three agents that may cost up to two more than their four steps, each on a lane of its own.
const Instance kLanes = grid("...../...../.....", {{0, 4}, {5, 9}, {10, 14}});

/// All plans as far as costs matter.
std::vector<std::vector<std::vector<int>>> all_plans() {
  std::vector<std::vector<std::vector<int>>> plans;
  for (int k = 0; k < 27; ++k) {
    std::vector<std::vector<int>> paths;
    for (int agent = 0, rest = k; agent < 3; ++agent, rest /= 3) {
      std::vector<int> path(static_cast<std::size_t>(rest % 3 + 1), 5 * agent);
      for (int x = 1; x < 5; ++x) path.push_back(5 * agent + x);
      paths.push_back(path);
    }
    plans.push_back(paths);
  }
  return plans;
}

// Random counters over costs and over each other. What the rules accept, and what the ledger says
// plans cost, is true in all plans in which all cores that were paid are.
TEST(Rules, CountersAndCoresAgreeWithEnumeration) {
  int num_sums = 0, num_orders = 0, num_paid = 0, num_excesses = 0;
  for (std::uint64_t seed = 0; seed < scaled(1500); ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    Checker checker(kLanes);
    Meanings& meanings = const_cast<Meanings&>(checker.meanings());
    Ledger ledger(kLanes, meanings);
    auto plans = all_plans();
    Ints units;  // literals
    Int variable = 0, node = 0;
    const auto add_node = [&](Ints values) {
      values.insert(values.begin(), node);
      meanings.add_node({'n', values});
      return node++;
    };
    for (Int agent = 0; agent < 3; ++agent)
      for (Int cost = 4; cost < 6; ++cost) {
        meanings.add_variable({'c', {++variable, agent, cost}});
        units.push_back(-variable);
      }
    Ints sums;
    for (int step = 0; step < 6; ++step) {
      // A core: a random part of the units. Plans in which it is false are none any more.
      Ints core;
      for (const Int lit : units)
        if (random.percent(30)) core.push_back(lit);
      if (core.size() < 2) continue;
      auto left = plans;
      left.erase(std::remove_if(left.begin(), left.end(),
                                [&](const auto& paths) {
                                  return !Interpretation(meanings, paths).is_true(core);
                                }),
                 left.end());
      if (left.empty()) continue;
      Int sum = add_node({0, core[0]});
      for (std::size_t k = 1; k < core.size(); ++k) {
        const Int leaf = add_node({0, core[k]});
        sum = add_node({3, sum, leaf});
      }
      for (Int k = 1; k <= static_cast<Int>(core.size()); ++k) {
        meanings.add_variable({'s', {++variable, sum, k}});
        units.push_back(variable);
      }
      sums.push_back(sum);
      try {
        ledger.pay(core, random.percent(80) ? sum : -1);
        plans = left;
        ++num_paid;
      } catch (const Rejected&) {
        continue;  // some of them were paid
      }
      for (int trial = 0; trial < 6; ++trial) {
        Ints guess;
        for (int k = 0; k < 3; ++k) {
          const Int lit = random.pick(units);
          guess.push_back(random.percent(50) ? lit : -lit);
        }
        const Ints pair(guess.begin(), guess.begin() + 2);
        for (const auto& paths : all_plans()) {
          const Interpretation plan(meanings, paths);
          ASSERT_TRUE(!is_sum(meanings, guess) || plan.is_true(guess));
          ASSERT_TRUE(!is_order(meanings, pair) || plan.is_true(pair));
        }
        num_sums += is_sum(meanings, guess) ? 1 : 0;
        num_orders += is_order(meanings, pair) ? 1 : 0;
      }
      for (const auto& paths : plans) {
        const Interpretation plan(meanings, paths);
        ASSERT_GE(plan.cost(0) + plan.cost(1) + plan.cost(2), ledger.lower());
        for (const Int a : sums)
          for (const Int b : sums)
            ASSERT_TRUE(!meanings.is_at_most(a, b) || plan.value(a) <= plan.value(b));
      }
    }
    // What is left open, as far as the ledger agrees.
    Int excess = -1;
    const auto count = [&](Int leaf) { excess = excess < 0 ? leaf : add_node({3, excess, leaf}); };
    for (Int agent = 0; agent < 3; ++agent)
      if (random.percent(70)) count(add_node({1, agent, static_cast<Int>(4 + random.below(3))}));
    for (const Int sum : sums)
      if (random.percent(60)) count(add_node({2, sum, static_cast<Int>(random.between(1, 2))}));
    if (excess < 0) continue;
    const Int base = ledger.lower();
    try {
      ledger.count_excess(excess);
    } catch (const Rejected&) {
      continue;
    }
    ++num_excesses;
    for (const auto& paths : plans) {
      const Interpretation plan(meanings, paths);
      ASSERT_GE(plan.cost(0) + plan.cost(1) + plan.cost(2), base + plan.value(excess));
    }
  }
  EXPECT_GT(num_sums, 0);
  EXPECT_GT(num_orders, 0);
  EXPECT_GT(num_paid, 0);
  EXPECT_GT(num_excesses, 0);
}

TEST(Rules, CoresArePaidOnce) {
  const std::string costs = "c 1 0 4\nc 2 1 4\nc 3 0 5\nc 4 0 3\n";
  // That one of two costs more is no axiom of lanes that are apart: the ledger is asked alone.
  Checker checker(kLanes);
  Meanings& meanings = const_cast<Meanings&>(checker.meanings());
  for (const Record& record :
       records_of("qcert 1 text\n" + costs + "n 0 0 -1\nn 1 0 -2\nn 2 3 0 1\ns 5 2 2\ns 6 2 1\n"))
    record.tag == 'n' ? meanings.add_node(record) : meanings.add_variable(record);
  Ledger ledger(kLanes, meanings);
  EXPECT_THROW(ledger.pay({5}, -1), Rejected);   // nobody opened it
  EXPECT_THROW(ledger.pay({-4}, -1), Rejected);  // every plan costs that
  EXPECT_THROW(ledger.pay({1}, -1), Rejected);   // that somebody costs no more
  EXPECT_THROW(ledger.pay({}, -1), Rejected);
  EXPECT_EQ(ledger.lower(), 12);
  Ledger wrong(kLanes, meanings);
  EXPECT_THROW(wrong.pay({-1, -3}, 2), Rejected);  // the counter counts something else
  ledger.pay({-1, -2}, 2);
  EXPECT_EQ(ledger.lower(), 13);
  EXPECT_THROW(ledger.pay({-1}, -1), Rejected);  // paid
  EXPECT_THROW(ledger.pay({6}, -1), Rejected);   // that there is one was paid
  EXPECT_THROW(ledger.pay({-5}, -1), Rejected);  // that there are not two
  ledger.pay({5}, -1);
  EXPECT_THROW(ledger.pay({5}, -1), Rejected);
  EXPECT_EQ(ledger.lower(), 14);
}

// Node 3 is what node 2 has, not that variable 2 is true.
TEST(Rules, TheCounterOfACoreCountsItsLiterals) {
  Checker checker(kLanes);
  Meanings& meanings = const_cast<Meanings&>(checker.meanings());
  for (const Record& record :
       records_of("qcert 1 text\nc 1 0 4\nc 5 1 4\nc 6 2 4\nn 0 0 -1\nn 1 0 -5\nn 2 3 0 1\n"
                  "s 2 2 2\nn 3 2 2 0\nn 4 0 -6\nn 5 3 3 4\nn 6 0 2\nn 7 3 6 4\n"))
    record.tag == 'n' ? meanings.add_node(record) : meanings.add_variable(record);
  for (const Int node : {5, 7}) {
    Ledger ledger(kLanes, meanings);
    ledger.pay({-1, -5}, 2);
    if (node == 5)
      EXPECT_THROW(ledger.pay({2, -6}, node), Rejected);
    else
      EXPECT_NO_THROW(ledger.pay({2, -6}, node));
  }
}

TEST(Rules, TheExcessCountsOpenUnitsOnce) {
  Checker checker(kLanes);
  Meanings& meanings = const_cast<Meanings&>(checker.meanings());
  // Nodes: 2 says how many of agents 0 and 1 cost more than 4; 3 to 6 what agents cost beyond
  // something; 7 and 12 what 2 says beyond 1; 9, 10, 11 and 13 are sums of two.
  for (const Record& record : records_of(
           "qcert 1 text\nc 1 0 4\nc 2 1 4\nn 0 0 -1\nn 1 0 -2\nn 2 3 0 1\ns 5 2 2\nn 3 1 0 4\n"
           "n 4 1 0 5\nn 5 1 1 4\nn 6 1 2 3\nn 7 2 2 1\nn 8 0 -1\nn 9 3 3 4\nn 10 3 4 5\n"
           "n 11 3 7 7\nn 12 4 2 0 2\nn 13 3 7 12\ns 6 10 1\ns 7 9 1\n"))
    record.tag == 'n' ? meanings.add_node(record) : meanings.add_variable(record);
  const auto counts = [&](Int node, const std::vector<std::vector<Int>>& paid) {
    Ledger ledger(kLanes, meanings);
    for (const auto& core : paid) ledger.pay(core, core.size() == 2 ? 2 : -1);
    try {
      ledger.count_excess(node);
    } catch (const Rejected&) {
      return false;
    }
    EXPECT_THROW(ledger.count_excess(node), Rejected);
    EXPECT_THROW(ledger.pay({-1}, -1), Rejected);
    return true;
  };
  EXPECT_TRUE(counts(3, {}));
  EXPECT_TRUE(counts(10, {}));
  EXPECT_FALSE(counts(9, {}));  // an agent twice
  EXPECT_FALSE(counts(6, {}));  // what it costs anyway
  EXPECT_FALSE(counts(7, {}));  // nobody opened it
  EXPECT_FALSE(counts(12, {}));
  EXPECT_FALSE(counts(8, {}));      // no number of units
  EXPECT_FALSE(counts(3, {{-1}}));  // paid
  EXPECT_TRUE(counts(4, {{-1}}));
  EXPECT_FALSE(counts(10, {{-2}}));
  const std::vector<Int> core{-1, -2};
  EXPECT_TRUE(counts(7, {core}));
  EXPECT_TRUE(counts(12, {core}));
  EXPECT_FALSE(counts(11, {core}));  // a unit twice
  EXPECT_FALSE(counts(13, {core}));
  EXPECT_FALSE(counts(7, {core, {5}}));  // paid
  EXPECT_FALSE(counts(12, {core, {5}}));

  const Ledger ledger(kLanes, meanings);
  EXPECT_EQ(ledger.bound(Ints{-1}, false), 13);
  EXPECT_EQ(ledger.bound(Ints{6}, false), 13);
  EXPECT_THROW(static_cast<void>(ledger.bound(Ints{7}, false)), Rejected);  // an agent twice
  EXPECT_THROW(static_cast<void>(ledger.bound(Ints{1}, false)), Rejected);
  EXPECT_THROW(static_cast<void>(ledger.bound(Ints{-1, 5}, false)), Rejected);
  EXPECT_THROW(static_cast<void>(ledger.bound(Ints{6}, true)), Rejected);
  EXPECT_THROW(static_cast<void>(ledger.bound(Ints{}, false)), Rejected);
}

TEST(Rules, PlansAreReplayed) {
  // Two change places on a ring of six.
  const Instance ring = grid(".../...", {{0, 1}, {1, 0}});
  const auto refusal = [&](const std::string& first, const std::string& second) {
    return ask(ring, "qcert 1 text\ni 2 0\nq 2 0\n" + first + "\n" + second + "\n").reason;
  };
  EXPECT_EQ(refusal("p 0 0 1", "p 1 1 4 3 0"), "");
  EXPECT_NE(refusal("p 0 0 1", "p 1 1 0").find("swap"), std::string::npos);
  EXPECT_NE(refusal("p 0 0 0 1", "p 1 1 1 0").find("swap"), std::string::npos);
  EXPECT_NE(refusal("p 0 0 1", "p 1 1 1 4 3 0").find("one place"), std::string::npos);
  EXPECT_NE(refusal("p 0 0 1", "p 1 1 4 0").find("jumps"), std::string::npos);
  EXPECT_NE(refusal("p 0 0 1", "p 1 1 4 3").find("goal"), std::string::npos);
  EXPECT_NE(refusal("p 0 0 1", "p 1 4 3 0").find("start"), std::string::npos);
  EXPECT_NE(refusal("p 0 0 1", "p 1").find("start"), std::string::npos);
  EXPECT_NE(refusal("p 0 0 1", "p 1 1 7 0").find("no such place"), std::string::npos);
  EXPECT_NE(refusal("p 0 0 1", "p 2 1 4 3 0").find("no such agent"), std::string::npos);
  EXPECT_NE(refusal("p 0 0 1", "p 0 0 1").find("two paths"), std::string::npos);
  EXPECT_NE(refusal("p 0 0 1", "").find("no path"), std::string::npos);
}

TEST(Rules, VariablesAndNodesAreOfWhatThereIs) {
  const std::string sum = "c 1 0 4\nc 2 1 4\nn 0 0 -1\nn 1 0 -2\nn 2 3 0 1\n";
  for (const char* good :
       {"f 3 0 0 0 0", "f 3 0 1 0 1 0", "f 3 0 2 0 3 -1", "f 3 0 3 0 0 1 1", "x 3 0 0 0", "s 3 2 1",
        "n 3 1 0 4", "n 3 2 2 0", "n 3 4 2 0 2", "n 3 4 2 0 2 2", "c 2147483647 0 4"})
    EXPECT_TRUE(accepts(kLane, sum + good + "\n")) << good;
  for (const char* bad :
       {// Agents, places, times.
        "f 3 2 0 0 0", "f 3 -1 0 0 0", "f 3 0 0 10 0", "f 3 0 0 -1 0", "f 3 0 0 0 -1",
        "f 3 0 0 0 268435456", "c 3 2 4", "c 3 0 -1", "x 3 2 0 0", "x 3 0 10 0", "x 3 0 0 -1",
        "f 3 0 1 0 2 0", "f 3 0 2 0 3 2", "f 3 0 2 0 -1 -1",
        // Shorter, longer, of another kind.
        "f 3 0 0 0", "f 3 0 0 0 0 0", "f 3 0 1 0 1", "f 3 0 2 0 3", "f 3 0 3 0 0 0", "f 3 0 4 0 0",
        "c 3 0", "c 3 0 4 4", "x 3 0 0", "s 3 2", "n 3 1 0", "n 3 0 -1 0", "n 3 5 0 4",
        "n 3 -1 0 4",
        // Numbers of variables and nodes.
        "c 0 0 4", "c -3 0 4", "c 2147483648 0 4", "c 1 0 5", "n 4 1 0 4", "n 2 1 0 4", "n 3 0 -3",
        "n 3 1 2 4", "n 3 1 0 -1", "n 3 1 0 268435456", "n 3 3 0 3", "n 3 3 -1 0",
        // What is no sum, or not in order.
        "s 3 0 1", "s 3 2 0", "s 3 2 268435456", "s 3 3 1", "n 3 2 0 1", "n 3 4 2 0 0", "n 3 4 2 0",
        "n 3 4 1 0 2", "n 3 3 0 0\nn 4 4 2 0 3 2", "n 3 4 2 -1 2"})
    EXPECT_FALSE(accepts(kLane, sum + bad + "\n")) << bad;
}

// ---- hints --------------------------------------------------------------------------------------

TEST(Rules, DerivedClausesNeedTheirHints) {
  Clauses clauses;
  clauses.add(Ints{1, 2});
  clauses.add(Ints{-2, 3});
  clauses.add(Ints{-3, 4});
  EXPECT_TRUE(clauses.implied(Ints{1, 4}, Ints{3, 2, 1}));
  EXPECT_FALSE(clauses.implied(Ints{1, 4}, Ints{3, 2}));     // one is missing
  EXPECT_FALSE(clauses.implied(Ints{1, 4}, Ints{2, 3, 1}));  // in another order
  EXPECT_FALSE(clauses.implied(Ints{4}, Ints{3, 2, 1}));
  EXPECT_TRUE(clauses.implied(Ints{1, -1}, Ints{}));
  EXPECT_THROW(static_cast<void>(clauses.implied(Ints{1, 4}, Ints{0})), Rejected);
  EXPECT_THROW(static_cast<void>(clauses.implied(Ints{1, 4}, Ints{4})), Rejected);
  clauses.remove(2);
  EXPECT_THROW(static_cast<void>(clauses.implied(Ints{1, 4}, Ints{3, 2, 1})), Rejected);
  EXPECT_THROW(clauses.remove(2), Rejected);
}

}  // namespace
}  // namespace quadrille_check::support
