// SPDX-License-Identifier: MIT
#include "support/joint_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "support/generators.hpp"

namespace quadrille::discrete::support {
namespace {

Instance on_graph(std::size_t n, const std::vector<std::pair<int, int>>& edges,
                  const std::vector<std::pair<int, int>>& tasks) {
  const auto id = [](int v) { return VertexId(static_cast<std::size_t>(v)); };
  std::vector<Graph::Edge> list;
  for (const auto& [a, b] : edges) list.emplace_back(id(a), id(b));
  std::vector<Agent> from_to;
  for (const auto& [start, goal] : tasks) from_to.push_back({id(start), id(goal)});
  return Instance::make(Graph::make(n, list).value(), from_to).value();
}

void expect_answer(const Instance& instance, Cost sum_of_costs, Cost makespan) {
  for (const Objective objective : {Objective::sum_of_costs, Objective::makespan}) {
    const Cost cost = objective == Objective::makespan ? makespan : sum_of_costs;
    const JointAnswer answer = joint_search(instance, objective);
    ASSERT_EQ(answer.status, Status::optimal);
    EXPECT_EQ(answer.cost, cost) << to_string(objective);
    EXPECT_EQ(answer.plan.cost(objective), cost) << to_string(objective);
    EXPECT_EQ(replay(instance, answer.plan), "");
  }
}

void expect_infeasible(const Instance& instance) {
  for (const Objective objective : {Objective::sum_of_costs, Objective::makespan})
    EXPECT_EQ(joint_search(instance, objective).status, Status::infeasible);
}

TEST(JointSearch, OneAgentWalksStraight) {
  expect_answer(on_graph(3, {{0, 1}, {1, 2}}, {{0, 2}}), 2, 2);
  expect_answer(on_graph(3, {{0, 1}, {1, 2}}, {{1, 1}}), 0, 0);
  expect_infeasible(on_graph(3, {{0, 1}}, {{0, 2}}));
}

TEST(JointSearch, NoAgentsCostNothing) { expect_answer(on_graph(2, {{0, 1}}, {}), 0, 0); }

TEST(JointSearch, FollowingIsAllowed) {
  expect_answer(on_graph(4, {{0, 1}, {1, 2}, {2, 3}}, {{0, 1}, {1, 2}, {2, 3}}), 3, 1);
}

TEST(JointSearch, RotationsAreAllowedAndSwapsAreNot) {
  expect_answer(on_graph(3, {{0, 1}, {1, 2}, {2, 0}}, {{0, 1}, {1, 2}, {2, 0}}), 3, 1);
  const std::vector<std::pair<int, int>> square{{0, 1}, {1, 3}, {3, 2}, {2, 0}};
  expect_answer(on_graph(4, square, {{0, 1}, {1, 3}, {3, 2}, {2, 0}}), 4, 1);
  expect_infeasible(on_graph(4, square, {{0, 1}, {1, 0}, {2, 2}, {3, 3}}));
  expect_infeasible(on_graph(3, {{0, 1}, {1, 2}}, {{0, 2}, {2, 0}}));
}

// 0-1-2-3 in a row and an alcove 4 at 1. Agent 0 -> 3, agent 3 -> 0: one of them dodges into the
// alcove. Agent 0 dodges: 0 1 4 1 2 3 = 5 steps, while the other passes 3 2 1 0 unhindered: at
// timestep 2 it is in 1 and the dodger in 4, so the dodger is back in 1 at timestep 3.
TEST(JointSearch, SwapInACorridorUsesTheAlcove) {
  expect_answer(on_graph(5, {{0, 1}, {1, 2}, {2, 3}, {1, 4}}, {{0, 3}, {3, 0}}), 8, 5);
}

// Agent 0 is at its goal 1 in the middle of the row 0-1-2 with an alcove 3 at 1. It has to let
// agent 1 pass and come back: it pays for its whole absence, 2, and agent 1 for 2 moves.
TEST(JointSearch, LeavingTheGoalCostsTheWaitBefore) {
  expect_answer(on_graph(4, {{0, 1}, {1, 2}, {1, 3}}, {{1, 1}, {0, 2}}), 4, 2);
  // One vertex further away, agent 0 has to wait a timestep in its goal: that wait is paid, too.
  expect_answer(on_graph(5, {{0, 1}, {1, 2}, {1, 3}, {4, 0}}, {{1, 1}, {4, 2}}), 6, 3);
}

// Waiting is costlier than the detour for one objective only: the optima need different plans.
TEST(JointSearch, GivesUpBeyondItsStates) {
  const Instance instance = on_graph(3, {{0, 1}, {1, 2}}, {{0, 1}, {1, 2}});
  EXPECT_EQ(joint_search(instance, Objective::makespan, 9).status, Status::optimal);
  EXPECT_EQ(joint_search(instance, Objective::makespan, 8).status, Status::unknown);
  EXPECT_EQ(joint_search(instance, Objective::sum_of_costs, 36).status, Status::optimal);
  EXPECT_EQ(joint_search(instance, Objective::sum_of_costs, 35).status, Status::unknown);
}

TEST(Replay, FindsEachKindOfFault) {
  const Instance instance = on_graph(4, {{0, 1}, {1, 2}, {2, 3}}, {{0, 1}, {2, 2}});
  const auto fault = [&](std::vector<std::vector<int>> paths) {
    Plan plan;
    for (const auto& path : paths) {
      plan.paths.push_back({});
      for (const int v : path)
        plan.paths[AgentId(plan.paths.size() - 1)].push_back(VertexId(static_cast<std::size_t>(v)));
    }
    return replay(instance, plan);
  };
  EXPECT_EQ(fault({{0, 1}, {2}}), "");
  EXPECT_EQ(fault({{0, 0, 1}, {2, 3, 2}}), "");
  EXPECT_NE(fault({{0, 1}}), "");
  EXPECT_NE(fault({{0, 1}, {}}), "");
  EXPECT_NE(fault({{1}, {2}}), "");
  EXPECT_NE(fault({{0}, {2}}), "");
  EXPECT_NE(fault({{0, 9, 1}, {2}}), "");
  EXPECT_NE(fault({{0, 2, 1}, {2, 3, 3, 2}}), "");
  EXPECT_NE(fault({{0, 1, 2, 1}, {2}}), "");           // in the goal where the other stays
  EXPECT_NE(fault({{0, 1, 2, 1}, {2, 2, 1, 2}}), "");  // swap
}

/// The definition, executed: the least cost of all plans of `horizon` timesteps.
class AllPlans {
 public:
  AllPlans(const Instance& instance, Objective objective, std::size_t horizon)
      : instance_(instance), objective_(objective), horizon_(horizon) {
    plan_.paths.resize(instance.num_agents());
    for (const AgentId i : instance.agent_ids())
      plan_.paths[i].assign(1, instance.agents()[i].start);
  }
  Cost least() {
    extend(0);
    return least_;
  }

 private:
  void extend(std::size_t agent) {
    if (agent < instance_.num_agents()) {
      Path& path = plan_.paths[AgentId(agent)];
      if (path.size() == horizon_ + 1) return judge();
      const VertexId here = path.back();
      path.push_back(here);
      extend(agent + 1);
      for (const VertexId next : instance_.graph().neighbours(here)) {
        path.back() = next;
        extend(agent + 1);
      }
      path.pop_back();
      return;
    }
    if (is_step_valid()) extend(0);
  }
  [[nodiscard]] bool is_step_valid() const {
    for (const AgentId i : instance_.agent_ids())
      for (const AgentId j : instance_.agent_ids()) {
        const Path &p = plan_.paths[i], &q = plan_.paths[j];
        const std::size_t t = p.size() - 1;
        if (i < j && (p[t] == q[t] || (p[t] == q[t - 1] && p[t - 1] == q[t]))) return false;
      }
    return true;
  }
  void judge() {
    if (replay(instance_, plan_).empty()) least_ = std::min(least_, plan_.cost(objective_));
  }

  const Instance& instance_;
  Objective objective_;
  std::size_t horizon_;
  Plan plan_;
  Cost least_ = std::numeric_limits<Cost>::max();
};

// A plan of cost c takes at most c timesteps, so within the horizon both have to agree.
TEST(JointSearch, AgreesWithTheEnumerationOfAllPlans) {
  std::size_t compared = 0;
  for (const std::size_t n : {2U, 3U, 4U})
    for (const Graph& graph : connected_graphs(n))
      for (const auto& starts : arrangements(n, 2))
        for (const auto& goals : arrangements(n, 2)) {
          std::vector<Agent> tasks;
          for (std::size_t i = 0; i < 2; ++i)
            tasks.push_back({VertexId(starts[i]), VertexId(goals[i])});
          const Instance instance = Instance::make(graph, tasks).value();
          const std::size_t horizon = n == 4 ? 4 : 6;
          for (const Objective objective : {Objective::sum_of_costs, Objective::makespan}) {
            const JointAnswer answer = joint_search(instance, objective);
            const Cost least = AllPlans(instance, objective, horizon).least();
            const bool within =
                answer.status == Status::optimal && answer.cost <= static_cast<Cost>(horizon);
            if (within) ++compared;
            if (within) {
              ASSERT_EQ(answer.cost, least);
            } else if (answer.status == Status::infeasible) {
              ASSERT_EQ(least, std::numeric_limits<Cost>::max());
            } else {
              ASSERT_GT(least, static_cast<Cost>(horizon));
            }
          }
        }
  EXPECT_GT(compared, 1000U);
}

}  // namespace
}  // namespace quadrille::discrete::support
