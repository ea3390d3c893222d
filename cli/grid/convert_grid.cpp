// SPDX-License-Identifier: MIT
#include "grid/convert_grid.hpp"

#include <filesystem>
#include <optional>
#include <sstream>

#include "frame/arguments.hpp"
#include "quadrille/discrete/instance_json.hpp"
#include "quadrille/discrete/instance_yaml.hpp"
#include "quadrille/input/grid.hpp"

namespace quadrille::cli {
namespace {

using discrete::PlanFormat;

std::string check(const ConvertArguments& arguments) {
  const bool plan = !arguments.plan.empty();
  std::string wrong = why_no_roadmap(arguments.roadmap);
  if (wrong.empty()) wrong = check_grid_options(arguments.input, plan ? Need::map : Need::tasks);
  if (wrong.empty()) wrong = arguments.to.why_not_discrete("--to");
  if (wrong.empty()) wrong = arguments.from.why_not_discrete("--from");
  if (!wrong.empty() || plan) return wrong;
  if (arguments.from.is_given()) return "--from needs PLAN";
  if (arguments.to.discrete != PlanFormat::json && arguments.to.discrete != PlanFormat::yaml)
    return "an instance is converted to json or yaml; other formats need PLAN";
  return "";
}

/// The text of the plan or the instance in its new format.
Result<std::string> convert(const ConvertArguments& arguments, const input::GridInput& input) {
  std::ostringstream text;
  std::optional<Error> error;
  if (!arguments.plan.empty()) {
    const std::filesystem::path path(arguments.plan);
    const auto file = discrete::read_plan(path, input.instance, arguments.from.discrete);
    if (!file) return file.error();
    error = write_plan(text, arguments.plan, input.instance.graph(), file->plan,
                       *arguments.to.discrete);
  } else if (arguments.to.discrete == PlanFormat::yaml) {
    error = write_instance_yaml(text, input.source, input.instance, input.names);
  } else {
    error = write_instance_json(text, input.source, input.instance, input.names);
  }
  if (error) return *error;
  return text.str();
}

}  // namespace

ExitCode convert_grid(const CLI::App& app, const ConvertArguments& arguments) {
  std::string wrong = check(arguments);
  if (wrong.empty()) wrong = check_convert_output(arguments);
  if (!wrong.empty()) return usage_error(app, wrong);
  return convert_and_write(
      arguments.output, [&] { return load_grid_input(arguments.input); },
      [&](const auto& input) { return convert(arguments, input); });
}

}  // namespace quadrille::cli
