// SPDX-License-Identifier: MIT
#include "roadmap/generate_roadmap.hpp"

#include <CLI/CLI.hpp>
#include <sstream>
#include <utility>

#include "frame/arguments.hpp"
#include "frame/output.hpp"
#include "quadrille/continuous/generator.hpp"
#include "quadrille/continuous/instance_json.hpp"
#include "quadrille/continuous/quantise.hpp"
#include "quadrille/input/roadmap.hpp"

namespace quadrille::cli {
namespace {

Result<continuous::Instance> make(const GenerateRoadmapOptions& options, std::int64_t width,
                                  std::int64_t height, std::int64_t agents, std::uint64_t seed) {
  const auto refuse = [](const char* message) {
    return Error{ErrorCode::out_of_range, message, {}};
  };
  continuous::RandomInstanceOptions wanted;
  wanted.resolution = options.resolution.value_or(continuous::kDefaultResolution);
  const auto radius = continuous::quantise_radius(options.radius.value_or(input::kDefaultRadius),
                                                  wanted.resolution);
  if (!radius) return refuse("--radius is less than one length unit, or too large");
  const auto speed = continuous::quantise_speed(options.speed.value_or(1), wanted.resolution);
  if (!speed) return refuse("--speed is not between 0.000001 and 1000000");
  const auto unit_width =
      continuous::quantise_coordinate(static_cast<double>(width), wanted.resolution);
  const auto unit_height =
      continuous::quantise_coordinate(static_cast<double>(height), wanted.resolution);
  if (!unit_width || !unit_height)
    return refuse("--width or --height is too large for the resolution");
  wanted.radius = *radius;
  wanted.speed = *speed;
  wanted.width = *unit_width;
  wanted.height = *unit_height;
  if (options.altitude) {
    const auto altitude = continuous::quantise_coordinate(*options.altitude, wanted.resolution);
    if (!altitude || *altitude < 1)
      return refuse("--altitude is less than one length unit, or too large");
    wanted.altitude = *altitude;
  }
  wanted.mixed = options.mixed;
  if (options.reach) {
    wanted.reach = continuous::quantise_coordinate(*options.reach, wanted.resolution);
    if (!wanted.reach) return refuse("--reach is too large for the resolution");
  }
  wanted.num_vertices = static_cast<std::size_t>(options.vertices.value_or(100));
  wanted.num_agents = static_cast<std::size_t>(agents);
  return random_instance(wanted, seed);
}

}  // namespace

void add_generate_roadmap_options(CLI::App& app, GenerateRoadmapOptions& options) {
  const std::string group = "Roadmaps (--kind roadmap)";
  add_integer(app, "--vertices", options.vertices, 1,
              static_cast<std::int64_t>(continuous::kMaxRandomVertices),
              "Number of vertices, at most 10000; default 100")
      ->group(group);
  add_positive(app, "--altitude", options.altitude,
               "Vertices in space, up to so high; agents are spheres")
      ->group(group);
  add_positive(app, "--radius", options.radius, "Radius of the agents; default sqrt(2)/4")
      ->group(group);
  add_positive(app, "--speed", options.speed, "Speed of the agents; default 1")->group(group);
  add_positive(app, "--reach", options.reach,
               "Edges between all vertices that are no further apart; by default those of the\n"
               "Gabriel graph, which do not cross")
      ->group(group);
  app.add_flag("--mixed", options.mixed,
               "Draw radii and speeds from half of these up; half of the agents are polygons, "
               "unless there\n"
               "is an altitude")
      ->group(group);
  add_positive(app, "--resolution", options.resolution,
               "Size of a tick and of a length unit; default 0.000001")
      ->group(group);
  add_file(app, "--instance-output", options.output,
           "Write the roadmap with its agents; default - is standard output")
      ->group(group);
}

ExitCode generate_roadmap(const CLI::App& app, const GenerateRoadmapOptions& options,
                          std::int64_t width, std::int64_t height, std::int64_t agents,
                          std::uint64_t seed) {
  const auto output = OutputFile::probe(options.output.empty() ? "-" : options.output);
  if (!output) {
    report_error(output.error());
    return ExitCode::output;
  }
  const auto instance = make(options, width, height, agents, seed);
  if (!instance) return usage_error(app, instance.error().message);
  std::ostringstream text;
  if (auto error = write_instance_json(text, options.output, *instance)) {
    report_error(*error);
    return ExitCode::output;
  }
  return write_or_report(*output, text.str()) ? ExitCode::success : ExitCode::output;
}

}  // namespace quadrille::cli
