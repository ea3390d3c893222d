// SPDX-License-Identifier: MIT
#include "quadrille/discrete/instance_json.hpp"

#include "discrete/formats/io_support.hpp"

namespace quadrille::discrete {
namespace {

TEST(InstanceJson, ReadsGrids) {
  const Instance instance = read_instance_json(testing::data("valid/grid.json")).value();
  const GridMap map = read_map(testing::data("valid/small.map")).value();
  EXPECT_TRUE(testing::equal(instance.graph(), map.graph()));
  EXPECT_EQ(instance.agents().items(),
            (std::vector<Agent>{{VertexId(0), VertexId(3)}, {VertexId(3), VertexId(0)}}));
}

TEST(InstanceJson, ReadsGraphs) {
  const Instance instance = read_instance_json(testing::data("valid/graph.json")).value();
  EXPECT_EQ(instance.graph().num_vertices(), 3u);
  EXPECT_EQ(instance.graph().num_edges(), 2u);
  EXPECT_TRUE(instance.graph().adjacent(VertexId(2), VertexId(1)));
  EXPECT_FALSE(instance.graph().layout().has_value());
  EXPECT_EQ(instance.agents().items(),
            (std::vector<Agent>{{VertexId(0), VertexId(2)}, {VertexId(2), VertexId(0)}}));
}

TEST(InstanceJson, ReadsGoalSets) {
  const Instance instance = read_instance_json(testing::data("valid/goal-sets.json")).value();
  const auto at = [&](int x, int y) { return *instance.graph().layout()->vertex_at({x, y}); };
  EXPECT_TRUE(instance.has_goal_sets());
  EXPECT_EQ(instance.agents()[AgentId(0)].goals, Goals({at(3, 0), at(0, 2)}));
  EXPECT_EQ(instance.agents()[AgentId(1)].goal(), at(0, 2));
}

TEST(InstanceJson, GoalSetsMayHaveNames) {
  const auto read = [](const std::string& sets, const std::string& goals) {
    std::istringstream in(
        "{\"quadrille\": \"instance\", \"version\": 1, \"grid\": {\"width\": 4, \"height\": 1, "
        "\"rows\": [\"....\"]},\n\"agents\": [{\"start\": [0, 0], \"goals\": " +
        goals + "}, {\"start\": [1, 0], \"goals\": [[1, 0], [2, 0]]}],\n\"goal_sets\": " + sets +
        "}");
    return read_instance_json(in, "f");
  };
  const std::string docks = "{\"docks\": [[3, 0], [2, 0]], \"all\": [[0, 0]]}";
  const Instance instance = read(docks, "\"docks\"").value();
  EXPECT_EQ(instance.agents()[AgentId(0)].goals, Goals({VertexId(2), VertexId(3)}));
  EXPECT_EQ(instance.agents()[AgentId(1)].goals, Goals({VertexId(1), VertexId(2)}));
  EXPECT_EQ(read(docks, "\"all\"")->agents()[AgentId(0)].goal(), VertexId(0));
  const auto message = [&](const std::string& sets, const std::string& goals) {
    const auto wrong = read(sets, goals);
    return wrong ? std::string() : wrong.error().to_string();
  };
  EXPECT_EQ(message(docks, "\"dock\""), "f:2: /agents/0/goals: there is no goal set 'dock'");
  EXPECT_EQ(message("{\"a\": []}", "[[0, 0]]"), "f:3: /goal_sets/a: there is no goal in the list");
  EXPECT_EQ(message("{\"a\": [[4, 0]]}", "[[0, 0]]"),
            "f:3: /goal_sets/a/0: (4, 0) is outside the grid of 4 x 1 cells");
  EXPECT_EQ(message("[]", "[[0, 0]]"), "f:3: /goal_sets: expected lists of goals by their names");
  EXPECT_EQ(message("{\"a\": [[0, 0]], \"a\": [[1, 0]]}", "[[0, 0]]"),
            "f:3: /goal_sets/a: this name is given twice");
}

TEST(InstanceJson, NumbersAtTheEndOfALineBelongToIt) {
  // The parser has read the line end when it reports the number.
  std::istringstream in("{\"quadrille\": \"instance\",\n\"version\": 7\n, \"agents\": []}\n");
  EXPECT_EQ(read_instance_json(in, "test.json").error().to_string(),
            "test.json:2: /version: 7 is not between 1 and 1");
}

TEST(InstanceJson, WhatIsWrittenIsReadBack) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    const Instance instance =
        seed % 2 == 0 ? testing::random_grid_instance(seed) : testing::random_graph_instance(seed);
    std::stringstream file;
    ASSERT_EQ(write_instance_json(file, "out", instance), std::nullopt);
    const auto again = read_instance_json(file, "out");
    ASSERT_TRUE(again.has_value()) << again.error().to_string() << '\n' << file.str();
    EXPECT_TRUE(testing::equal(*again, instance)) << file.str();
  }
}

TEST(InstanceJson, WriterReportsAFullDisk) {
  const Instance instance = testing::random_grid_instance(1);
  testing::expect_reports_full_disk(
      [&](std::ostream& out) { return write_instance_json(out, "out", instance); });
}

}  // namespace
}  // namespace quadrille::discrete
