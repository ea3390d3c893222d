// SPDX-License-Identifier: MIT
#include "input.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <utility>

#include "arguments.hpp"
#include "quadrille/discrete/instance_json.hpp"
#include "quadrille/discrete/instance_yaml.hpp"

namespace quadrille::cli {
namespace {

constexpr std::int64_t kMaxAgents = 1'000'000'000;

void add_letters(CLI::App& app, const std::string& name, std::string& letters,
                 const std::string& help) {
  const auto read = [&letters, name](const std::string& text) {
    if (text.empty()) refuse_value(name, text, "a list of letters");
    letters = text;
  };
  app.add_option_function<std::string>(name, read, help)->type_name("LETTERS");
}

Result<Input> load_map(const InputOptions& options) {
  auto map = discrete::read_map(std::filesystem::path(options.map), options.letters);
  if (!map) return map.error();
  auto graph = std::make_shared<const discrete::Graph>(map->graph());
  if (options.scen.empty()) {
    auto instance = discrete::Instance::make(std::move(graph), {});
    if (!instance) return instance.error();
    return Input{std::move(instance.value()), options.map, "", 0, map->other_letters};
  }
  const auto scenario = discrete::read_scenario(std::filesystem::path(options.scen));
  if (!scenario) return scenario.error();
  const auto agents =
      options.agents ? static_cast<std::size_t>(*options.agents) : scenario->rows.size();
  auto instance = discrete::make_instance(std::move(graph), *scenario, agents);
  if (!instance) return instance.error();
  return Input{std::move(instance.value()), options.map, options.scen, scenario->rows.size(),
               map->other_letters};
}

Result<discrete::Instance> read_instance(const std::string& file) {
  const std::filesystem::path path(file);
  const std::string extension = path.extension().string();
  if (extension == ".json") return discrete::read_instance_json(path);
  if (extension == ".yaml" || extension == ".yml") return discrete::read_instance_yaml(path);
  std::error_code ignored;
  // A folder opens like a file; the reader of paths words that error.
  if (std::filesystem::is_directory(path, ignored)) return discrete::read_instance_json(path);
  std::ifstream in(path, std::ios::binary);
  if (!in) return discrete::read_instance_json(path);
  // One look, nothing consumed: the file may be a pipe.
  if (in.peek() == '{') return discrete::read_instance_json(in, file);
  in.clear();
  return discrete::read_instance_yaml(in, file);
}

}  // namespace

void add_input_options(CLI::App& app, InputOptions& options) {
  const std::string group = "Instance";
  add_file(app, "--map", options.map, "Map in MovingAI's format")->group(group);
  add_file(app, "--scen", options.scen, "Scenario in MovingAI's format")->group(group);
  add_integer(app, "--agents", options.agents, 0, kMaxAgents, "Take the first N rows of --scen")
      ->group(group);
  add_file(app, "--instance", options.instance,
           "Instead: one file, quadrille's JSON or libMultiRobotPlanning's YAML")
      ->group(group);
  add_letters(app, "--passable", options.letters.passable,
              "Map letters that are passable besides . and G");
  add_letters(app, "--blocked", options.letters.blocked,
              "Map letters that are blocked besides @, O and T");
  for (const char* name : {"--passable", "--blocked"}) app.get_option(name)->group(group);
}

std::string check_input_options(const InputOptions& options, Need need) {
  const bool letters = !options.letters.passable.empty() || !options.letters.blocked.empty();
  if (!options.instance.empty()) {
    if (!options.map.empty() || !options.scen.empty())
      return "--instance excludes --map and --scen";
    if (options.agents) return "--agents belongs to --scen, not to --instance";
    if (letters) return "--passable and --blocked belong to --map, not to --instance";
    return "";
  }
  if (options.map.empty())
    return need == Need::tasks ? "an instance is needed: --map, --scen and --agents, or --instance"
                               : "--map or --instance is needed";
  if (options.scen.empty() && (need == Need::tasks || options.agents)) return "--scen is missing";
  if (need == Need::tasks && !options.agents) return "--agents is missing";
  return "";
}

Result<Input> load_input(const InputOptions& options) {
  if (options.instance.empty()) return load_map(options);
  auto instance = read_instance(options.instance);
  if (!instance) return instance.error();
  return Input{std::move(instance.value()), options.instance, options.instance, 0, {}};
}

std::string describe_graph(const discrete::Graph& graph) {
  const std::string shape = graph.layout() ? fmt::format("{} x {} grid", graph.layout()->width(),
                                                         graph.layout()->height())
                                           : "graph";
  return fmt::format("{}, {} vertices, {} edges", shape, graph.num_vertices(), graph.num_edges());
}

std::string describe_input(const Input& input) {
  std::string text =
      fmt::format("map        {}: {}\n", input.source, describe_graph(input.instance.graph()));
  for (const discrete::LetterCount& letter : input.other_letters)
    text += fmt::format("letters    {} cells '{}' read as {}\n", letter.cells, letter.letter,
                        letter.passable ? "passable" : "blocked");
  if (input.task_source.empty()) return text;
  text += fmt::format("agents     {} from {}", input.instance.num_agents(), input.task_source);
  if (input.rows > 0) text += fmt::format(" (of {} rows)", input.rows);
  return text + "\n";
}

CLI::Option* add_plan_format(CLI::App& app, const std::string& name,
                             std::optional<discrete::PlanFormat>& format, const std::string& help) {
  const auto read = [&format, name](const std::string& text) {
    format = discrete::parse_plan_format(text);
    if (!format) refuse_value(name, text, "json, cbsh2, visualizer or yaml");
  };
  return app.add_option_function<std::string>(name, read, help)->type_name("FORMAT");
}

}  // namespace quadrille::cli
