// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <memory>

#include "asked/verdict.hpp"
#include "frame/arguments.hpp"
#include "frame/subcommands.hpp"
#include "grid/verify_grid.hpp"
#include "roadmap/verify_roadmap.hpp"

namespace quadrille::cli {
namespace {

constexpr const char* kFooter =
    "Example:\n"
    "  quadrille verify --map empty-8-8.map --scen empty-8-8-random-1.scen --agents 10 plan.json\n"
    "  quadrille verify --roadmap map.xml --task task.xml plan.xml\n"
    "\n";

}  // namespace

std::string check_verify_outputs(const VerifyArguments& arguments) {
  return check_outputs({{"--json", &arguments.json}},
                       {&arguments.input.map, &arguments.input.scen, &arguments.input.instance,
                        &arguments.roadmap.roadmap, &arguments.roadmap.task, &arguments.plan},
                       !arguments.quiet);
}

Subcommand add_verify(CLI::App& program) {
  CLI::App* app = program.add_subcommand("verify", "Check a plan by replaying it");
  const auto arguments = std::make_shared<VerifyArguments>();
  add_input_options(*app, arguments->input);
  add_roadmap_options(*app, arguments->roadmap);
  add_input_file(*app, "PLAN", arguments->plan, "Plan file")->required();
  add_plan_format(*app, "--plan-format", arguments->format,
                  "json, cbsh2, lns2, visualizer, lacam or yaml, for roadmaps json or ccbs;\n"
                  "default: by what the file says");
  add_check_with(*app, arguments->check_with);
  add_file(*app, "--json", arguments->json, "Write the verdict as JSON; - is standard output");
  app->add_flag("--quiet", arguments->quiet, "Print nothing but errors; the exit code says it");
  app->footer(std::string(kFooter) + kExitCodesHelp);
  return {app, [app, arguments] {
            return is_roadmap(arguments->input, arguments->roadmap)
                       ? verify_roadmap(*app, *arguments)
                       : verify_grid(*app, *arguments);
          }};
}

}  // namespace quadrille::cli
