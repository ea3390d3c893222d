// SPDX-License-Identifier: MIT
#include "quadrille/input/grid.hpp"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <sstream>
#include <utility>
#include <variant>
#include <vector>

#include "quadrille/discrete/instance_json.hpp"
#include "quadrille/discrete/instance_yaml.hpp"
#include "quadrille/input/robot_runners.hpp"
#include "quadrille/text/sniff.hpp"
#include "shared_goals.hpp"

namespace quadrille::input {
namespace {

/// The name of the map that a scenario was made for, if that is not `map`: a scenario for another
/// map of the same size is read without complaint. Empty if all is well.
std::string name_other_map(const discrete::Scenario& scenario, const std::string& map) {
  if (scenario.rows.empty() || map == kStandardInput) return "";
  const std::filesystem::path named(scenario.rows.front().map);
  return named.stem() == std::filesystem::path(map).stem() ? "" : named.string();
}

/// With the rules that options give to all agents.
Result<discrete::Instance> with_rules(const discrete::Instance& instance,
                                      const InputOptions& options) {
  if (!options.leave && !options.robust && !options.whole_moves) return instance;
  std::vector<discrete::Agent> agents(instance.agents().begin(), instance.agents().end());
  for (discrete::Agent& agent : agents) agent.leaves = agent.leaves || options.leave;
  discrete::Rules rules = instance.rules();
  if (options.robust) rules.robust = static_cast<Timestep>(*options.robust);
  if (options.whole_moves) rules.robust = std::max(rules.robust, Timestep{1});
  return discrete::Instance::make(instance.shared_graph(), std::move(agents), instance.now(),
                                  std::move(rules));
}

Result<GridInput> load_map(const InputOptions& options) {
  auto map = discrete::read_map(std::filesystem::path(options.map), options.letters);
  if (!map) return with_letters_hint(map.error());
  if (auto error = check_map_size(options, map->num_passable(), options.map))
    return *std::move(error);
  auto graph = std::make_shared<const discrete::Graph>(map->graph());
  if (options.scen.empty()) {
    auto instance = discrete::Instance::make(std::move(graph), {});
    if (!instance) return instance.error();
    return GridInput{std::move(instance.value()), options.map, "", 0, map->other_letters, ""};
  }
  const auto scenario = discrete::read_scenario(std::filesystem::path(options.scen));
  if (!scenario) return scenario.error();
  const auto agents =
      options.agents ? static_cast<std::size_t>(*options.agents) : scenario->rows.size();
  auto instance = discrete::make_instance(std::move(graph), *scenario, agents);
  if (instance) instance = with_shared_goals(std::move(instance).value(), options);
  if (instance) instance = with_rules(*instance, options);
  if (!instance) return instance.error();
  return GridInput{std::move(instance.value()),
                   options.map,
                   options.scen,
                   scenario->rows.size(),
                   map->other_letters,
                   name_other_map(*scenario, options.map),
                   {},
                   note_on_sizes(*scenario, map->width, map->height)};
}

/// The contents decide, whatever the name; it helps where they may be either.
bool is_yaml(const std::string& text, const std::string& extension) {
  const auto first = text.find_first_not_of(" \t\r\n");
  const char begin = first == std::string::npos ? '\0' : text[first];
  if (begin == '{')
    return (extension == ".yaml" || extension == ".yml") &&
           text.find("\"quadrille\"") == std::string::npos;
  return extension != ".json" || (begin >= 'a' && begin <= 'z');
}

Result<discrete::Instance> read_instance(const InputOptions& options, text::Names& names) {
  const std::filesystem::path path(options.instance);
  const std::string extension = path.extension().string();
  if (!options.instance_text) {
    // It cannot be read, and the reader of paths words why.
    if (extension == ".yaml" || extension == ".yml") return discrete::read_instance_yaml(path);
    return discrete::read_instance_json(path);
  }
  if (auto error =
          text::refuse_other(*options.instance_text, options.instance,
                             {text::FileKind::own_instance, text::FileKind::own_roadmap,
                              text::FileKind::libmrp_instance, text::FileKind::libmrp_roadmap}))
    return *error;
  std::istringstream in(*options.instance_text);
  return is_yaml(*options.instance_text, extension)
             ? discrete::read_instance_yaml(in, options.instance, options.most_vertices, &names)
             : discrete::read_instance_json(in, options.instance, options.most_vertices, &names);
}

/// A problem of the League of Robot Runners, whose robots go in all directions at once.
Result<GridInput> read_robot_problem(const InputOptions& options) {
  const auto problem = read_robot_runners(*options.instance_text, options.instance);
  if (!problem) return problem.error();
  const continuous::OccupancyGrid& cells = problem->cells;
  const auto graph = std::make_shared<const discrete::Graph>(
      discrete::Graph::grid(cells.width, cells.height, cells.passable));
  const auto vertex = [&](std::int64_t cell) {
    const auto width = std::int64_t{cells.width};
    return graph->layout()
        ->vertex_at(
            {static_cast<std::int32_t>(cell % width), static_cast<std::int32_t>(cell / width)})
        .value();
  };
  std::vector<discrete::Agent> agents;
  for (const continuous::TaskRow& row : problem->task.rows) {
    const auto& [start, goal] = std::get<std::pair<std::int64_t, std::int64_t>>(row.places);
    agents.push_back({vertex(start), vertex(goal)});
  }
  const std::size_t rows = agents.size();
  if (auto error = check_agents(options, rows)) return *std::move(error);
  if (options.agents) agents.resize(static_cast<std::size_t>(*options.agents));
  // Several tasks may begin in one place, and robots only go where these lead them.
  for (discrete::Agent& agent : agents) agent.goals = agent.start;
  auto instance = discrete::Instance::make(graph, std::move(agents));
  if (!instance) return instance.error();
  GridInput read{std::move(instance).value(), options.instance, options.instance, rows, {}, ""};
  for (const auto& places : problem->all_tasks) {
    auto& task = read.tasks.emplace_back();
    for (const std::int64_t cell : places) task.emplace_back(vertex(cell));
  }
  read.num_revealed = problem->num_revealed;
  read.note = "robots go in all directions at once; those of the problem turn";
  return read;
}

}  // namespace

std::optional<Error> refuse_rules(const GridInput& grid) {
  if (grid.instance.is_plain()) return std::nullopt;
  return Error{ErrorCode::invalid_instance,
               "robots that are sent about on a grid know no rules: one-way edges, agents that "
               "leave, releases, deadlines, waypoints, obstacles, robust plans, turns",
               {grid.source, 0}};
}

std::string check_grid_options(const InputOptions& options, Need need) {
  if (options.sharing && options.scen.empty()) return kSharingNeedsTask;
  const bool letters = !options.letters.passable.empty() || !options.letters.blocked.empty();
  if (!options.instance.empty()) {
    if (!options.map.empty() || !options.scen.empty())
      return "--instance excludes --map and --scen";
    if (letters) return "--passable and --blocked belong to --map, not to --instance";
    return "";
  }
  if (options.map.empty())
    return need != Need::map ? "an instance is needed: --map, --scen and --agents, or --instance"
                             : "--map or --instance is needed";
  if (options.scen.empty() && (need == Need::tasks || options.agents)) return "--scen is missing";
  const bool needs_agents = need == Need::tasks || (need == Need::plan && !options.scen.empty());
  if (needs_agents && !options.agents) return "--agents is missing";
  return "";
}

Result<GridInput> load_grid_input(const InputOptions& options) {
  if (options.instance.empty()) return load_map(options);
  if (options.instance_text && is_robot_runners(*options.instance_text))
    return read_robot_problem(options);
  text::Names names;
  auto instance = read_instance(options, names);
  if (!instance) return instance.error();
  if (auto error = check_agents(options, instance->num_agents())) return *std::move(error);
  if (options.agents) {
    std::vector<discrete::Agent> agents(instance->agents().begin(), instance->agents().end());
    agents.resize(static_cast<std::size_t>(*options.agents));
    instance = instance->with_agents(std::move(agents));
    names.agents.resize(static_cast<std::size_t>(*options.agents));
  }
  if (instance) instance = with_rules(*instance, options);
  if (!instance) return instance.error();
  return GridInput{
      std::move(instance.value()), options.instance, options.instance, 0, {}, "", std::move(names)};
}

bool is_map_alone(const InputOptions& options) {
  return options.instance.empty() && options.scen.empty();
}

Result<GridInput> with_agents_of(GridInput input, const discrete::Plan& plan,
                                 const std::string& file) {
  std::vector<discrete::Agent> agents;
  for (const discrete::Path& path : plan.paths) agents.push_back({path.front(), path.back()});
  auto instance =
      discrete::Instance::make(input.instance.shared_graph(), std::move(agents), plan.now);
  if (!instance) return Error{ErrorCode::invalid_plan, instance.error().message, {file, 0}};
  input.instance = std::move(instance).value();
  input.task_source = file;
  return input;
}

}  // namespace quadrille::input
