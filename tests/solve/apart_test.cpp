// SPDX-License-Identifier: MIT
// Groups of agents that have nothing to do with each other are solved apart, in both domains: what
// is found out of several instances side by side is what is found out of each of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "continuous/support/random_instance.hpp"
#include "continuous/support/roads.hpp"
#include "faults/instances.hpp"
#include "quadrille/continuous/verify.hpp"
#include "quadrille/discrete/verify.hpp"
#include "support/attribution_check.hpp"
#include "support/environment.hpp"

namespace quadrille::support {
namespace {

/// Whose agent is which: (part, agent of the part) by agent of the whole. The parts take turns, so
/// that no agent but the first ones keeps its number.
using Names = std::vector<std::pair<std::size_t, AgentId>>;

template <class Instance>
Names names_of(const std::vector<Instance>& parts) {
  std::size_t most = 0;
  for (const Instance& part : parts) most = std::max(most, part.num_agents());
  Names names;
  for (std::size_t k = 0; k < most; ++k)
    for (std::size_t p = 0; p < parts.size(); ++p)
      if (k < parts[p].num_agents()) names.emplace_back(p, AgentId(k));
  return names;
}

Goals moved(const Goals& goals, std::size_t by) {
  std::vector<VertexId> all;
  for (const VertexId v : goals.vertices()) all.push_back(VertexId(v.index() + by));
  return Goals(std::move(all));
}

struct Grids {
  using Instance = discrete::Instance;
  using Options = discrete::SolveOptions;
  using Outcome = discrete::SolveOutcome;
  using Plan = discrete::Plan;

  static Instance small(std::uint32_t seed) {
    Random random(seed);
    Instance instance = discrete::support::random_grid(random, {2, 4, 30, 1, 3});
    return seed % 4 == 0 ? discrete::support::with_more_goals(random, instance) : instance;
  }
  static Instance hard() { return grid(12, 60, 1); }

  static Instance side_by_side(const std::vector<Instance>& parts) {
    std::vector<discrete::Graph::Edge> edges;
    std::vector<std::size_t> first;
    std::size_t num_vertices = 0;
    for (const Instance& part : parts) {
      first.push_back(num_vertices);
      for (const VertexId v : IdRange<VertexId>(part.graph().num_vertices()))
        for (const VertexId w : part.graph().neighbours(v))
          if (v < w) edges.emplace_back(num_vertices + v.index(), num_vertices + w.index());
      num_vertices += part.graph().num_vertices();
    }
    std::vector<discrete::Agent> agents;
    for (const auto& [p, i] : names_of(parts)) {
      const discrete::Agent& agent = parts[p].agents()[i];
      agents.push_back({VertexId(agent.start.index() + first[p]), moved(agent.goals, first[p])});
    }
    return Instance::make(discrete::Graph::make(num_vertices, edges).value(), std::move(agents))
        .value();
  }
  static Instance of(const Instance& instance, const std::vector<AgentId>& agents) {
    std::vector<discrete::Agent> kept;
    for (const AgentId i : agents) kept.push_back(instance.agents()[i]);
    return instance.with_agents(std::move(kept)).value();
  }
  static Cost cost(const Plan& plan, Objective objective) { return plan.cost(objective); }
  static bool is_valid(const Instance& instance, const Plan& plan) {
    return discrete::verify(instance, plan).valid();
  }
  static void by_clauses(Options& options) { options.first_plan = false; }
};

struct Roadmaps {
  using Instance = continuous::Instance;
  using Options = continuous::SolveOptions;
  using Outcome = continuous::SolveOutcome;
  using Plan = continuous::Plan;

  static Instance small(std::uint32_t seed) {
    continuous::test::RandomOptions options;
    options.shapes_percent = options.no_waiting_percent = 0;  // roadmaps are put side by side
    options.num_vertices = 3 + seed % 4;
    options.num_agents = 1 + seed / 4 % 3;
    options.edge_percent = 50 + static_cast<int>(seed % 3) * 20;
    options.max_radius = 7;
    options.space_percent = 0;
    options.obstacles_percent = 0;
    options.goal_sets_percent = seed % 4 == 0 ? 30 : 0;
    return continuous::test::random_instance(7'000'000 + seed, options);
  }
  static Instance hard() { return discs(60, 20, 4); }

  static Instance side_by_side(const std::vector<Instance>& parts) {
    std::vector<geometry::Point> points;
    std::vector<continuous::Edge> edges;
    std::vector<std::size_t> first;
    geometry::Length left = 0;
    for (const Instance& part : parts) {
      first.push_back(points.size());
      geometry::Length right = left;
      for (const continuous::Edge& e : part.roadmap().edges()) {
        edges.push_back(e);
        edges.back().from = VertexId(e.from.index() + points.size());
        edges.back().to = VertexId(e.to.index() + points.size());
      }
      for (geometry::Point at : part.roadmap().positions()) {
        at.x = at.x + left;
        right = std::max(right, at.x);
        points.push_back(at);
      }
      left = right + kApart;
    }
    std::vector<continuous::Agent> agents;
    for (const auto& [p, i] : names_of(parts)) {
      agents.push_back(parts[p].agent(i));
      agents.back().start = VertexId(agents.back().start.index() + first[p]);
      agents.back().goals = moved(agents.back().goals, first[p]);
    }
    return Instance::make(continuous::Roadmap::make(std::move(points), std::move(edges)).value(),
                          std::move(agents), parts.front().resolution())
        .value();
  }
  static Instance of(const Instance& instance, const std::vector<AgentId>& agents) {
    std::vector<continuous::Agent> kept;
    for (const AgentId i : agents) kept.push_back(instance.agent(i));
    return instance.with_agents(std::move(kept)).value();
  }
  static Cost cost(const Plan& plan, Objective objective) {
    return continuous::cost(plan, objective);
  }
  static bool is_valid(const Instance& instance, const Plan& plan) {
    return continuous::verify(instance, plan).valid();
  }
  static void by_clauses(Options& options) { options.joint_work = options.route_work = 0; }

 private:
  static constexpr geometry::Length kApart = 10'000'000;
};

/// What is known of each part alone.
template <class Outcome>
struct Alone {
  std::vector<Outcome> outcomes;

  [[nodiscard]] bool are_all(Status status) const {
    return std::all_of(outcomes.begin(), outcomes.end(),
                       [&](const Outcome& outcome) { return outcome.status == status; });
  }
  [[nodiscard]] Cost cost(Objective objective) const {
    Cost all = 0;
    for (const Outcome& outcome : outcomes)
      all =
          objective == Objective::sum_of_costs ? all + *outcome.cost : std::max(all, *outcome.cost);
    return all;
  }
};

template <class Domain>
class Apart : public testing::Test {
 protected:
  using Instance = typename Domain::Instance;
  using Options = typename Domain::Options;
  using Outcome = typename Domain::Outcome;

  static std::vector<Instance> small_ones(std::uint32_t seed) {
    std::vector<Instance> parts;
    for (std::uint32_t k = 0; k < 2 + seed % 2; ++k) parts.push_back(Domain::small(3 * seed + k));
    return parts;
  }
  static Alone<Outcome> alone(const std::vector<Instance>& parts, const Options& options) {
    Alone<Outcome> all;
    for (const Instance& part : parts) all.outcomes.push_back(solve(part, options).value());
    return all;
  }
  /// A conflict of two agents with one way to go, next to it an instance that takes long.
  static Instance hard_and_easy() { return Domain::side_by_side({Domain::hard(), easy_one()}); }
  static Instance easy_one() {
    for (std::uint32_t seed = 0;; ++seed) {
      Instance instance = Domain::small(seed);
      const Outcome outcome = solve(instance, {}).value();
      if (instance.num_agents() == 3 && outcome.status == Status::optimal &&
          outcome.statistics.first_plan != "" && *outcome.cost > 0)
        return instance;
    }
  }
};
using Domains = testing::Types<Grids, Roadmaps>;
TYPED_TEST_SUITE(Apart, Domains);

TYPED_TEST(Apart, TheAnswerIsThatOfEachAlone) {
  const auto cases = static_cast<std::uint32_t>(scaled(200));
  int num_optimal = 0, num_infeasible = 0;
  for (std::uint32_t seed = 0; seed < cases; ++seed) {
    const auto parts = this->small_ones(seed);
    const auto whole = TypeParam::side_by_side(parts);
    typename TypeParam::Options options;
    options.objective = seed % 3 == 2 ? Objective::makespan : Objective::sum_of_costs;
    options.threads = seed % 5 == 4 ? 2 : 1;
    const auto alone = this->alone(parts, options);
    options.debug.audit = seed % 7 == 6;
    // Clauses may never find out that there is no plan.
    if (seed % 2 == 1 && alone.are_all(Status::optimal)) {
      TypeParam::by_clauses(options);
      options.limits.conflicts = 1000;
    }
    const auto outcome = solve(whole, options).value();
    ASSERT_FALSE(outcome.internal_error) << seed << ": " << outcome.internal_error->message;
    if (alone.are_all(Status::optimal)) {
      const Cost least = alone.cost(options.objective);
      ASSERT_LE(outcome.lower_bound, least) << seed;
      if (!options.limits.conflicts || outcome.status == Status::optimal) {
        ++num_optimal;
        ASSERT_EQ(outcome.cost, least) << seed << ": " << outcome.explanation;
        ASSERT_TRUE(TypeParam::is_valid(whole, *outcome.plan)) << seed;
      }
    }
    if (outcome.status != Status::infeasible) continue;
    ++num_infeasible;
    const auto names = names_of(parts);
    if (outcome.blocked.empty()) continue;
    const std::size_t where = names[outcome.blocked.front().index()].first;
    EXPECT_EQ(alone.outcomes[where].status, Status::infeasible) << seed;
    for (const AgentId i : outcome.blocked) {
      EXPECT_EQ(names[i.index()].first, where) << seed;
      EXPECT_NE(outcome.explanation.find(" " + std::to_string(i.index())), std::string::npos)
          << seed << ": " << outcome.explanation;
    }
  }
  EXPECT_GE(num_optimal, static_cast<int>(cases / 4));
  EXPECT_GE(num_infeasible, static_cast<int>(cases / 20));
}

// In a race several threads may have a proof at about the same time, and stop each other.
TYPED_TEST(Apart, ARaceProvesTheWhole) {
  int num_optimal = 0;
  for (std::uint32_t seed = 0; seed < static_cast<std::uint32_t>(scaled(300)); ++seed) {
    const auto parts = this->small_ones(seed);
    typename TypeParam::Options options;
    options.objective = seed % 2 == 1 ? Objective::makespan : Objective::sum_of_costs;
    const auto alone = this->alone(parts, options);
    if (!alone.are_all(Status::optimal)) continue;
    options.threads = 4;
    options.race = true;
    if constexpr (requires { options.first_plan; }) options.first_plan = seed % 3 == 0;
    const auto outcome = solve(TypeParam::side_by_side(parts), options).value();
    ++num_optimal;
    ASSERT_EQ(outcome.status, Status::optimal)
        << seed << ": " << outcome.explanation << ", " << to_string(outcome.stop);
    ASSERT_EQ(outcome.cost, alone.cost(options.objective)) << seed;
  }
  EXPECT_GE(num_optimal, static_cast<int>(scaled(300) / 5));
}

TYPED_TEST(Apart, WhatTheBoundIsMadeOfIsThatOfEachAlone) {
  const auto cases = static_cast<std::uint32_t>(scaled(60));
  int num_raises = 0;
  for (std::uint32_t seed = 0; seed < cases; ++seed) {
    const auto whole = TypeParam::side_by_side({TypeParam::small(2 * seed + 1),  // one goal each
                                                TypeParam::small(2 * seed + 3)});
    typename TypeParam::Options options;
    options.objective = seed % 2 == 1 ? Objective::makespan : Objective::sum_of_costs;
    options.explain = true;
    if (solve(whole, options).value().status != Status::optimal) continue;
    TypeParam::by_clauses(options);
    options.limits.conflicts = 1000;
    const auto outcome = solve(whole, options).value();
    ASSERT_TRUE(outcome.attribution) << seed;
    num_raises += static_cast<int>(outcome.attribution->raises.size());
    const auto least = [&](const std::vector<AgentId>& agents) {
      typename TypeParam::Options plain;
      plain.objective = options.objective;
      return solve(TypeParam::of(whole, agents), plain).value().cost;
    };
    ASSERT_EQ(find_fault(*outcome.attribution, outcome.lower_bound, least), "") << seed;
  }
  EXPECT_GE(num_raises, static_cast<int>(cases / 6));
}

// The second one has its plan and its bound all the same, and both objectives their use.
TYPED_TEST(Apart, AHardGroupDoesNotKeepTheOthersWaiting) {
  const auto easy = solve(this->easy_one(), {}).value();
  typename TypeParam::Options options;
  options.limits.conflicts = 1;
  const auto hard = solve(TypeParam::hard(), options).value();
  ASSERT_EQ(hard.status, Status::feasible);
  const auto both = solve(this->hard_and_easy(), options).value();
  EXPECT_EQ(both.status, Status::feasible);
  EXPECT_EQ(both.stop, StopReason::conflicts);
  EXPECT_GE(both.lower_bound, hard.lower_bound);
  EXPECT_LE(*both.cost, *hard.cost + *easy.cost);
  options.limits.conflicts = 3000;
  EXPECT_GE(solve(this->hard_and_easy(), options).value().lower_bound,
            hard.lower_bound + *easy.cost);
}

TYPED_TEST(Apart, CutAnywhereItKeepsWhatItKnows) {
  const auto parts = this->small_ones(13);
  const auto whole = TypeParam::side_by_side(parts);
  const auto answer = solve(whole, {}).value();
  ASSERT_EQ(answer.status, Status::optimal);
  typename TypeParam::Options nothing;
  nothing.limits.conflicts = 0;
  const Cost free_bound = solve(whole, nothing).value().lower_bound;
  ASSERT_GT(free_bound, 0);
  int num_feasible = 0;
  for (std::int64_t looks = 1; looks < 400; ++looks)
    for (const std::size_t threads : {1U, 2U}) {
      if (threads == 2 && looks % 10 != 0) continue;
      typename TypeParam::Options options;
      options.limits.looks = looks;
      options.threads = threads;
      TypeParam::by_clauses(options);
      const auto outcome = solve(whole, options).value();
      ASSERT_FALSE(outcome.internal_error) << outcome.internal_error->message;
      EXPECT_LE(outcome.lower_bound, *answer.cost);
      EXPECT_GE(outcome.lower_bound, free_bound) << looks;
      if (!outcome.plan) continue;
      ++num_feasible;
      EXPECT_TRUE(TypeParam::is_valid(whole, *outcome.plan));
      EXPECT_GE(*outcome.cost, *answer.cost);
    }
  EXPECT_GT(num_feasible, 0);
}

TYPED_TEST(Apart, WhatIsGivenIsTaken) {
  const auto whole = this->hard_and_easy();
  typename TypeParam::Options options;
  options.limits.conflicts = 1;
  const auto first = solve(whole, options).value();
  ASSERT_TRUE(first.plan);
  options.limits.conflicts = 0;
  options.initial_plan = first.plan;
  options.debug.known_plan = first.plan;
  const auto second = solve(whole, options).value();
  EXPECT_EQ(second.status, Status::feasible);
  EXPECT_EQ(second.cost, first.cost);
  EXPECT_EQ(second.statistics.first_plan, "given");
  options.limits.conflicts = 1500;
  const auto third = solve(whole, options).value();
  EXPECT_FALSE(third.internal_error);
  EXPECT_LE(*third.cost, *first.cost);
  EXPECT_GE(third.lower_bound, first.lower_bound);
  // A claim that is wrong, and one that is right.
  options.known_lower_bound = *first.cost + 1;
  EXPECT_EQ(solve(whole, options).error().code, ErrorCode::out_of_range);
  options.known_lower_bound = *first.cost;
  const auto claimed = solve(whole, options).value();
  EXPECT_EQ(claimed.status, Status::optimal);
  EXPECT_TRUE(claimed.rests_on_known_bound);
}

TYPED_TEST(Apart, AWantedGapIsThatOfTheWhole) {
  typename TypeParam::Options options;
  options.gap_percent = 90;
  const auto outcome = solve(this->hard_and_easy(), options).value();
  EXPECT_EQ(outcome.status, Status::feasible);
  EXPECT_EQ(outcome.stop, StopReason::gap);
  EXPECT_TRUE(is_within_gap(90, *outcome.cost, outcome.lower_bound));
}

// Threads beside the one that is told to stop stop, too.
TYPED_TEST(Apart, AGapOfTheWholeEndsAllThreads) {
  typename TypeParam::Options options;
  options.limits.conflicts = 1;
  const auto first = solve(this->hard_and_easy(), options).value();
  ASSERT_EQ(first.status, Status::feasible);
  const double gap = gap_percent(*first.cost, first.lower_bound);
  options.limits.conflicts.reset();
  options.gap_percent = gap;
  options.initial_plan = first.plan;
  options.threads = 3;
  const auto outcome = solve(this->hard_and_easy(), options).value();
  EXPECT_NE(outcome.status, Status::unknown);
  EXPECT_TRUE(is_within_gap(gap, *outcome.cost, outcome.lower_bound));
}

TYPED_TEST(Apart, HowOftenTheUserHearsChangesNothing) {
  for (const Objective objective : {Objective::sum_of_costs, Objective::makespan}) {
    typename TypeParam::Options options;
    options.objective = objective;
    options.limits.conflicts = 3000;
    options.progress_interval_s = 1000;
    options.on_progress = [](const Progress&) {};
    const auto rarely = solve(this->hard_and_easy(), options).value();
    options.progress_interval_s = 0;
    const auto often = solve(this->hard_and_easy(), options).value();
    EXPECT_EQ(rarely.statistics.conflicts, often.statistics.conflicts);
    EXPECT_EQ(rarely.lower_bound, often.lower_bound);
    EXPECT_EQ(rarely.plan, often.plan);
  }
}

TYPED_TEST(Apart, TheUserHearsOfTheWhole) {
  const auto whole = this->hard_and_easy();
  typename TypeParam::Options options;
  options.limits.conflicts = 3000;
  options.progress_interval_s = options.plan_interval_s = 0;
  Cost bound = 0;
  std::optional<Cost> cost;
  std::int64_t conflicts = 0;
  int num_plans = 0;
  options.on_progress = [&](const Progress& progress) {
    EXPECT_GE(progress.lower_bound, bound);
    EXPECT_GE(progress.conflicts, conflicts);
    if (cost) {
      EXPECT_LE(progress.cost.value(), *cost);
    }
    bound = progress.lower_bound;
    cost = progress.cost;
    conflicts = progress.conflicts;
  };
  options.on_plan = [&](const typename TypeParam::Plan& plan) {
    ++num_plans;
    EXPECT_TRUE(TypeParam::is_valid(whole, plan));
  };
  const auto outcome = solve(whole, options).value();
  EXPECT_GT(num_plans, 0);
  EXPECT_EQ(bound, outcome.lower_bound);
  EXPECT_EQ(cost, outcome.cost);
  EXPECT_GT(conflicts, 0);
  EXPECT_LE(outcome.statistics.conflicts, 3100);
  // What they throw comes out.
  options.on_progress = [&](const Progress& progress) {
    if (progress.conflicts > 0) throw std::string("enough");
  };
  EXPECT_THROW((void)solve(whole, options), std::string);
}

TYPED_TEST(Apart, AnInterruptEndsIt) {
  std::atomic<bool> interrupt = false;
  typename TypeParam::Options options;
  options.limits.interrupt = &interrupt;
  options.progress_interval_s = 0;
  options.on_progress = [&](const Progress& progress) {
    if (progress.cost) interrupt = true;
  };
  const auto outcome = solve(this->hard_and_easy(), options).value();
  EXPECT_EQ(outcome.status, Status::feasible);
  EXPECT_EQ(outcome.stop, StopReason::interrupt);
}

// Lanes without a common vertex may cross, and who stands beside a lane is in the way.
TEST(ApartOnRoadmaps, ComponentsThatComeNearAreOneGroup) {
  using continuous::test::agent;
  const auto crossing = continuous::Instance::make(
      continuous::test::roadmap({{-1000, 0}, {1000, 0}, {0, -1000}, {0, 1000}}, {{0, 1}, {2, 3}}),
      {agent(0, 1, 100), agent(2, 3, 100)});
  for (const bool by_clauses : {false, true}) {
    continuous::SolveOptions options;
    if (by_clauses) Roadmaps::by_clauses(options);
    const auto outcome = solve(*crossing, options).value();
    EXPECT_EQ(outcome.status, Status::optimal);
    EXPECT_GT(*outcome.cost, 4000);
  }
  const auto standing = continuous::Instance::make(
      continuous::test::roadmap({{0, 0}, {2000, 0}, {1000, 150}}, {{0, 1}}),
      {agent(0, 1, 100), agent(2, 2, 100)});
  const auto outcome = solve(*standing, {}).value();
  EXPECT_EQ(outcome.status, Status::infeasible);
  EXPECT_EQ(outcome.blocked, (std::vector<AgentId>{AgentId(0), AgentId(1)}));
}

}  // namespace
}  // namespace quadrille::support
