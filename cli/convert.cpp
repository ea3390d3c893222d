// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <sstream>

#include "input.hpp"
#include "output.hpp"
#include "quadrille/discrete/instance_json.hpp"
#include "quadrille/discrete/instance_yaml.hpp"
#include "subcommands.hpp"

namespace quadrille::cli {
namespace {

using discrete::PlanFormat;

constexpr const char* kFooter =
    "With PLAN, converts the plan; its map is needed, the agents are not, and nothing is said\n"
    "about its validity. Without PLAN, converts the instance, to json or yaml.\n"
    "\n"
    "Examples:\n"
    "  quadrille convert --map empty-8-8.map --to cbsh2 --output paths.txt plan.json\n"
    "  quadrille convert --map empty-8-8.map --scen empty-8-8-random-1.scen --agents 10 --to json\n"
    "\n";

struct ConvertArguments {
  InputOptions input;
  std::string plan;
  std::optional<PlanFormat> from, to;
  std::string output = "-";
};

/// The converted file. The name of the output is only for messages.
Result<std::string> convert(const ConvertArguments& arguments, const Input& input) {
  std::ostringstream text;
  std::optional<Error> error;
  if (!arguments.plan.empty()) {
    const std::filesystem::path path(arguments.plan);
    const auto file = discrete::read_plan(path, input.instance.graph(), arguments.from);
    if (!file) return file.error();
    error = write_plan(text, arguments.plan, input.instance.graph(), file->plan, *arguments.to);
  } else if (arguments.to == PlanFormat::yaml) {
    error = write_instance_yaml(text, input.source, input.instance);
  } else {
    error = write_instance_json(text, input.source, input.instance);
  }
  if (error) return *error;
  return text.str();
}

ExitCode run(const ConvertArguments& arguments) {
  const auto output = OutputFile::probe(arguments.output);
  if (!output) {
    report_error(output.error());
    return ExitCode::output;
  }
  const auto input = load_input(arguments.input);
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
  const std::string wrong = check_input_options(arguments.input, plan ? Need::map : Need::tasks);
  if (!wrong.empty() || plan) return wrong;
  if (arguments.from) return "--from needs PLAN";
  if (arguments.to != PlanFormat::json && arguments.to != PlanFormat::yaml)
    return "an instance is converted to json or yaml; other formats need PLAN";
  return "";
}

}  // namespace

Subcommand add_convert(CLI::App& program) {
  CLI::App* app = program.add_subcommand("convert", "Convert a plan or an instance");
  const auto arguments = std::make_shared<ConvertArguments>();
  add_input_options(*app, arguments->input);
  add_file(*app, "PLAN", arguments->plan, "Plan file");
  add_plan_format(*app, "--to", arguments->to, "json, cbsh2, visualizer or yaml")->required();
  add_plan_format(*app, "--from", arguments->from,
                  "Format of PLAN; default: by what the file says");
  add_file(*app, "--output", arguments->output, "Where to write; default - is standard output");
  app->footer(std::string(kFooter) + kExitCodesHelp);
  return {app, [app, arguments] {
            const std::string wrong = check(*arguments);
            return wrong.empty() ? run(*arguments) : usage_error(*app, wrong);
          }};
}

}  // namespace quadrille::cli
