// SPDX-License-Identifier: MIT
#include "quadrille/input/grid.hpp"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <sstream>
#include <utility>

#include "quadrille/discrete/instance_json.hpp"
#include "quadrille/discrete/instance_yaml.hpp"
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

}  // namespace

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
