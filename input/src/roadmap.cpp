// SPDX-License-Identifier: MIT
#include "quadrille/input/roadmap.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <utility>
#include <variant>
#include <vector>

#include "quadrille/continuous/instance_json.hpp"
#include "quadrille/continuous/map_file.hpp"
#include "quadrille/continuous/quantise.hpp"
#include "quadrille/continuous/roadmap_xml.hpp"
#include "quadrille/core/decimal.hpp"
#include "quadrille/discrete/movingai.hpp"
#include "quadrille/input/grid.hpp"
#include "quadrille/input/robot_runners.hpp"
#include "quadrille/text/sniff.hpp"
#include "quadrille/text/text_input.hpp"
#include "roadmap_numbers.hpp"
#include "shared_goals.hpp"

namespace quadrille::input {
namespace {

using continuous::GridRoadmap;
using continuous::Heading;
using continuous::Instance;
using continuous::MapFile;
using continuous::OccupancyGrid;
using continuous::PoseGrid;
using continuous::Roadmap;

constexpr int kDefaultNeighbourhood = 3;
constexpr const char* kTurnAlone = "--turn needs --headings";

bool is_movingai_map(const std::string& file) { return std::string_view(file).ends_with(".map"); }

template <class Size>
std::string size_text(Size width, Size height) {
  return std::to_string(width) + " x " + std::to_string(height);
}

Result<MapFile> read_map(const std::string& file, const discrete::MapOptions& letters,
                         const continuous::MapFileOptions& options) {
  const auto text = read_text(file);
  if (!text) return text.error();
  std::istringstream in(*text);
  const auto kind = text::sniff(*text);
  const bool is_other = kind != text::FileKind::movingai_map &&
                        (kind != text::FileKind::unknown || !is_movingai_map(file));
  if (is_other) return continuous::read_map_file(in, file, options);
  auto map = discrete::read_map(in, file, letters);
  if (!map) return with_letters_hint(map.error());
  return MapFile{OccupancyGrid{map->height, map->width, std::move(map->passable)}};
}

/// `grid`: what the cells of a scenario belong to, if the map is one.
Result<continuous::TaskXml> read_task(const std::string& file, const OccupancyGrid* grid,
                                      std::vector<std::string>& notes) {
  const auto text = read_text(file);
  if (!text) return text.error();
  std::istringstream in(*text);
  const auto kind = text::sniff(*text);
  if (kind != text::FileKind::movingai_scenario &&
      (kind != text::FileKind::unknown || !std::string_view(file).ends_with(".scen")))
    return continuous::read_task_xml(in, file);
  const auto scenario = discrete::read_scenario(in, file);
  if (!scenario) return scenario.error();
  continuous::TaskXml task{file, {}};
  if (grid != nullptr)
    if (auto note = note_on_sizes(*scenario, grid->width, grid->height); !note.empty())
      notes.push_back(file + ": " + note);
  for (const discrete::ScenarioRow& row : scenario->rows)
    task.rows.push_back({row.line, std::pair{continuous::Cell{row.start.x, row.start.y},
                                             continuous::Cell{row.goal.x, row.goal.y}}});
  return task;
}

std::optional<Error> check_cells(const InputOptions& input, const OccupancyGrid& cells,
                                 const std::string& file) {
  return check_map_size(input, std::count(cells.passable.begin(), cells.passable.end(), true),
                        file);
}

Error out_of_range(const std::string& message) { return {ErrorCode::out_of_range, message, {}}; }

Result<RoadmapInput> read_instance(const InputOptions& input) {
  std::istringstream in(*input.instance_text);
  text::Names names;
  auto instance = continuous::read_instance_json(in, input.instance, &names);
  if (!instance) return instance.error();
  if (auto error = check_agents(input, instance->num_agents())) return *std::move(error);
  if (input.agents) {
    std::vector<continuous::Agent> agents(instance->agents().begin(), instance->agents().end());
    agents.resize(static_cast<std::size_t>(*input.agents));
    instance = instance->with_agents(std::move(agents));
    names.agents.resize(static_cast<std::size_t>(*input.agents));
  }
  RoadmapInput read{std::move(instance).value()};
  read.source = read.task_source = input.instance;
  read.rows = read.instance.num_agents();
  read.names = std::move(names);
  return read;
}

/// What is wrong with the options where `--headings` is given; empty if nothing is.
std::string check_turning_options(const RoadmapOptions& options, const InputOptions& input,
                                  Need need) {
  if (!options.roadmap.empty() || !input.instance.empty())
    return "--headings goes with --map and --scen, not with --roadmap or --instance";
  if (!options.task.empty() || options.radius || options.speed || options.resolution ||
      options.neighbourhood || !options.level.empty() || !options.vehicle_type.empty() ||
      options.overlap_at_start)
    return "--task, --radius, --speed, --neighbourhood, --level, --vehicle-type, --resolution "
           "and --overlap-at-start do not go with --headings";
  if (*options.headings != kHeadings)
    return "--headings is " + std::to_string(kHeadings) + ": east, south, west and north";
  return check_grid_options(input, need);
}

/// An instance of these agents. `source` and `task`: where roadmap and agents come from.
Result<Instance> make_instance(std::shared_ptr<const Roadmap> roadmap,
                               std::vector<continuous::Agent> agents,
                               const continuous::Resolution& resolution, const std::string& source,
                               const continuous::TaskXml& task, const InputOptions& input) {
  std::vector<SourcePlace> places;
  for (std::size_t i = 0; i < agents.size(); ++i) places.push_back({task.file, task.rows[i].line});
  auto instance = Instance::make(std::move(roadmap), std::move(agents), resolution, places);
  if (instance) instance = with_shared_goals(std::move(instance).value(), input);
  if (instance) return instance;
  Error error = instance.error();
  if (error.where.file.empty()) error.where.file = source;
  return error;
}

std::size_t num_agents(const InputOptions& input, const continuous::TaskXml& task) {
  return input.agents ? static_cast<std::size_t>(*input.agents) : task.rows.size();
}

/// Where robots that turn come from.
struct TurningSource {
  OccupancyGrid cells;
  continuous::TaskXml task;
  std::int64_t turn = 1;
  std::string file, task_file;
  std::vector<std::string> notes = {};
};

/// They begin facing east, and end with any heading.
Result<RoadmapInput> turning_input(const TurningSource& from, const InputOptions& input) {
  if (auto error = check_cells(input, from.cells, from.file)) return *std::move(error);
  auto poses = PoseGrid::make(from.cells, continuous::Ticks(from.turn));
  if (!poses) return Error{poses.error().code, poses.error().message, {from.file, 0}};
  const auto speed = continuous::quantise_speed(1, PoseGrid::kResolution);
  auto agents = agents_of(from.task, num_agents(input, from.task), poses->cells(),
                          PoseGrid::kRadius, speed.value());
  if (!agents) return agents.error();
  for (continuous::Agent& agent : *agents) {
    agent.start = poses->vertex({poses->cells().cell(agent.start), Heading::east}).value();
    agent.goals = poses->any_heading(poses->cells().cell(agent.goal())).value();
  }
  auto instance = make_instance(poses->roadmap(), std::move(agents).value(), PoseGrid::kResolution,
                                from.file, from.task, input);
  if (!instance) return instance.error();
  RoadmapInput read{std::move(instance).value()};
  read.source = from.file;
  read.task_source = from.task_file;
  read.rows = from.task.rows.size();
  read.kind = size_text(from.cells.width, from.cells.height) + " grid, 4 headings, turns of " +
              std::to_string(from.turn) + (from.turn == 1 ? " timestep, " : " timesteps, ");
  read.poses = std::move(poses).value();
  read.notes = from.notes;
  return read;
}

Result<RoadmapInput> read_turning(const RoadmapOptions& options, const InputOptions& input) {
  auto map = read_map(input.map, input.letters, {1, continuous::kUnitSpeed});
  if (!map) return map.error();
  auto* const cells = std::get_if<OccupancyGrid>(&map->map);
  if (cells == nullptr)
    return Error{ErrorCode::invalid_instance, "--headings needs a grid", {input.map, 0}};
  TurningSource from{std::move(*cells), {}, options.turn.value_or(1), input.map, input.scen};
  if (!input.scen.empty()) {
    auto task = read_task(input.scen, &from.cells, from.notes);
    if (!task) return task.error();
    from.task = std::move(task).value();
  }
  return turning_input(from, input);
}

/// A problem of the League of Robot Runners.
Result<RoadmapInput> read_robot_problem(const InputOptions& input) {
  auto problem = read_robot_runners(*input.instance_text, input.instance);
  if (!problem) return problem.error();
  if (auto error = check_agents(input, problem->task.rows.size())) return *std::move(error);
  const std::int32_t width = problem->cells.width;
  auto made = turning_input(
      {std::move(problem->cells), std::move(problem->task), 1, input.instance, input.instance},
      input);
  if (!made) return made;
  for (const auto& cells : problem->all_tasks) {
    auto& task = made->tasks.emplace_back();
    for (const std::int64_t cell : cells)
      task.push_back(made->poses
                         ->any_heading({static_cast<std::int32_t>(cell % width),
                                        static_cast<std::int32_t>(cell / width)})
                         .value());
  }
  made->num_revealed = problem->num_revealed;
  return made;
}

}  // namespace

Result<Numbers> quantise(const RoadmapOptions& options) {
  const double resolution = options.resolution.value_or(continuous::kDefaultResolution);
  const auto radius =
      continuous::quantise_radius(options.radius.value_or(kDefaultRadius), resolution);
  if (!radius)
    return out_of_range("--radius: " + decimal(options.radius.value_or(kDefaultRadius)) +
                        " is less than one length unit, or too large");
  const auto speed = continuous::quantise_speed(options.speed.value_or(1), resolution);
  if (!speed)
    return out_of_range("--speed: " + decimal(options.speed.value_or(1)) +
                        " is not between 0.000001 and 1000000");
  return Numbers{resolution, *radius, *speed};
}

bool is_roadmap(InputOptions& input, const RoadmapOptions& options) {
  if (!input.instance.empty()) {
    std::ifstream in;
    if (text::open_input(input.instance, in)) return options.name_roadmap();
    auto text = text::read_all(in, input.instance);
    if (text) input.instance_text = std::move(text).value();
    if (input.instance_text && (continuous::is_roadmap_json(*input.instance_text) ||
                                is_robot_runners(*input.instance_text)))
      return true;
  }
  return options.name_roadmap();
}

std::string check_roadmap_options(const RoadmapOptions& options, const InputOptions& input,
                                  Need need) {
  if (input.leave || input.robust) return kRulesNeedGrid;
  if (options.headings) return check_turning_options(options, input, need);
  const auto has_task = [&] {
    return !options.task.empty() || (input.instance_text && is_robot_runners(*input.instance_text));
  };
  if (input.sharing && !has_task()) return kSharingNeedsTask;
  if (options.turn) return kTurnAlone;
  const bool letters = !input.letters.passable.empty() || !input.letters.blocked.empty();
  if (!options.roadmap.empty()) {
    if (!input.map.empty() || !input.scen.empty() || !input.instance.empty())
      return "--roadmap goes with --task, not with --map, --scen or --instance";
    if (letters && !is_movingai_map(options.roadmap))
      return "--passable and --blocked belong to .map files";
    if (options.task.empty() && (need == Need::tasks || input.agents)) return "--task is missing";
    const auto numbers = quantise(options);
    return numbers ? "" : numbers.error().message;
  }
  if (!input.map.empty() || !input.scen.empty()) return "--instance excludes --map and --scen";
  if (letters) return "--passable and --blocked belong to .map files, not to --instance";
  return why_no_roadmap(options);
}

std::string why_no_roadmap(const RoadmapOptions& options) {
  if (options.turn) return kTurnAlone;
  if (options.overlap_at_start)
    return "--overlap-at-start belongs to --roadmap; in --instance agents have "
           "\"overlap_at_start\"";
  if (options.task.empty() && !options.radius && !options.speed && !options.resolution &&
      !options.neighbourhood && options.level.empty() && options.vehicle_type.empty())
    return "";
  return "--task, --radius, --speed, --neighbourhood, --level, --vehicle-type and --resolution "
         "belong to --roadmap";
}

namespace {

Result<RoadmapInput> load_roadmap(const RoadmapOptions& options, const InputOptions& input) {
  const auto numbers = quantise(options);
  if (!numbers) return numbers.error();
  auto map = read_map(options.roadmap, input.letters,
                      {numbers->resolution, numbers->speed, options.level, options.vehicle_type});
  if (!map) return map.error();
  const auto* const cells = std::get_if<OccupancyGrid>(&map->map);
  if (cells != nullptr)
    if (auto error = check_cells(input, *cells, options.roadmap)) return *std::move(error);
  continuous::TaskXml task;
  if (!options.task.empty()) {
    auto read = read_task(options.task, cells, map->notes);
    if (!read) return read.error();
    task = std::move(read).value();
  }
  const std::size_t count = num_agents(input, task);

  std::optional<GridRoadmap> grid;
  std::shared_ptr<const Roadmap> roadmap;
  Result<std::vector<continuous::Agent>> agents = std::vector<continuous::Agent>();
  std::string kind;
  if (cells != nullptr) {
    const auto k = static_cast<int>(options.neighbourhood.value_or(kDefaultNeighbourhood));
    auto made = GridRoadmap::make(*cells, k, numbers->radius, numbers->resolution);
    if (!made) return Error{made.error().code, made.error().message, {options.roadmap, 0}};
    grid = std::move(made).value();
    roadmap = grid->roadmap();
    agents = agents_of(task, count, *grid, numbers->radius, numbers->speed);
    kind =
        size_text(cells->width, cells->height) + " grid, 2^" + std::to_string(k) + " neighbours, ";
  } else {
    if (options.neighbourhood)
      return Error{ErrorCode::invalid_instance,
                   "--neighbourhood is for grids, and this is a roadmap",
                   {options.roadmap, 0}};
    roadmap = std::make_shared<const Roadmap>(std::get<Roadmap>(std::move(map->map)));
    agents = agents_of(task, count, *roadmap, numbers->radius, numbers->speed, map->names);
  }
  if (!agents) return agents.error();
  for (continuous::Agent& agent : *agents) agent.overlaps_at_start = options.overlap_at_start;
  auto instance = make_instance(std::move(roadmap), std::move(agents).value(), numbers->resolution,
                                options.roadmap, task, input);
  if (!instance) return instance.error();
  RoadmapInput read{std::move(instance).value(), std::move(grid)};
  read.source = options.roadmap;
  read.task_source = options.task;
  read.rows = task.rows.size();
  read.kind = std::move(kind);
  read.num_zero_length_edges = map->num_zero_length_edges;
  read.notes = std::move(map->notes);
  if (map->names.are_ids)
    for (const std::string& id : map->names.of_vertices)
      read.names.vertices.push_back(text::quoted_json(id));
  return read;
}

}  // namespace

Result<RoadmapInput> load_roadmap_input(const RoadmapOptions& options, const InputOptions& input) {
  auto read = options.headings                         ? read_turning(options, input)
              : !options.roadmap.empty()               ? load_roadmap(options, input)
              : is_robot_runners(*input.instance_text) ? read_robot_problem(input)
                                                       : read_instance(input);
  if (read && input.whole_moves) read->instance = read->instance.with_whole_moves();
  return read;
}

}  // namespace quadrille::input
