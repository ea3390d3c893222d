// SPDX-License-Identifier: MIT
#include "quadrille/discrete/verify.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "input.hpp"
#include "output.hpp"
#include "report.hpp"
#include "subcommands.hpp"

namespace quadrille::cli {
namespace {

constexpr const char* kFooter =
    "Example:\n"
    "  quadrille verify --map empty-8-8.map --scen empty-8-8-random-1.scen --agents 10 plan.json\n"
    "\n";

struct VerifyArguments {
  InputOptions input;
  std::string plan;
  std::optional<discrete::PlanFormat> format;
  bool quiet = false;
};

/// One line per cost that the file states and the replay does not confirm.
std::string find_false_costs(const discrete::PlanFile& file, const discrete::VerifyReport& replay) {
  std::string text;
  const auto compare = [&text](const char* name, std::optional<Cost> stated, Cost actual) {
    if (stated && *stated != actual)
      text += fmt::format("the file states a {} of {}, but it is {}\n", name, *stated, actual);
  };
  compare("sum of costs", file.sum_of_costs, replay.sum_of_costs);
  compare("makespan", file.makespan, replay.makespan);
  return text;
}

ExitCode run(const VerifyArguments& arguments) {
  const auto input = load_input(arguments.input);
  if (!input) {
    report_error(input.error());
    return ExitCode::bad_input;
  }
  const std::filesystem::path path(arguments.plan);
  const auto file = discrete::read_plan(path, input->instance.graph(), arguments.format);
  if (!file) {
    report_error(file.error());
    return ExitCode::bad_input;
  }
  const discrete::VerifyReport replay = discrete::verify(input->instance, file->plan);
  const std::string false_costs = replay.valid() ? find_false_costs(*file, replay) : "";
  const bool valid = replay.valid() && false_costs.empty();

  Console console(arguments.quiet, false);
  console.print(describe_input(*input));
  if (valid)
    console.print(fmt::format("verified   {} agents, makespan {}, sum of costs {}, no violations\n",
                              file->plan.paths.size(), replay.makespan, replay.sum_of_costs));
  else if (replay.valid())
    console.print("invalid    the plan breaks no rule, but its file states a wrong cost\n" +
                  false_costs);
  else
    console.print(fmt::format("invalid    {} violation{}\n", replay.violations.size(),
                              replay.violations.size() == 1 ? "" : "s") +
                  describe_violations(replay));
  if (console.failure() != 0) {
    report_write_failure("-", console.failure());
    return ExitCode::output;
  }
  return valid ? ExitCode::success : ExitCode::violations;
}

}  // namespace

Subcommand add_verify(CLI::App& program) {
  CLI::App* app = program.add_subcommand("verify", "Check a plan by replaying it");
  const auto arguments = std::make_shared<VerifyArguments>();
  add_input_options(*app, arguments->input);
  add_file(*app, "PLAN", arguments->plan, "Plan file")->required();
  add_plan_format(*app, "--plan-format", arguments->format,
                  "json, cbsh2, visualizer or yaml; default: by what the file says");
  app->add_flag("--quiet", arguments->quiet, "Print nothing but errors; the exit code says it");
  app->footer(std::string(kFooter) + kExitCodesHelp);
  return {app, [app, arguments] {
            const std::string wrong = check_input_options(arguments->input, Need::tasks);
            return wrong.empty() ? run(*arguments) : usage_error(*app, wrong);
          }};
}

}  // namespace quadrille::cli
