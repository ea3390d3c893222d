// SPDX-License-Identifier: MIT
// Instances in timesteps, as files.
#include <algorithm>
#include <sstream>
#include <utility>
#include <vector>

#include "cli/files/inputs.hpp"
#include "quadrille/core/contract.hpp"
#include "quadrille/discrete/instance_json.hpp"
#include "quadrille/discrete/instance_yaml.hpp"
#include "support/generators.hpp"

namespace quadrille::cli::test {
namespace {

using discrete::Instance;

constexpr discrete::support::GridShape kShape{1, 5, 30, 1, 4};

/// Perhaps fewer agents than there are.
void limit_agents(Random& random, Input& input) {
  if (!random.percent(25)) return;
  input.num_agents = random.below(input.num_agents + 1);
  input.options = input.options + Words{"--agents", std::to_string(input.num_agents)};
}

/// Letters of all kinds; `input` names those that nobody knows.
std::string map_text(Random& random, const Instance& instance, Input& input) {
  const auto& grid = *instance.graph().layout();
  const bool odd = random.percent(30);
  const std::string free = odd ? ".GS" : ".", blocked = odd ? "@TOW" : "@";
  std::string text = "type octile\nheight " + std::to_string(grid.height()) + "\nwidth " +
                     std::to_string(grid.width()) + "\nmap\n";
  for (std::int32_t y = 0; y < grid.height(); ++y) {
    for (std::int32_t x = 0; x < grid.width(); ++x) {
      const std::string& letters = grid.vertex_at({x, y}) ? free : blocked;
      text += letters[random.below(letters.size())];
    }
    text += '\n';
  }
  if (odd) input.map = {"--passable", "S", "--blocked", "W"};
  return text;
}

std::string scenario_text(const Instance& instance) {
  const auto& grid = *instance.graph().layout();
  std::string text = "version 1\n";
  for (const discrete::Agent& agent : instance.agents()) {
    text += "0\tany.map\t" + std::to_string(grid.width()) + "\t" + std::to_string(grid.height());
    for (const VertexId v : {agent.start, agent.goal()}) {
      const discrete::Cell cell = grid.cell_of(v);
      text += "\t" + std::to_string(cell.x) + "\t" + std::to_string(cell.y);
    }
    text += "\t1\n";
  }
  return text;
}

Input movingai(Random& random, FileNames& names) {
  const Instance instance = discrete::support::random_grid(random, kShape);
  Input input;
  const std::string map = names.next(".map"), scenario = names.next(".scen");
  write_file(map, map_text(random, instance, input));
  write_file(scenario, scenario_text(instance));
  input.num_agents = random.below(instance.num_agents() + 1);
  input.map = Words{"--map", map} + input.map;
  input.options =
      input.map + Words{"--scen", scenario, "--agents", std::to_string(input.num_agents)};
  return input;
}

/// Made by the program: a map with its agents, or both one after the other.
Input generated(Random& random, Workshop& workshop, FileNames& names) {
  const std::vector<Words> kinds = {
      {"empty", "--width", "4", "--height", "3"},
      {"random", "--width", "5", "--height", "4", "--obstacles", "0.2"},
      {"maze", "--width", "6", "--height", "5", "--corridor-width", "1"},
      {"room", "--width", "7", "--height", "7", "--room-size", "3", "--doors", "0.3"},
      {"warehouse", "--shelf-columns", "1", "--shelf-rows", "2", "--shelf-length", "2",
       "--shelf-width", "1", "--side-width", "1"}};
  Input input;
  input.num_agents = random.between(1, 3);
  const std::string map = names.next(".map"), scenario = names.next(".scen");
  const Words agents = {"--agents", std::to_string(input.num_agents),  "--scen-output", scenario,
                        "--seed",   std::to_string(random.below(1000))};
  const bool apart = random.percent(50);
  Words words = Words{"generate", "--kind"} + random.pick(kinds) + Words{"--map-output", map};
  QUADRILLE_REQUIRE(workshop.run(apart ? words : words + agents).code == 0, "a map is made");
  if (apart) {
    words = Words{"generate", "--map", map} + agents;
    if (random.percent(50)) words.emplace_back("--any-goal");
    QUADRILLE_REQUIRE(workshop.run(words).code == 0, "a scenario is made");
  }
  input.map = {"--map", map};
  input.options =
      input.map + Words{"--scen", scenario, "--agents", std::to_string(input.num_agents)};
  return input;
}

Input one_file(Random& random, FileNames& names) {
  Input input;
  input.has_cells = random.percent(60);
  Instance instance = input.has_cells ? discrete::support::random_grid(random, kShape)
                                      : discrete::support::random_graph(random, 7, 3);
  const bool is_yaml = input.has_cells && random.percent(40);
  if (!is_yaml && random.percent(30))
    instance = discrete::support::with_more_goals(random, instance);
  std::ostringstream text;
  const auto error =
      is_yaml ? write_instance_yaml(text, "", instance) : write_instance_json(text, "", instance);
  QUADRILLE_REQUIRE(!error, "it can be written");
  // The ending of the name is not always that of the format.
  const std::vector<std::string> endings = {".json", ".yaml", ".yml", ".txt", ""};
  const std::string file =
      names.next(random.percent(50) ? (is_yaml ? ".yaml" : ".json") : random.pick(endings));
  write_file(file, text.str());
  input.options = {"--instance", file};
  input.num_agents = instance.num_agents();
  limit_agents(random, input);
  for (std::size_t i = 0; i < input.num_agents; ++i)
    if (!instance.agents()[AgentId(i)].goals.is_single()) input.has_goal_sets = true;
  return input;
}

}  // namespace

Input draw_steps(Random& random, Workshop& workshop, FileNames& names) {
  switch (random.below(3)) {
    case 0:
      return movingai(random, names);
    case 1:
      return generated(random, workshop, names);
    default:
      return one_file(random, names);
  }
}

std::string FileNames::next(const std::string& ending) {
  const std::string number = std::to_string(++count_);
  const std::vector<std::string> stems = {"a file ",       "it's \"",  "\xc3\xa4\xe2\x82\xac",
                                          "no utf-8 \xff", "a&<b>]]>", "line\nbreak",
                                          "\x01 control",  "%s\\n$x",  "a.json.b"};
  std::string stem = random_.percent(30) ? random_.pick(stems) : "f";
  if (random_.percent(20)) stem = "./" + stem;
  if (random_.percent(10)) stem = (std::filesystem::current_path() / stem).string();
  return stem + number + ending;
}

}  // namespace quadrille::cli::test
