// SPDX-License-Identifier: MIT
#include "quadrille/discrete/verify.hpp"

#include <gmock/gmock.h>

#include <set>

#include "discrete/formats/io_support.hpp"

namespace quadrille::discrete {
namespace {

using Kind = Violation::Kind;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr std::int32_t kSize = 4;

/// Vertices of an open 4 x 4 grid.
VertexId at(std::int32_t x, std::int32_t y) {
  return VertexId(static_cast<std::size_t>(y * kSize + x));
}

Instance open_grid(std::vector<Agent> tasks) {
  return Instance::make(empty_map(kSize, kSize).value().graph(), std::move(tasks)).value();
}

std::vector<std::string> messages(const Instance& instance, const Plan& plan) {
  std::vector<std::string> all;
  for (const Violation& violation : verify(instance, plan).violations)
    all.push_back(violation.message);
  return all;
}

TEST(Verify, CountsTheCostsOfAValidPlan) {
  const Instance instance = open_grid({{at(0, 0), at(2, 0)}, {at(3, 3), at(3, 3)}});
  // The first agent passes its goal and comes back; trailing stays cost nothing.
  const Plan plan{{Path{at(0, 0), at(1, 0), at(2, 0), at(2, 1), at(2, 0), at(2, 0)},
                   Path{at(3, 3), at(3, 3), at(3, 2), at(3, 3)}}};
  const VerifyReport report = verify(instance, plan);
  EXPECT_TRUE(report.valid());
  EXPECT_EQ(report.sum_of_costs, 4 + 3);
  EXPECT_EQ(report.makespan, 4);
}

TEST(Verify, NoAgentsNoViolations) {
  const VerifyReport report = verify(open_grid({}), {});
  EXPECT_TRUE(report.valid());
  EXPECT_EQ(report.sum_of_costs, 0);
  EXPECT_EQ(report.makespan, 0);
}

TEST(Verify, NamesAgentsPlaceAndTimestep) {
  const Instance instance = open_grid({{at(0, 0), at(2, 0)}, {at(2, 0), at(0, 0)}});
  EXPECT_THAT(messages(instance,
                       {{Path{at(0, 0), at(1, 0), at(2, 0)}, Path{at(2, 0), at(1, 0), at(0, 0)}}}),
              ElementsAre("agents 0 and 1 are both at (1, 0) at timestep 1"));
  EXPECT_THAT(messages(instance, {{Path{at(0, 0), at(1, 0), at(2, 0)},
                                   Path{at(2, 0), at(2, 0), at(1, 0), at(0, 0)}}}),
              ElementsAre("agents 0 and 1 swap (1, 0) and (2, 0) between timesteps 1 and 2"));
  EXPECT_THAT(
      messages(instance, {{Path{at(1, 0), at(2, 0)}, Path{at(2, 0), at(0, 0)}}}),
      ElementsAre("agent 0 begins at (1, 0) instead of its start (0, 0)",
                  "agent 1 moves from (2, 0) at timestep 0 to (0, 0), which is no neighbour"));
  EXPECT_THAT(messages(instance, {{Path{at(0, 0), at(0, 1)}, Path{}}}),
              ElementsAre("agent 1 has an empty path",
                          "agent 0 ends at (0, 1) at timestep 1 instead of its goal (2, 0)"));
  EXPECT_THAT(
      messages(instance, {{Path{at(0, 0), VertexId(99), at(2, 0)}, Path{at(2, 0)}, Path{}}}),
      ElementsAre("the plan has 3 paths for 2 agents",
                  "agent 1 ends at (2, 0) at timestep 0 instead of its goal (0, 0)",
                  "agent 0 is at vertex 99 at timestep 1, which the graph does not have",
                  "agents 0 and 1 are both at (2, 0) at timestep 2"));
}

TEST(Verify, FillsInEveryField) {
  const Instance instance = open_grid({{at(0, 0), at(1, 0)}, {at(1, 0), at(0, 0)}});
  const auto report = verify(instance, {{Path{at(0, 0), at(1, 0)}, Path{at(1, 0), at(0, 0)}}});
  ASSERT_EQ(report.violations.size(), 1u);
  const Violation& swap = report.violations[0];
  EXPECT_EQ(swap.kind, Kind::swap);
  EXPECT_EQ(swap.agent, AgentId(0));
  EXPECT_EQ(swap.other, AgentId(1));
  EXPECT_EQ(swap.vertex, at(0, 0));
  EXPECT_EQ(swap.timestep, 0);
}

TEST(Verify, AgentsStayAtTheirGoals) {
  const Instance instance = open_grid({{at(1, 0), at(1, 0)}, {at(0, 0), at(2, 0)}});
  const Plan through{{Path{at(1, 0)}, Path{at(0, 0), at(1, 0), at(2, 0)}}};
  EXPECT_THAT(messages(instance, through),
              ElementsAre("agents 0 and 1 are both at (1, 0) at timestep 1"));
}

TEST(Verify, FollowingAndRotatingAreAllowed) {
  const std::vector<VertexId> ring = {at(0, 0), at(1, 0), at(1, 1), at(0, 1)};
  std::vector<Agent> tasks;
  Plan plan;
  for (std::size_t i = 0; i < 4; ++i) {
    tasks.push_back({ring[i], ring[(i + 1) % 4]});
    plan.paths.push_back({ring[i], ring[(i + 1) % 4]});
  }
  EXPECT_THAT(messages(open_grid(tasks), plan), IsEmpty());
}

TEST(Verify, AdjacencyOfGraphsIsThatOfTheirEdges) {
  const VertexId a(0), b(1), c(2);
  const Instance instance =
      Instance::make(Graph::make(3, {{a, b}, {b, c}}).value(), {{a, c}}).value();
  EXPECT_TRUE(verify(instance, {{Path{a, b, b, c}}}).valid());
  EXPECT_THAT(messages(instance, {{Path{a, c}}}),
              ElementsAre("agent 0 moves from 0 at timestep 0 to 2, which is no neighbour"));
}

TEST(Verify, ACrowdAndALongStayAreReportedInLinearTime) {
  std::vector<Agent> tasks;
  Plan plan;
  for (std::size_t i = 0; i < 16; ++i) {
    tasks.push_back({VertexId(i), VertexId(i)});
    plan.paths.push_back({at(0, 0)});
  }
  plan.paths[AgentId(7)].assign(200000, at(0, 0));
  const VerifyReport report = verify(open_grid(tasks), plan);
  std::set<std::uint32_t> named;
  for (const Violation& violation : report.violations)
    if (violation.kind == Kind::vertex && violation.timestep == 0) {
      named.insert(violation.agent.value());
      named.insert(violation.other->value());
    }
  EXPECT_EQ(named.size(), 16u) << "everyone in the crowd is named";
  EXPECT_LT(report.violations.size(), 200100u);
  EXPECT_EQ(report.violations.back().timestep, 199999);
}

/// Every rule by itself, from the definition; (kind, agents, timestep) of all that is broken.
struct Found {
  bool single = false;  // Start, goal, adjacency or a vertex out of range.
  std::set<std::pair<Timestep, AgentId>> vertex, swap;  // Agents that take part.
};

Found by_definition(const Instance& instance, const Plan& plan) {
  Found found;
  Timestep horizon = 0;
  for (const AgentId i : instance.agent_ids()) {
    const Path& path = plan.paths[i];
    const Agent& task = instance.agents()[i];
    horizon = std::max(horizon, static_cast<Timestep>(path.size()) - 1);
    found.single |= path.front() != task.start || !task.goals.contains(path.back());
    for (std::size_t t = 0; t + 1 < path.size(); ++t)
      found.single |= path[t] != path[t + 1] && !instance.graph().adjacent(path[t], path[t + 1]);
  }
  for (Timestep t = 0; t <= horizon; ++t)
    for (const AgentId i : instance.agent_ids())
      for (const AgentId j : instance.agent_ids()) {
        const Path &p = plan.paths[i], &q = plan.paths[j];
        if (i == j) continue;
        if (position(p, t) == position(q, t)) found.vertex.emplace(t, i);
        if (position(p, t) != position(p, t + 1) && position(p, t) == position(q, t + 1) &&
            position(q, t) == position(p, t + 1))
          found.swap.emplace(t, i);
      }
  return found;
}

TEST(Verify, AgreesWithTheDefinitionOnRandomPlans) {
  int valid = 0;
  for (std::uint64_t seed = 0; seed < 4000; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    // Few cells and random walks, so that every mixture of right and wrong occurs.
    const Graph graph =
        random_map(2 + static_cast<std::int32_t>(random() % 2), 3, 0.1, seed).value().graph();
    const std::size_t agents = 1 + random() % std::min<std::size_t>(3, graph.num_vertices());
    Plan plan;
    std::set<VertexId> starts, goals;
    std::vector<Agent> tasks;
    for (std::size_t i = 0; i < agents; ++i) {
      Path path{VertexId(random() % graph.num_vertices())};
      for (std::size_t t = random() % 4; t > 0; --t) {
        const auto near = graph.neighbours(path.back());
        if (random() % 20 == 0)
          path.push_back(VertexId(random() % graph.num_vertices()));
        else
          path.push_back(near.empty() || random() % 4 == 0 ? path.back()
                                                           : near[random() % near.size()]);
      }
      // The task is the path's if it can be.
      Agent task{path.front(), path.back()};
      while (!starts.insert(task.start).second)
        task.start = VertexId(random() % graph.num_vertices());
      while (!goals.insert(task.goal()).second)
        task.goals = VertexId(random() % graph.num_vertices());
      // Other agents' goals may be among several.
      if (random() % 4 == 0)
        task.goals = Goals({task.goal(), VertexId(random() % graph.num_vertices()),
                            VertexId(random() % graph.num_vertices())});
      tasks.push_back(task);
      plan.paths.push_back(path);
    }
    const Instance instance = Instance::make(graph, tasks).value();
    const VerifyReport report = verify(instance, plan);
    const Found expected = by_definition(instance, plan);
    Found found;
    for (const Violation& violation : report.violations) {
      if (violation.kind != Kind::vertex && violation.kind != Kind::swap) {
        found.single = true;
        continue;
      }
      auto& set = violation.kind == Kind::vertex ? found.vertex : found.swap;
      for (const AgentId i : {violation.agent, *violation.other}) {
        set.emplace(violation.timestep, i);
        EXPECT_TRUE((violation.kind == Kind::vertex ? expected.vertex : expected.swap)
                        .contains({violation.timestep, i}))
            << violation.message;
      }
    }
    EXPECT_EQ(found.single, expected.single);
    EXPECT_EQ(found.swap, expected.swap);
    // Agents that only stay may go unnamed, but not those whose path is still running.
    for (const auto& [t, i] : expected.vertex)
      if (static_cast<std::size_t>(t) < plan.paths[i].size()) {
        EXPECT_TRUE(found.vertex.contains({t, i})) << "agent " << i.value() << " at " << t;
      }
    EXPECT_EQ(report.valid(), !expected.single && expected.vertex.empty() && expected.swap.empty());
    if (!report.valid()) continue;
    ++valid;
    EXPECT_EQ(report.sum_of_costs, plan.cost(Objective::sum_of_costs));
    EXPECT_EQ(report.makespan, plan.cost(Objective::makespan));
  }
  EXPECT_GT(valid, 400);
  EXPECT_LT(valid, 3600);
}

}  // namespace
}  // namespace quadrille::discrete
