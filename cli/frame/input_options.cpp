// SPDX-License-Identifier: MIT
#include "frame/input_options.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <cstdint>

#include "frame/arguments.hpp"
#include "quadrille/continuous/grid.hpp"
#include "quadrille/discrete/instance.hpp"

namespace quadrille::cli {
namespace {

constexpr std::int64_t kMaxAgents = 1'000'000'000;

CLI::Option* add_name(CLI::App& app, const std::string& name, std::string& value,
                      const std::string& help) {
  const auto read = [&value, name](const std::string& text) {
    if (text.empty()) refuse_value(name, text, "a name");
    value = text;
  };
  return app.add_option_function<std::string>(name, read, help)->type_name("NAME");
}

void add_letters(CLI::App& app, const std::string& name, std::string& letters,
                 const std::string& help) {
  const auto read = [&letters, name](const std::string& text) {
    if (text.empty()) refuse_value(name, text, "a list of letters");
    letters = text;
  };
  app.add_option_function<std::string>(name, read, help)->type_name("LETTERS");
}

CLI::Option& add_sharing(CLI::App& app, std::optional<std::size_t>& sharing) {
  const auto read = [&sharing](const std::string& text) {
    std::size_t size = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, fault] = std::from_chars(text.data(), end, size);
    if (text == "all")
      sharing = SIZE_MAX;
    else if (fault == std::errc() && stop == end && size > 0)
      sharing = size;
    else
      refuse_value("--share-goals", text, "all, or a whole number from 1 on");
  };
  return *app.add_option_function<std::string>(
                 "--share-goals", read,
                 "All agents of --scen or --task, or each N of them, may end at any goal\n"
                 "that one of them has: all or N")
              ->type_name("N");
}

}  // namespace

void add_input_options(CLI::App& app, InputOptions& options) {
  const std::string group = "Instance";
  add_input_file(app, "--map", options.map, "Map in MovingAI's format")->group(group);
  add_input_file(app, "--scen", options.scen, "Scenario in MovingAI's format")->group(group);
  add_integer(app, "--agents", options.agents, 0, kMaxAgents,
              "Take the first N rows of --scen, or agents of --instance")
      ->group(group);
  add_input_file(app, "--instance", options.instance,
                 "Instead: one file, quadrille's JSON (also with a roadmap),\n"
                 "libMultiRobotPlanning's YAML or a problem of the League of Robot Runners")
      ->group(group);
  add_letters(app, "--passable", options.letters.passable,
              "Map letters that are passable besides . and G");
  add_letters(app, "--blocked", options.letters.blocked,
              "Map letters that are blocked besides @, O and T");
  for (const char* name : {"--passable", "--blocked"}) app.get_option(name)->group(group);
  add_sharing(app, options.sharing).group(group);
  app.add_flag("--leave", options.leave, "On grids and graphs: all agents vanish at their goals")
      ->group(group);
  add_integer(app, "--robust", options.robust, 0, discrete::kMaxRuleTime - 1,
              "On grids and graphs: nobody is in a place within K timesteps after another agent")
      ->type_name("K")
      ->group(group);
  app.add_flag("--whole-moves", options.whole_moves,
               "Plans for systems that release whole moves: moves that cross are never under way\n"
               "at the same time; on grids and graphs that is --robust 1")
      ->group(group);
}

void add_roadmap_options(CLI::App& app, RoadmapOptions& options) {
  const std::string group = "Continuous time";
  add_input_file(app, "--roadmap", options.roadmap,
                 "Roadmap: GraphML, GML, a nav graph of Open-RMF, a LIF, GeoJSON of Nav2, a grid\n"
                 "as XML, or a MovingAI .map file")
      ->group(group);
  add_input_file(app, "--task", options.task, "Its agents: a task as XML, or a MovingAI .scen file")
      ->group(group);
  add_positive(app, "--radius", options.radius, "Radius of all agents; default sqrt(2)/4")
      ->group(group);
  add_positive(app, "--speed", options.speed, "Speed of all agents; default 1")->group(group);
  add_integer(
      app, "--neighbourhood", options.neighbourhood, continuous::GridRoadmap::kMinNeighbourhood,
      continuous::GridRoadmap::kMaxNeighbourhood, "On grids: moves to 2^N neighbours; default 3")
      ->group(group);
  add_name(app, "--level", options.level, "The level or layout to read, of a file that has several")
      ->group(group);
  add_name(app, "--vehicle-type", options.vehicle_type,
           "The type of vehicles, of a LIF that has several")
      ->group(group);
  add_positive(app, "--resolution", options.resolution,
               "Size of a tick and of a length unit; default 0.000001")
      ->group(group);
  app.add_flag("--overlap-at-start", options.overlap_at_start,
               "Agents may overlap at their starts, until one of the two has made its first move")
      ->group(group);
  add_integer(app, "--headings", options.headings, input::kHeadings, input::kHeadings,
              "4: robots on --map turn and go ahead; at first they face east, in the end anywhere")
      ->group(group);
  add_integer(app, "--turn", options.turn, 1, geometry::kMaxDuration.value(),
              "With --headings: timesteps of a quarter turn; default 1")
      ->group(group);
}

std::string PlanFormats::why_not_discrete(const std::string& option) const {
  if (!is_given() || discrete) return "";
  return fmt::format("{} {} is for roadmaps", option, to_string(*continuous));
}

std::string PlanFormats::why_not_continuous(const std::string& option) const {
  if (!is_given() || continuous) return "";
  return fmt::format("{} {} is not for roadmaps, whose plans are json or ccbs", option,
                     to_string(*discrete));
}

CLI::Option* add_plan_format(CLI::App& app, const std::string& name, PlanFormats& formats,
                             const std::string& help) {
  const auto read = [&formats, name](const std::string& text) {
    formats = {discrete::parse_plan_format(text), continuous::parse_plan_format(text)};
    if (!formats.is_given())
      refuse_value(name, text, "json, cbsh2, lns2, visualizer, lacam, yaml or ccbs");
  };
  return app.add_option_function<std::string>(name, read, help)->type_name("FORMAT");
}

}  // namespace quadrille::cli
