// SPDX-License-Identifier: MIT
#include "roadmap_input.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <utility>
#include <variant>

#include "arguments.hpp"
#include "quadrille/continuous/quantise.hpp"
#include "quadrille/continuous/roadmap_xml.hpp"
#include "quadrille/discrete/movingai.hpp"

namespace quadrille::cli {
namespace {

using continuous::GridRoadmap;
using continuous::OccupancyGrid;
using continuous::Roadmap;

/// sqrt(2) / 4: on a grid a diagonal move just touches a disc in the cell beside it.
constexpr double kDefaultRadius = 0.35355339059327379;
constexpr int kDefaultNeighbourhood = 3;

bool ends_with(const std::string& text, std::string_view end) {
  return std::string_view(text).ends_with(end);
}

Result<continuous::MapXml> read_map(const std::string& file, double resolution) {
  if (!ends_with(file, ".map"))
    return continuous::read_map_xml(std::filesystem::path(file), resolution);
  auto map = discrete::read_map(std::filesystem::path(file));
  if (!map) return map.error();
  return continuous::MapXml{OccupancyGrid{map->height, map->width, std::move(map->passable)}, 0};
}

Result<continuous::TaskXml> read_task(const std::string& file) {
  if (!ends_with(file, ".scen")) return continuous::read_task_xml(std::filesystem::path(file));
  const auto scenario = discrete::read_scenario(std::filesystem::path(file));
  if (!scenario) return scenario.error();
  continuous::TaskXml task{file, {}};
  for (const discrete::ScenarioRow& row : scenario->rows)
    task.rows.push_back({row.line, std::pair{continuous::Cell{row.start.y, row.start.x},
                                             continuous::Cell{row.goal.y, row.goal.x}}});
  return task;
}

Error out_of_range(const std::string& message) { return {ErrorCode::out_of_range, message, {}}; }

}  // namespace

void add_roadmap_options(CLI::App& app, RoadmapOptions& options) {
  const std::string group = "Continuous time";
  add_file(app, "--roadmap", options.roadmap,
           "Roadmap: GraphML, a grid as XML, or a MovingAI .map file")
      ->group(group);
  add_file(app, "--task", options.task, "Its agents: a task as XML, or a MovingAI .scen file")
      ->group(group);
  add_positive(app, "--radius", options.radius, "Radius of all agents; default sqrt(2)/4")
      ->group(group);
  add_positive(app, "--speed", options.speed, "Speed of all agents; default 1")->group(group);
  add_integer(app, "--neighbourhood", options.neighbourhood, GridRoadmap::kMinNeighbourhood,
              GridRoadmap::kMaxNeighbourhood, "On grids: moves to 2^N neighbours; default 3")
      ->group(group);
  add_positive(app, "--resolution", options.resolution,
               "Size of a tick and of a length unit; default 0.000001")
      ->group(group);
}

std::string check_roadmap_options(const RoadmapOptions& options,
                                  std::optional<std::int64_t> agents) {
  if (options.task.empty()) return "--roadmap needs --task";
  if (agents && *agents < 0) return "--agents is negative";
  return "";
}

Result<RoadmapInput> load_roadmap_input(const RoadmapOptions& options,
                                        std::optional<std::int64_t> agents) {
  const double resolution = options.resolution.value_or(continuous::kDefaultResolution);
  const auto radius =
      continuous::quantise_radius(options.radius.value_or(kDefaultRadius), resolution);
  if (!radius) return out_of_range("the radius and the resolution do not fit together");
  const auto speed = continuous::quantise_speed(options.speed.value_or(1));
  if (!speed) return out_of_range("the speed is not supported");
  auto map = read_map(options.roadmap, resolution);
  if (!map) return map.error();
  const auto task = read_task(options.task);
  if (!task) return task.error();
  const std::size_t count = agents ? static_cast<std::size_t>(*agents) : task->rows.size();

  std::optional<GridRoadmap> grid;
  std::shared_ptr<const Roadmap> roadmap;
  Result<std::vector<continuous::Agent>> made = std::vector<continuous::Agent>();
  std::string kind;
  if (const auto* cells = std::get_if<OccupancyGrid>(&map->map)) {
    const auto k = static_cast<int>(options.neighbourhood.value_or(kDefaultNeighbourhood));
    auto of_grid = GridRoadmap::make(*cells, k, *radius, resolution);
    if (!of_grid) return Error{of_grid.error().code, of_grid.error().message, {options.roadmap, 0}};
    grid = std::move(of_grid).value();
    roadmap = grid->roadmap();
    made = agents_of(*task, count, *grid, *radius, *speed);
    kind = fmt::format("{} x {} grid, 2^{} neighbours, ", cells->width, cells->height, k);
  } else {
    if (options.neighbourhood)
      return Error{ErrorCode::invalid_instance,
                   "--neighbourhood is for grids, and this is a roadmap",
                   {options.roadmap, 0}};
    roadmap = std::make_shared<const Roadmap>(std::get<Roadmap>(std::move(map->map)));
    made = agents_of(*task, count, *roadmap, *radius, *speed);
  }
  if (!made) return made.error();
  auto instance = continuous::Instance::make(roadmap, std::move(made).value(), resolution);
  if (!instance) return Error{instance.error().code, instance.error().message, {options.task, 0}};
  std::string text = fmt::format("roadmap    {}: {}{} vertices, {} edges\n", options.roadmap, kind,
                                 roadmap->num_vertices(), roadmap->num_edges());
  if (map->num_zero_length_edges > 0)
    text += fmt::format("           {} edges of length zero, which take one tick\n",
                        map->num_zero_length_edges);
  text += fmt::format("agents     {} of {} in {}, radius {} and speed {} in units of {}\n", count,
                      task->rows.size(), options.task, *radius, *speed, resolution);
  return RoadmapInput{std::move(instance).value(), std::move(grid), std::move(text)};
}

}  // namespace quadrille::cli
