// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "quadrille/core/random.hpp"
#include "quadrille/sat/cost_search.hpp"

namespace quadrille::sat {
namespace {

constexpr std::size_t kAgents = 6;
constexpr int kMaxCost = 3;

/// Some agent of `dear` costs more than the number beside it, or one of `cheap` does not.
struct Rule {
  std::vector<std::pair<std::size_t, int>> dear, cheap;
};

/// Rules that hold when everybody costs as much as possible.
std::vector<Rule> random_rules(Random& random) {
  std::vector<Rule> rules(10 + random.below(10));
  const auto some = [&] {
    return std::pair(random.below(kAgents), static_cast<int>(random.below(kMaxCost)));
  };
  for (Rule& rule : rules) {
    for (std::size_t k = 1 + random.below(2); k > 0; --k) rule.dear.push_back(some());
    for (std::size_t k = random.below(3); k > 0; --k) rule.cheap.push_back(some());
  }
  return rules;
}

/// What plans pay in which the agent costs no more than `cost`.
struct Charge {
  std::size_t agent;
  int cost;
  Cost amount;
};

std::vector<Charge> random_charges(Random& random) {
  std::vector<Charge> charges(1 + random.below(4));
  for (Charge& charge : charges)
    charge = {random.below(kAgents), static_cast<int>(random.below(kMaxCost)),
              static_cast<Cost>(1 + random.below(4))};
  return charges;
}

template <class Costs>
Cost charged(const std::vector<Charge>& charges, const Costs& costs) {
  Cost sum = 0;
  for (const Charge& charge : charges)
    if (costs[charge.agent] <= charge.cost) sum += charge.amount;
  return sum;
}

Cost cheapest_by_enumeration(const std::vector<Rule>& rules,
                             const std::vector<Charge>& charges = {}) {
  Cost best = kAgents * kMaxCost + 100;
  std::vector<int> cost(kAgents, 0);
  while (true) {
    const bool works = std::all_of(rules.begin(), rules.end(), [&](const Rule& rule) {
      return std::any_of(rule.dear.begin(), rule.dear.end(),
                         [&](const auto& d) { return cost[d.first] > d.second; }) ||
             std::any_of(rule.cheap.begin(), rule.cheap.end(),
                         [&](const auto& c) { return cost[c.first] <= c.second; });
    });
    Cost sum = 0;
    for (const int c : cost) sum += c;
    sum += charged(charges, cost);
    if (works) best = std::min(best, sum);
    std::size_t i = 0;
    while (i < kAgents && cost[i] == kMaxCost) cost[i++] = 0;
    if (i == kAgents) return best;
    ++cost[i];
  }
}

/// The rules as clauses, and the plans that are their models.
class RulesProblem final : public CostProblem, public Bounds {
 public:
  RulesProblem(Engine& engine, const std::vector<Rule>& rules, int max_cost = kMaxCost,
               std::vector<Charge> charges = {})
      : engine_(engine),
        max_cost_(static_cast<std::size_t>(max_cost)),
        above_(kAgents),
        charges_(std::move(charges)) {
    for (std::vector<Lit>& lits : above_)
      while (lits.size() <= max_cost_) add_literal(lits);
    for (const Rule& rule : rules) {
      std::vector<Lit> clause;
      for (const auto& [agent, cost] : rule.dear) clause.push_back(above(agent, cost));
      for (const auto& [agent, cost] : rule.cheap) clause.push_back(~above(agent, cost));
      engine_.add_clause({why::Vertex{}, clause, {}, false});
    }
    for (const Charge& charge : charges_) {
      fees_.push_back({engine_.new_lit(), charge.amount});
      const std::vector<Lit> clause{fees_.back().due, above(charge.agent, charge.cost)};
      engine_.add_clause({why::Vertex{}, clause, {}, false});
    }
  }

  std::span<const Fee> fees() const override { return fees_; }
  std::size_t num_agents() const override { return kAgents; }
  Cost free_cost(AgentId) const override { return 0; }
  bool grow_to(AgentId, Cost, LimitMonitor&) override { return true; }
  Lit cost_above(AgentId agent, Cost cost) override {
    while (above_[agent.index()].size() <= static_cast<std::size_t>(cost))
      add_literal(above_[agent.index()]);
    return above(agent.index(), static_cast<int>(cost));
  }
  Cost lower_bound() const override { return 0; }
  bool assume_at_most(Cost, LimitMonitor&, std::vector<Lit>&) override { return false; }
  Cost next_bound(Cost, std::span<const Lit>) override { return 0; }
  void on_solve(bool) override {}
  bool accept_model() override {
    accepted_.assign(kAgents, 0);
    for (std::size_t i = 0; i < kAgents; ++i)
      for (std::size_t c = 0; c < max_cost_; ++c)
        accepted_[i] += engine_.model_value(above_[i][c]) ? 1 : 0;
    return true;
  }

  std::optional<Cost> upper() const override {
    if (best_.empty()) return std::nullopt;
    return std::accumulate(best_.begin(), best_.end(), charged(charges_, best_));
  }
  Cost incumbent_cost_of(AgentId agent) const override { return best_[agent.index()]; }
  void offer_accepted() override {
    EXPECT_TRUE(best_.empty() || accepted() < upper())
        << "all plans that are asked for are cheaper";
    best_ = accepted_;
    ++num_taken;
  }
  /// The rules allow it.
  void take_costliest() { best_.assign(kAgents, kMaxCost); }
  Cost accepted() const {
    return std::accumulate(accepted_.begin(), accepted_.end(), charged(charges_, accepted_));
  }
  int num_taken = 0;

 private:
  Lit above(std::size_t agent, int cost) const {
    return above_[agent][static_cast<std::size_t>(cost)];
  }
  void add_literal(std::vector<Lit>& lits) {
    lits.push_back(engine_.new_lit());
    const std::vector<Lit> never{~lits.back()};
    if (lits.size() > max_cost_) engine_.add_clause({why::Order{}, never, {}, false});
    if (lits.size() < 2) return;
    const std::vector<Lit> order{~lits.back(), lits[lits.size() - 2]};
    engine_.add_clause({why::Order{}, order, {}, false});
  }

  Engine& engine_;
  const std::size_t max_cost_;
  std::vector<std::vector<Lit>> above_;
  const std::vector<Charge> charges_;
  std::vector<Fee> fees_;
  std::vector<Cost> accepted_, best_;
};

/// Sees that the lower bound never falls.
class WatchedBounds final : public YieldPoint {
 public:
  explicit WatchedBounds(const Bounds& bounds) : bounds_(bounds) {}
  void yield() override {
    EXPECT_GE(bounds_.lower(), last_);
    last_ = bounds_.lower();
  }

 private:
  const Bounds& bounds_;
  Cost last_ = 0;
};

struct Answer {
  Cost cost = 0, lower_bound = 0;
  int num_from_above = 0;
  std::int64_t num_cores = 0;
};

/// Share 0: from below only. `has_plan`: the search starts with a dear one.
Answer solve_rules(const std::vector<Rule>& rules, int passes, std::int64_t share, bool has_plan,
                   std::int64_t head_start = 1, bool raise_cores = false,
                   const std::vector<Charge>& charges = {}) {
  EngineOptions engine_options;
  engine_options.keep_clauses = true;
  Engine engine(nullptr, engine_options);
  RulesProblem problem(engine, rules, kMaxCost, charges);
  LimitMonitor limits{Limits{}};
  Statistics statistics;
  CoreGuidedOptions options;
  options.from_above = share > 0;
  if (share > 0 && has_plan) problem.take_costliest();
  Settings settings;
  settings.core_turn = 1;
  settings.core_passes = passes;
  settings.above_share = std::max<std::int64_t>(1, share);
  settings.core_head_start = head_start;
  options.raise_cores = raise_cores;
  WatchedBounds watch(problem);
  const SearchEnd end =
      search_by_cores({engine, problem, problem, limits, watch, settings}, options, statistics);
  const bool found = end == SearchEnd::found;
  EXPECT_TRUE(found || problem.are_closed()) << "the search ends with a proof";
  return {found ? problem.accepted() : problem.upper().value_or(-1), problem.lower(),
          problem.num_taken - (found ? 1 : 0),  // from below comes the last one
          statistics.cores};
}

// From below alone, and in turns with searches from above.
TEST(CoreGuidedSearch, FeesArePartOfTheCost) {
  Random random(5);
  int num_dearer = 0;
  for (int round = 0; round < 400; ++round) {
    const std::vector<Rule> rules = random_rules(random);
    const std::vector<Charge> charges = random_charges(random);
    const Cost expected = cheapest_by_enumeration(rules, charges);
    num_dearer += expected > cheapest_by_enumeration(rules) ? 1 : 0;
    const std::int64_t share = round % 2 == 0 ? 0 : 5;
    const Answer answer =
        solve_rules(rules, 1 + round % 3, share, round % 4 == 1, 1, round % 5 == 0, charges);
    ASSERT_EQ(answer.cost, expected) << round;
    ASSERT_EQ(answer.lower_bound, expected) << round;
  }
  EXPECT_GT(num_dearer, 100);
}

TEST(CoreGuidedSearch, ALongHeadStartLeavesNothingToTheSearchFromAbove) {
  Random random(1);
  int num_from_above = 0;
  for (int round = 0; round < 100; ++round) {
    const std::vector<Rule> rules = random_rules(random);
    num_from_above += solve_rules(rules, 1, 5, false).num_from_above;
    const Answer answer = solve_rules(rules, 1, 5, false, 1000);
    EXPECT_EQ(answer.cost, cheapest_by_enumeration(rules));
    EXPECT_EQ(answer.num_from_above, 0);
  }
  EXPECT_GE(num_from_above, 1) << "it is the head start";
}

TEST(CoreGuidedSearch, FindsTheLeastCostFromBelowAndFromAbove) {
  Random random(1);
  int num_from_above = 0, num_improved = 0;
  for (int round = 0; round < 300; ++round) {
    SCOPED_TRACE(round);
    const std::vector<Rule> rules = random_rules(random);
    const Cost least = cheapest_by_enumeration(rules);
    for (const int passes : {1, 2, 5})
      for (const std::int64_t share : {0, 1, 5})
        for (const bool has_plan : {false, true}) {
          const Answer answer = solve_rules(rules, passes, share, has_plan);
          EXPECT_EQ(answer.cost, least);
          EXPECT_EQ(answer.lower_bound, least);
          if (share > 0 && answer.num_from_above > 0) ++(has_plan ? num_improved : num_from_above);
        }
  }
  EXPECT_GE(num_from_above, 30) << "plans come from above as well";
  EXPECT_GE(num_improved, 30) << "so do better ones than the first";
}

TEST(CoreGuidedSearch, PaysForSeveralUnitsAtOnce) {
  Random random(2);
  int num_raised = 0;
  for (int round = 0; round < 300; ++round) {
    SCOPED_TRACE(round);
    const std::vector<Rule> rules = random_rules(random);
    const Cost least = cheapest_by_enumeration(rules);
    for (const int passes : {1, 3})
      for (const std::int64_t share : {0, 2})
        for (const bool has_plan : {false, true}) {
          const Answer answer = solve_rules(rules, passes, share, has_plan, 1, true);
          EXPECT_EQ(answer.cost, least);
          EXPECT_EQ(answer.lower_bound, least);
          if (share == 0 && passes == 1 && answer.num_cores < least) ++num_raised;
        }
  }
  EXPECT_GE(num_raised, 300) << "in half of the searches";
}

/// Units that some pairs of agents, and some agents, have to be violated by.
TEST(CoreGuidedSearch, LongDelaysTakeFewCores) {
  Engine engine(nullptr);
  RulesProblem problem(engine, {}, 1000);
  const auto add = [&](std::vector<std::pair<std::size_t, Cost>> least) {
    std::vector<Lit> clause;
    for (const auto& [agent, cost] : least)
      clause.push_back(problem.cost_above(AgentId(agent), cost - 1));
    engine.add_clause({why::Vertex{}, clause, {}, false});
  };
  add({{0, 300}, {1, 170}});
  add({{1, 60}, {2, 90}});
  add({{2, 45}, {3, 70}, {4, 80}});
  add({{5, 33}});
  LimitMonitor limits{Limits{}};
  Statistics statistics;
  CoreGuidedOptions options;
  options.raise_cores = true;
  WatchedBounds watch(problem);
  EXPECT_EQ(search_by_cores({engine, problem, problem, limits, watch, {}}, options, statistics),
            SearchEnd::found);
  EXPECT_EQ(problem.accepted(), 170 + 45 + 33);
  EXPECT_EQ(problem.lower(), 170 + 45 + 33);
  EXPECT_LE(statistics.cores, 10) << "it takes 248 one by one";
}

using Agents = std::vector<std::size_t>;

/// The core clauses of a search, each as the sorted agents that it names.
class CoreObserver final : public ClauseObserver {
 public:
  explicit CoreObserver(const std::vector<Lit>& above) : above_(above) {}
  void on_lemma(const Lemma& lemma) override {
    if (!lemma.is<why::Core>()) return;
    Agents agents;
    for (const Lit lit : lemma.clause)
      agents.push_back(
          static_cast<std::size_t>(std::find(above_.begin(), above_.end(), lit) - above_.begin()));
    std::sort(agents.begin(), agents.end());
    cores.push_back(agents);
  }
  void on_learned(std::span<const Lit>) override {}
  std::vector<Agents> cores;

 private:
  const std::vector<Lit>& above_;  // by agent
};

/// The first core that the search takes of one with two minimal parts, all agents together. Unit
/// propagation sees the whole only, because auxiliary literals hide the parts. One agent is in
/// both.
Agents first_core(const std::vector<Agents>& parts) {
  std::vector<Lit> above;
  CoreObserver observer(above);
  EngineOptions engine_options;
  engine_options.observer = &observer;
  Engine engine(nullptr, engine_options);
  RulesProblem problem(engine, {});
  LimitMonitor limits{Limits{}};
  for (const AgentId i : IdRange<AgentId>(kAgents)) above.push_back(problem.cost_above(i, 0));
  const auto add = [&](const Agents& agents, std::vector<Lit> hidden_by) {
    std::vector<Lit> clause = std::move(hidden_by);
    for (const std::size_t i : agents) clause.push_back(above[i]);
    engine.add_clause({why::Vertex{}, clause, {}, false});
  };
  for (const Agents& part : parts) {
    const Lit a = engine.new_lit(), b = engine.new_lit();
    for (const Lit c : {a, ~a})
      for (const Lit d : {b, ~b}) add(part, {c, d});
  }
  add({0, 1, 2, 3, 4, 5}, {});
  Statistics statistics;
  WatchedBounds watch(problem);
  EXPECT_EQ(search_by_cores({engine, problem, problem, limits, watch, {}}, {}, statistics),
            SearchEnd::found);
  EXPECT_EQ(problem.accepted(), 1) << "of the agent in both parts";
  return observer.cores.at(0);
}

TEST(CoreGuidedSearch, RelaxesAMinimalPartOfACore) {
  const std::vector<Agents> parts{{0, 1, 2}, {2, 3, 4, 5}}, others{{3, 4, 5}, {0, 1, 2, 3}};
  for (const auto& both : {parts, others}) {
    const Agents core = first_core(both);
    EXPECT_TRUE(core == both[0] || core == both[1]);
  }
}

}  // namespace
}  // namespace quadrille::sat
