// SPDX-License-Identifier: MIT
#include "roadmap/roadmap_input.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <utility>
#include <variant>
#include <vector>

#include "arguments.hpp"
#include "output.hpp"
#include "quadrille/continuous/duration_error.hpp"
#include "quadrille/continuous/instance_json.hpp"
#include "quadrille/continuous/nav_graph.hpp"
#include "quadrille/continuous/quantise.hpp"
#include "quadrille/continuous/roadmap_xml.hpp"
#include "quadrille/discrete/movingai.hpp"
#include "quadrille/text/text_input.hpp"

namespace quadrille::cli {
namespace {

using continuous::GridRoadmap;
using continuous::Instance;
using continuous::OccupancyGrid;
using continuous::Roadmap;

constexpr int kDefaultNeighbourhood = 3;

bool is_movingai_map(const std::string& file) { return std::string_view(file).ends_with(".map"); }
bool is_nav_graph(const std::string& file) {
  return std::string_view(file).ends_with(".yaml") || std::string_view(file).ends_with(".yml");
}

Result<std::string> text_of(const std::string& file) {
  std::ifstream in;
  if (auto error = text::open_input(file, in)) return *error;
  return text::read_all(in, file);
}

Result<continuous::MapXml> read_map(const std::string& file, const discrete::MapOptions& letters,
                                    double resolution, continuous::Speed speed) {
  if (is_nav_graph(file)) {
    auto graph = continuous::read_nav_graph(std::filesystem::path(file), resolution, speed);
    if (!graph) return graph.error();
    return continuous::MapXml{std::move(graph->roadmap), graph->num_zero_length_edges};
  }
  const auto text = text_of(file);
  if (!text) return text.error();
  std::istringstream in(*text);
  // The program writes maps to files of any name.
  if (!is_movingai_map(file) && !text->starts_with("type "))
    return continuous::read_map_xml(in, file, resolution);
  auto map = discrete::read_map(in, file, letters);
  if (!map) return with_letters_hint(map.error());
  return continuous::MapXml{OccupancyGrid{map->height, map->width, std::move(map->passable)}, 0};
}

/// `grid`: what the cells of a scenario belong to, if the map is one.
Result<continuous::TaskXml> read_task(const std::string& file, const OccupancyGrid* grid) {
  const auto text = text_of(file);
  if (!text) return text.error();
  std::istringstream in(*text);
  if (!std::string_view(file).ends_with(".scen") && !text->starts_with("version "))
    return continuous::read_task_xml(in, file);
  const auto scenario = discrete::read_scenario(in, file);
  if (!scenario) return scenario.error();
  continuous::TaskXml task{file, {}};
  for (const discrete::ScenarioRow& row : scenario->rows) {
    if (grid != nullptr && (row.width != grid->width || row.height != grid->height))
      return Error{ErrorCode::invalid_instance,
                   fmt::format("the row is for a map of {} x {} cells, not {} x {}", row.width,
                               row.height, grid->width, grid->height),
                   {file, row.line}};
    task.rows.push_back({row.line, std::pair{continuous::Cell{row.start.x, row.start.y},
                                             continuous::Cell{row.goal.x, row.goal.y}}});
  }
  return task;
}

Error out_of_range(const std::string& message) { return {ErrorCode::out_of_range, message, {}}; }

/// What all agents have in common.
struct Numbers {
  double resolution;
  continuous::Length radius;
  continuous::Speed speed;
};

Result<Numbers> quantise(const RoadmapOptions& options) {
  const double resolution = options.resolution.value_or(continuous::kDefaultResolution);
  const auto radius =
      continuous::quantise_radius(options.radius.value_or(kDefaultRadius), resolution);
  if (!radius)
    return out_of_range(fmt::format("--radius: {} is less than one length unit, or too large",
                                    options.radius.value_or(kDefaultRadius)));
  const auto speed = continuous::quantise_speed(options.speed.value_or(1), resolution);
  if (!speed)
    return out_of_range(
        fmt::format("--speed: {} is not between 0.000001 and 1000000", options.speed.value_or(1)));
  return Numbers{resolution, *radius, *speed};
}

Result<RoadmapInput> read_instance(const InputOptions& input) {
  std::istringstream in(*input.instance_text);
  text::Names names;
  auto instance = continuous::read_instance_json(in, input.instance, &names);
  if (!instance) return instance.error();
  if (auto error = check_agents(input, instance->num_agents())) return *std::move(error);
  if (input.agents) {
    std::vector<continuous::Agent> agents(instance->agents().begin(), instance->agents().end());
    agents.resize(static_cast<std::size_t>(*input.agents));
    instance = Instance::make(instance->shared_roadmap(), std::move(agents), instance->resolution(),
                              {}, instance->obstacles());
    names.agents.resize(static_cast<std::size_t>(*input.agents));
  }
  const std::size_t count = instance->num_agents();
  return RoadmapInput{std::move(instance).value(),
                      {},
                      input.instance,
                      input.instance,
                      count,
                      "",
                      0,
                      std::move(names)};
}

std::string range(double least, double most) {
  return least == most ? fmt::format("{}", least) : fmt::format("{} to {}", least, most);
}

/// There are agents.
std::string describe_bodies(const Instance& instance) {
  continuous::Length small = geometry::kMaxLength, large = 0;
  std::size_t polygons = 0;
  for (const continuous::Agent& agent : instance.agents()) {
    const continuous::Length reach = geometry::enclosing_radius(agent.body);
    small = std::min(small, reach);
    large = std::max(large, reach);
    if (std::holds_alternative<continuous::ConvexPolygon>(agent.body)) ++polygons;
  }
  const std::string radii = range(continuous::in_input_units(small, instance.resolution()),
                                  continuous::in_input_units(large, instance.resolution()));
  if (polygons == 0) return fmt::format("radius {}", radii);
  return fmt::format("{} polygon{}, all in discs of radius {}", polygons, polygons == 1 ? "" : "s",
                     radii);
}

/// A line about agents with rules of their own; empty if there are none.
std::string describe_rules(const Instance& instance) {
  std::string text;
  const auto add = [&](const char* what, bool (*has)(const continuous::Agent&)) {
    const auto count = std::count_if(instance.agents().begin(), instance.agents().end(), has);
    if (count > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, what);
  };
  add("released later", [](const continuous::Agent& a) { return a.release > 0; });
  add("with a deadline", [](const continuous::Agent& a) { return a.deadline.has_value(); });
  add("under way at the beginning", [](const continuous::Agent& a) { return a.under_way; });
  add("that leave at their goal", [](const continuous::Agent& a) { return a.leaves; });
  if (!text.empty()) text = "           " + text + "\n";
  if (!instance.obstacles().empty())
    text += fmt::format("obstacles  {} on paths of their own\n", instance.obstacles().size());
  return text;
}

}  // namespace

void add_roadmap_options(CLI::App& app, RoadmapOptions& options) {
  const std::string group = "Continuous time";
  add_input_file(app, "--roadmap", options.roadmap,
                 "Roadmap: GraphML, a grid as XML, a MovingAI .map file, or a nav graph of\n"
                 "Open-RMF as .yaml")
      ->group(group);
  add_input_file(app, "--task", options.task, "Its agents: a task as XML, or a MovingAI .scen file")
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

bool is_roadmap(InputOptions& input, const RoadmapOptions& options) {
  if (!input.instance.empty()) {
    std::ifstream in;
    if (text::open_input(input.instance, in)) return !options.roadmap.empty();
    auto text = text::read_all(in, input.instance);
    if (text) input.instance_text = std::move(text).value();
    if (input.instance_text && continuous::is_roadmap_json(*input.instance_text)) return true;
  }
  return !options.roadmap.empty();
}

std::string check_roadmap_options(const RoadmapOptions& options, const InputOptions& input,
                                  Need need) {
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
  if (options.task.empty() && !options.radius && !options.speed && !options.resolution &&
      !options.neighbourhood)
    return "";
  return "--task, --radius, --speed, --neighbourhood and --resolution belong to --roadmap";
}

Result<RoadmapInput> load_roadmap_input(const RoadmapOptions& options, const InputOptions& input) {
  if (options.roadmap.empty()) return read_instance(input);
  const auto numbers = quantise(options);
  if (!numbers) return numbers.error();
  auto map = read_map(options.roadmap, input.letters, numbers->resolution, numbers->speed);
  if (!map) return map.error();
  const auto* const cells = std::get_if<OccupancyGrid>(&map->map);
  if (cells != nullptr)
    if (auto error =
            check_map_size(input, std::count(cells->passable.begin(), cells->passable.end(), true),
                           options.roadmap))
      return *std::move(error);
  continuous::TaskXml task;
  if (!options.task.empty()) {
    auto read = read_task(options.task, cells);
    if (!read) return read.error();
    task = std::move(read).value();
  }
  const std::size_t count =
      input.agents ? static_cast<std::size_t>(*input.agents) : task.rows.size();

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
    kind = fmt::format("{} x {} grid, 2^{} neighbours, ", cells->width, cells->height, k);
  } else {
    if (options.neighbourhood)
      return Error{ErrorCode::invalid_instance,
                   "--neighbourhood is for grids, and this is a roadmap",
                   {options.roadmap, 0}};
    roadmap = std::make_shared<const Roadmap>(std::get<Roadmap>(std::move(map->map)));
    agents = agents_of(task, count, *roadmap, numbers->radius, numbers->speed);
  }
  if (!agents) return agents.error();
  std::vector<SourcePlace> places;
  for (std::size_t i = 0; i < count; ++i) places.push_back({task.file, task.rows[i].line});
  auto instance = Instance::make(roadmap, std::move(agents).value(), numbers->resolution, places);
  if (!instance) {
    Error error = instance.error();
    if (error.where.file.empty()) error.where.file = options.roadmap;
    return error;
  }
  return RoadmapInput{std::move(instance).value(),
                      std::move(grid),
                      options.roadmap,
                      options.task,
                      task.rows.size(),
                      std::move(kind),
                      map->num_zero_length_edges};
}

void warn_of_durations(const RoadmapInput& input) {
  const Instance& instance = input.instance;
  const auto worst = continuous::largest_duration_error(instance);
  if (!worst || worst->relative < continuous::kNotableDurationError) return;
  const continuous::Edge& edge = instance.roadmap().edge(worst->edge);
  report_warning(
      {ErrorCode::out_of_range,
       fmt::format("durations are rounded by up to {:.3g} %: from {} to {}, agent {} is planned to "
                   "take {} instead of {:.4g}; a smaller resolution of time mends that",
                   100 * worst->relative, edge.from.value(), edge.to.value(), worst->agent.value(),
                   continuous::in_input_units(worst->planned, instance.resolution()),
                   worst->exact * instance.resolution().time),
       {input.source, 0}});
}

std::string describe_input(const RoadmapInput& input) {
  const Instance& instance = input.instance;
  const continuous::Resolution& resolution = instance.resolution();
  std::string text =
      fmt::format("roadmap    {}: {}{} vertices, {} edges\n", input.source, input.kind,
                  instance.roadmap().num_vertices(), instance.roadmap().num_edges());
  if (input.num_zero_length_edges > 0)
    text += fmt::format("           {} edges of length zero, which take one tick\n",
                        input.num_zero_length_edges);
  if (const auto closed = std::count_if(
          instance.roadmap().edges().begin(), instance.roadmap().edges().end(),
          [](const continuous::Edge& e) { return !(e.open_to == continuous::Groups::all()); });
      closed > 0)
    text += fmt::format("           {} of the edges open to some groups of agents only\n", closed);
  if (!input.task_source.empty()) {
    text += fmt::format("agents     {} from {}", instance.num_agents(), input.task_source);
    if (input.rows != instance.num_agents()) text += fmt::format(" (of {})", input.rows);
    if (instance.num_agents() > 0) {
      const auto [slow, fast] =
          std::minmax_element(instance.agents().begin(), instance.agents().end(),
                              [](const auto& a, const auto& b) { return a.speed < b.speed; });
      text += fmt::format(", {}, speed {}", describe_bodies(instance),
                          range(continuous::speed_in_input_units(slow->speed, resolution),
                                continuous::speed_in_input_units(fast->speed, resolution)));
    }
    text += "\n" + describe_rules(instance);
  }
  if (!resolution.is_uniform())
    return text + fmt::format("units      one tick is {}, one length unit is {}\n", resolution.time,
                              resolution.length);
  return text + fmt::format("units      one tick, and one length unit, is {}\n", resolution.time);
}

}  // namespace quadrille::cli
