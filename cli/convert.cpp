// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <sstream>

#include "input.hpp"
#include "output.hpp"
#include "quadrille/continuous/instance_json.hpp"
#include "quadrille/discrete/instance_json.hpp"
#include "quadrille/discrete/instance_yaml.hpp"
#include "roadmap/roadmap_input.hpp"
#include "subcommands.hpp"

namespace quadrille::cli {
namespace {

using discrete::PlanFormat;

constexpr const char* kFooter =
    "With PLAN, converts the plan; its map is needed, the agents only with a roadmap, and nothing\n"
    "is said about its validity. Without PLAN, converts the instance, to json or yaml.\n"
    "\n"
    "Examples:\n"
    "  quadrille convert --map empty-8-8.map --to cbsh2 --output paths.txt plan.json\n"
    "  quadrille convert --map empty-8-8.map --scen empty-8-8-random-1.scen --agents 10 --to json\n"
    "  quadrille convert --roadmap map.xml --task task.xml --to json --output discs.json\n"
    "\n";

struct ConvertArguments {
  InputOptions input;
  std::string plan;
  RoadmapOptions roadmap;
  PlanFormats from, to;
  std::string output = "-";
};

/// The converted file. The name of the output is only for messages.
Result<std::string> convert(const ConvertArguments& arguments, const Input& input) {
  std::ostringstream text;
  std::optional<Error> error;
  if (!arguments.plan.empty()) {
    const std::filesystem::path path(arguments.plan);
    const auto file = discrete::read_plan(path, input.instance.graph(), arguments.from.discrete);
    if (!file) return file.error();
    error = write_plan(text, arguments.plan, input.instance.graph(), file->plan,
                       *arguments.to.discrete);
  } else if (arguments.to.discrete == PlanFormat::yaml) {
    error = write_instance_yaml(text, input.source, input.instance);
  } else {
    error = write_instance_json(text, input.source, input.instance);
  }
  if (error) return *error;
  return text.str();
}

Result<std::string> convert(const ConvertArguments& arguments, const RoadmapInput& input) {
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
    error = write_instance_json(text, input.source, input.instance);
  }
  if (error) return *error;
  return text.str();
}

template <class Load>
ExitCode run(const ConvertArguments& arguments, const Load& load) {
  const auto output = OutputFile::probe(arguments.output);
  if (!output) {
    report_error(output.error());
    return ExitCode::output;
  }
  const auto input = load();
  if (!input) {
    report_error(input.error());
    return ExitCode::bad_input;
  }
  const auto text = convert(arguments, *input);
  if (!text) {
    report_error(text.error());
    return ExitCode::bad_input;
  }
  return write_or_report(*output, *text) ? ExitCode::success : ExitCode::output;
}

std::string check(const ConvertArguments& arguments) {
  const bool plan = !arguments.plan.empty();
  std::string wrong = why_no_roadmap(arguments.roadmap);
  if (wrong.empty()) wrong = check_input_options(arguments.input, plan ? Need::map : Need::tasks);
  if (wrong.empty()) wrong = arguments.to.why_not_discrete("--to");
  if (wrong.empty()) wrong = arguments.from.why_not_discrete("--from");
  if (!wrong.empty() || plan) return wrong;
  if (arguments.from.is_given()) return "--from needs PLAN";
  if (arguments.to.discrete != PlanFormat::json && arguments.to.discrete != PlanFormat::yaml)
    return "an instance is converted to json or yaml; other formats need PLAN";
  return "";
}

/// Why the output may not be written; empty if it may.
std::string check_files(const ConvertArguments& arguments) {
  return check_outputs({{"--output", &arguments.output}},
                       {&arguments.input.map, &arguments.input.scen, &arguments.input.instance,
                        &arguments.roadmap.roadmap, &arguments.roadmap.task, &arguments.plan});
}

std::string check_roadmap(const ConvertArguments& arguments) {
  std::string wrong = check_roadmap_options(arguments.roadmap, arguments.input, Need::tasks);
  if (wrong.empty()) wrong = arguments.to.why_not_continuous("--to");
  if (wrong.empty()) wrong = arguments.from.why_not_continuous("--from");
  if (!wrong.empty() || !arguments.plan.empty()) return wrong;
  if (arguments.from.is_given()) return "--from needs PLAN";
  if (arguments.to.continuous != continuous::PlanFormat::json)
    return "an instance with a roadmap is converted to json; ccbs needs PLAN";
  return "";
}

}  // namespace

Subcommand add_convert(CLI::App& program) {
  CLI::App* app = program.add_subcommand("convert", "Convert a plan or an instance");
  const auto arguments = std::make_shared<ConvertArguments>();
  add_input_options(*app, arguments->input);
  add_roadmap_options(*app, arguments->roadmap);
  add_file(*app, "PLAN", arguments->plan, "Plan file");
  add_plan_format(*app, "--to", arguments->to,
                  "json, cbsh2, visualizer or yaml, for roadmaps json or ccbs")
      ->required();
  add_plan_format(*app, "--from", arguments->from,
                  "Format of PLAN; default: by what the file says");
  add_file(*app, "--output", arguments->output, "Where to write; default - is standard output");
  app->footer(std::string(kFooter) + kExitCodesHelp);
  return {app, [app, arguments] {
            const bool continuous = is_roadmap(arguments->input, arguments->roadmap);
            const std::string wrong = continuous ? check_roadmap(*arguments) : check(*arguments);
            if (!wrong.empty()) return usage_error(*app, wrong);
            const std::string clash = check_files(*arguments);
            if (!clash.empty()) return usage_error(*app, clash);
            if (!continuous) return run(*arguments, [&] { return load_input(arguments->input); });
            return run(*arguments,
                       [&] { return load_roadmap_input(arguments->roadmap, arguments->input); });
          }};
}

}  // namespace quadrille::cli
