// SPDX-License-Identifier: MIT
#include "roadmap/convert_roadmap.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <optional>
#include <sstream>

#include "frame/arguments.hpp"
#include "quadrille/continuous/instance_json.hpp"
#include "quadrille/continuous/plan_files.hpp"

namespace quadrille::cli {
namespace {

std::string check(const ConvertArguments& arguments) {
  std::string wrong = check_roadmap_options(arguments.roadmap, arguments.input, Need::tasks);
  if (wrong.empty()) wrong = arguments.to.why_not_continuous("--to");
  if (wrong.empty()) wrong = arguments.from.why_not_continuous("--from");
  if (!wrong.empty() || !arguments.plan.empty()) return wrong;
  if (arguments.from.is_given()) return "--from needs PLAN";
  if (arguments.to.continuous != continuous::PlanFormat::json)
    return "an instance with a roadmap is converted to json; ccbs needs PLAN";
  return "";
}

/// Robots that turn: vertices are called by cell and heading, which nothing else of a file says.
text::Names names_of(const input::RoadmapInput& input) {
  if (!input.poses) return input.names;
  text::Names names = input.names;
  names.vertices.clear();
  for (const VertexId v : IdRange<VertexId>(input.instance.roadmap().num_vertices())) {
    const continuous::Pose pose = input.poses->pose(v);
    names.vertices.push_back(
        fmt::format("[{}, {}, \"{}\"]", pose.cell.x, pose.cell.y, to_string(pose.heading)));
  }
  return names;
}

/// The text of the plan or the instance in its new format.
Result<std::string> convert(const ConvertArguments& arguments, const input::RoadmapInput& input) {
  std::ostringstream text;
  std::optional<Error> error;
  if (!arguments.plan.empty()) {
    const std::filesystem::path path(arguments.plan);
    const auto file = continuous::read_plan(path, input.instance, input.grid_or_null(),
                                            arguments.from.continuous);
    if (!file) return file.error();
    error = write_plan(text, arguments.plan, input.instance, file->plan, *arguments.to.continuous,
                       input.grid_or_null());
  } else {
    error = write_instance_json(text, input.source, input.instance, names_of(input));
  }
  if (error) return *error;
  return text.str();
}

}  // namespace

ExitCode convert_roadmap(const CLI::App& app, const ConvertArguments& arguments) {
  std::string wrong = check(arguments);
  if (wrong.empty()) wrong = check_convert_output(arguments);
  if (!wrong.empty()) return usage_error(app, wrong);
  return convert_and_write(
      arguments.output, [&] { return load_roadmap_input(arguments.roadmap, arguments.input); },
      [&](const auto& input) { return convert(arguments, input); });
}

}  // namespace quadrille::cli
