// SPDX-License-Identifier: MIT
#include "quadrille/discrete/verify.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "grid/report.hpp"
#include "input.hpp"
#include "outcome_check.hpp"
#include "output.hpp"
#include "roadmap/roadmap_report.hpp"
#include "subcommands.hpp"

namespace quadrille::cli {
namespace {

constexpr const char* kFooter =
    "Example:\n"
    "  quadrille verify --map empty-8-8.map --scen empty-8-8-random-1.scen --agents 10 plan.json\n"
    "  quadrille verify --roadmap map.xml --task task.xml plan.xml\n"
    "\n";

struct VerifyArguments {
  InputOptions input;
  std::string plan;
  RoadmapOptions roadmap;
  PlanFormats format;
  bool quiet = false;
};

/// One line for everything that the file states and the replay does not confirm.
template <class VerifyReport>
std::string find_false_statements(const StatedOutcome& stated, const VerifyReport& replay) {
  std::string text;
  const auto compare = [&text](const char* name, std::optional<Cost> cost, Cost actual) {
    if (cost && *cost != actual)
      text += fmt::format("the file states a {} of {}, but it is {}\n", name, *cost, actual);
  };
  compare("sum of costs", stated.sum_of_costs, replay.sum_of_costs);
  compare("makespan", stated.makespan, replay.makespan);
  const std::string wrong = find_contradiction(stated, replay.sum_of_costs, replay.makespan);
  return wrong.empty() ? text : text + wrong + "\n";
}

/// Prints the verdict: `good` for a plan without fault, else its faults and `more`.
template <class PlanFile, class VerifyReport>
ExitCode pronounce(const VerifyArguments& arguments, const std::string& input, const PlanFile& file,
                   const VerifyReport& replay, const std::string& good, const std::string& more) {
  const std::string wrong = replay.valid() ? find_false_statements(file.stated, replay) : "";
  const bool valid = replay.valid() && wrong.empty();
  Console console(arguments.quiet, false);
  console.print(input);
  if (valid)
    console.print(good);
  else if (replay.valid())
    console.print("invalid    the plan breaks no rule, but its file states what is wrong\n" +
                  wrong);
  else
    console.print(fmt::format("invalid    {} violation{}\n", replay.violations.size(),
                              replay.violations.size() == 1 ? "" : "s") +
                  more + describe_violations(replay));
  if (console.failure() != 0) {
    report_write_failure("-", console.failure());
    return ExitCode::output;
  }
  return valid ? ExitCode::success : ExitCode::violations;
}

ExitCode run(const VerifyArguments& arguments) {
  const auto input = load_input(arguments.input);
  if (!input) {
    report_error(input.error());
    return ExitCode::bad_input;
  }
  const std::filesystem::path path(arguments.plan);
  const auto file = discrete::read_plan(path, input->instance.graph(), arguments.format.discrete);
  if (!file) {
    report_error(file.error());
    return ExitCode::bad_input;
  }
  const discrete::VerifyReport replay = discrete::verify(input->instance, file->plan);
  const std::string good =
      fmt::format("verified   {} agents, makespan {}, sum of costs {}, no violations\n",
                  file->plan.paths.size(), replay.makespan, replay.sum_of_costs);
  return pronounce(arguments, describe_input(*input), *file, replay, good, "");
}

ExitCode run_roadmap(const VerifyArguments& arguments) {
  const auto input = load_roadmap_input(arguments.roadmap, arguments.input);
  if (!input) {
    report_error(input.error());
    return ExitCode::bad_input;
  }
  const std::filesystem::path path(arguments.plan);
  const auto file = continuous::read_plan(path, input->instance, input->grid_or_null(),
                                          arguments.format.continuous);
  if (!file) {
    report_error(file.error());
    return ExitCode::bad_input;
  }
  const continuous::VerifyReport replay = continuous::verify(input->instance, file->plan);
  const std::string clearance = describe_clearance(input->instance, replay);
  return pronounce(arguments, describe_input(*input), *file, replay,
                   describe_check(input->instance, replay),
                   clearance.empty() ? "" : "           " + clearance + "\n");
}

std::string check(const VerifyArguments& arguments, bool is_roadmap) {
  std::string wrong = is_roadmap
                          ? check_roadmap_options(arguments.roadmap, arguments.input, Need::tasks)
                          : why_no_roadmap(arguments.roadmap);
  if (wrong.empty() && !is_roadmap) wrong = check_input_options(arguments.input, Need::tasks);
  if (!wrong.empty()) return wrong;
  return is_roadmap ? arguments.format.why_not_continuous("--plan-format")
                    : arguments.format.why_not_discrete("--plan-format");
}

}  // namespace

Subcommand add_verify(CLI::App& program) {
  CLI::App* app = program.add_subcommand("verify", "Check a plan by replaying it");
  const auto arguments = std::make_shared<VerifyArguments>();
  add_input_options(*app, arguments->input);
  add_roadmap_options(*app, arguments->roadmap);
  add_file(*app, "PLAN", arguments->plan, "Plan file")->required();
  add_plan_format(*app, "--plan-format", arguments->format,
                  "json, cbsh2, visualizer or yaml, for roadmaps json or ccbs; default: by what\n"
                  "the file says");
  app->add_flag("--quiet", arguments->quiet, "Print nothing but errors; the exit code says it");
  app->footer(std::string(kFooter) + kExitCodesHelp);
  return {app, [app, arguments] {
            const bool continuous = is_roadmap(arguments->input, arguments->roadmap);
            const std::string wrong = check(*arguments, continuous);
            if (!wrong.empty()) return usage_error(*app, wrong);
            return continuous ? run_roadmap(*arguments) : run(*arguments);
          }};
}

}  // namespace quadrille::cli
