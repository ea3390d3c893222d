// SPDX-License-Identifier: MIT
#include "quadrille/discrete/instance_yaml.hpp"

#include "discrete/formats/io_support.hpp"
#include "formats/document.hpp"
#include "quadrille/discrete/instance_json.hpp"

namespace quadrille::discrete {
namespace {

Result<Instance> instance_of(const std::string& text) {
  std::istringstream in(text);
  return read_instance_yaml(in, "test.yaml");
}

TEST(InstanceYaml, ReadsTuplesAndLists) {
  const Instance instance = read_instance_yaml(testing::data("valid/grid.yaml")).value();
  EXPECT_TRUE(
      testing::equal(instance, read_instance_json(testing::data("valid/grid.json")).value()));
}

TEST(InstanceYaml, ReadsFlowStyleAndIgnoresRepeatedObstacles) {
  const auto instance = instance_of(
      "map: {dimensions: [5, 2], obstacles: [[0, 1], [0, 1]]}\n"
      "agents: [{name: agent0, start: [0, 0], goal: [4, 0]}]  # from its manual\n");
  ASSERT_TRUE(instance.has_value()) << instance.error().to_string();
  EXPECT_EQ(instance->graph().num_vertices(), 9u);
  EXPECT_EQ(instance->agents().items(), (std::vector<Agent>{{VertexId(0), VertexId(4)}}));
}

TEST(InstanceYaml, NamesAreReadAndWritten) {
  const std::string text =
      "map: {dimensions: [5, 2]}\n"
      "agents: [{name: 'a: \"b\"', start: [0, 0], goal: [4, 0]}, {start: [1, 0], goal: [3, 0]},"
      " {name: 7, start: [2, 0], goal: [2, 0]}]\n";
  std::istringstream in(text);
  text::Names names, yaml_names, json_names;
  const Instance instance = read_instance_yaml(in, "f", SIZE_MAX, &names).value();
  EXPECT_EQ(*names.agent(0), "a: \"b\"");
  EXPECT_EQ(names.agent(1), nullptr);
  EXPECT_EQ(*names.agent(2), "7");
  std::stringstream json, yaml;
  ASSERT_EQ(write_instance_json(json, "f", instance, names), std::nullopt);
  ASSERT_TRUE(read_instance_json(json, "f", SIZE_MAX, &json_names).has_value()) << json.str();
  EXPECT_EQ(json_names, names);
  ASSERT_EQ(write_instance_yaml(yaml, "f", instance, names), std::nullopt);
  ASSERT_TRUE(read_instance_yaml(yaml, "f", SIZE_MAX, &yaml_names).has_value()) << yaml.str();
  names.agents[1] = "agent1";  // which it is called where it has no name
  EXPECT_EQ(yaml_names, names);
  const auto twice = instance_of(
      "map: {dimensions: [5, 2]}\nagents: [{name: x, start: [0, 0], goal: [4, 0]},\n"
      " {name: x, start: [1, 0], goal: [3, 0]}]\n");
  ASSERT_FALSE(twice.has_value());
  EXPECT_EQ(twice.error().to_string(),
            "test.yaml:3: /agents/1: agents 0 and 1 are both called 'x'");
}

TEST(InstanceYaml, AgentsMayHaveSeveralGoals) {
  const std::string map = "map: {dimensions: [5, 2]}\n";
  const Instance instance =
      instance_of(map +
                  "agents: [{name: x, start: [0, 0], potentialGoals: [[4, 0], [1, 1]]},\n"
                  " {name: y, start: [1, 0], potentialGoals: [[3, 0]]},"
                  " {name: z, start: [2, 0], goal: [2, 0]}]\n")
          .value();
  const auto goals = [&](std::size_t i) {
    const auto all = instance.agents()[AgentId(i)].goals.vertices();
    return std::vector<VertexId>(all.begin(), all.end());
  };
  EXPECT_EQ(goals(0), (std::vector{VertexId(4), VertexId(6)}));
  EXPECT_EQ(goals(1), std::vector{VertexId(3)});
  EXPECT_EQ(goals(2), std::vector{VertexId(2)});
  std::stringstream yaml;
  ASSERT_EQ(write_instance_yaml(yaml, "f", instance), std::nullopt);
  EXPECT_TRUE(testing::equal(instance, read_instance_yaml(yaml, "f").value())) << yaml.str();
  for (const auto& [agent, why] :
       {std::pair("{start: [0, 0]}", ": the key 'goal' is missing"),
        std::pair("{start: [0, 0], potentialGoals: []}", "there is no goal in the list"),
        std::pair("{start: [0, 0], goal: [1, 0], potentialGoals: [[2, 0]]}",
                  "expected either 'goal' or 'potentialGoals'"),
        std::pair("{start: [0, 0], potentialGoals: [[5, 0]]}", "outside the grid")}) {
    const auto wrong = instance_of(map + "agents: [" + agent + "]\n");
    ASSERT_FALSE(wrong.has_value()) << agent;
    EXPECT_NE(wrong.error().to_string().find(why), std::string::npos) << wrong.error().to_string();
  }
}

TEST(InstanceYaml, AliasBombsAreRefusedAtOnce) {
  std::string text = "a: &a [x, x, x, x, x, x, x, x, x]\n";
  for (char c = 'b'; c <= 'z'; ++c) {
    text += std::string(1, c) + ": &" + c + " [";
    for (int i = 0; i < 9; ++i)
      text += std::string(i == 0 ? "*" : ", *") + static_cast<char>(c - 1);
    text += "]\n";
  }
  const auto instance = instance_of(text);
  ASSERT_FALSE(instance.has_value());
  EXPECT_EQ(instance.error().where.line, 1);
  EXPECT_EQ(instance.error().message, "anchors are not accepted");
}

TEST(InstanceYaml, WhatTheParserHasToKeepIsLimited) {
  const auto read = [](const std::string& text) {
    std::istringstream in(text);
    return read_instance_yaml(in, "f");
  };
  std::string pairs;
  while (pairs.size() < 3 * text::kMaxYamlLookahead) pairs += "[1,1],";
  pairs += "[0,0]";
  const std::string head = "dimensions: [4, 4]";
  // As the value of a key, a list is read as it comes.
  EXPECT_TRUE(read("map:\n  " + head + "\n  obstacles: [" + pairs + "]\nagents: []\n").has_value());
  for (const std::string& text :
       {"{map: {" + head + ", obstacles: [" + pairs + "]}, agents: []}",
        "map:\n  " + head + "\n  obstacles:\n  - [" + pairs + "]\nagents: []\n",
        "# " + std::string(2 * text::kMaxYamlLookahead, 'x') + "\nmap:\n  " + head +
            "\nagents: []\n",
        "[" + std::string(2 * text::kMaxYamlLookahead, ',') + "]"}) {
    const auto refused = read(text);
    ASSERT_FALSE(refused.has_value());
    EXPECT_EQ(refused.error().code, ErrorCode::out_of_range);
    EXPECT_NE(refused.error().message.find("in one piece"), std::string::npos)
        << refused.error().to_string();
  }
  // Below the limit all is well.
  pairs.resize(text::kMaxYamlLookahead / 2 / 6 * 6);
  EXPECT_TRUE(
      read("{map: {" + head + ", obstacles: [" + pairs + "[0,0]]}, agents: []}").has_value());
}

TEST(InstanceYaml, WhatIsWrittenIsReadBack) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    const Instance instance = testing::random_grid_instance(seed);
    std::stringstream file;
    ASSERT_EQ(write_instance_yaml(file, "out", instance), std::nullopt);
    const auto again = read_instance_yaml(file, "out");
    ASSERT_TRUE(again.has_value()) << again.error().to_string() << '\n' << file.str();
    EXPECT_TRUE(testing::equal(*again, instance)) << file.str();
  }
}

TEST(InstanceYaml, WriterNeedsAGrid) {
  std::ostringstream out;
  const auto error = write_instance_yaml(out, "out", testing::random_graph_instance(5));
  ASSERT_TRUE(error.has_value());
  EXPECT_EQ(error->code, ErrorCode::invalid_instance);
  EXPECT_EQ(out.str(), "");
}

TEST(InstanceYaml, WriterReportsAFullDisk) {
  const Instance instance = testing::random_grid_instance(1);
  testing::expect_reports_full_disk(
      [&](std::ostream& out) { return write_instance_yaml(out, "out", instance); });
}

}  // namespace
}  // namespace quadrille::discrete
