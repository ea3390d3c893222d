// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <memory>

#include "asked/conversion.hpp"
#include "frame/arguments.hpp"
#include "frame/subcommands.hpp"
#include "grid/convert_grid.hpp"
#include "roadmap/convert_roadmap.hpp"

namespace quadrille::cli {
namespace {

constexpr const char* kFooter =
    "With PLAN, converts the plan; its map is needed, the agents only with a roadmap, and nothing\n"
    "is said about its validity. Without PLAN, converts the instance, to json or yaml.\n"
    "\n"
    "Examples:\n"
    "  quadrille convert --map empty-8-8.map --to cbsh2 --output paths.txt plan.json\n"
    "  quadrille convert --map empty-8-8.map --scen empty-8-8-random-1.scen --agents 10 --to json\n"
    "  quadrille convert --roadmap map.xml --task task.xml --to json --output discs.json\n"
    "\n";

}  // namespace

std::string check_convert_output(const ConvertArguments& arguments) {
  return check_outputs({{"--output", &arguments.output}},
                       {&arguments.input.map, &arguments.input.scen, &arguments.input.instance,
                        &arguments.roadmap.roadmap, &arguments.roadmap.task, &arguments.plan});
}

Subcommand add_convert(CLI::App& program) {
  CLI::App* app = program.add_subcommand("convert", "Convert a plan or an instance");
  const auto arguments = std::make_shared<ConvertArguments>();
  add_input_options(*app, arguments->input);
  add_roadmap_options(*app, arguments->roadmap);
  add_input_file(*app, "PLAN", arguments->plan, "Plan file");
  add_plan_format(*app, "--to", arguments->to,
                  "json, cbsh2, lns2, visualizer, lacam or yaml, for roadmaps json or ccbs")
      ->required();
  add_plan_format(*app, "--from", arguments->from,
                  "Format of PLAN; default: by what the file says");
  add_file(*app, "--output", arguments->output, "Where to write; default - is standard output");
  app->footer(std::string(kFooter) + kExitCodesHelp);
  return {app, [app, arguments] {
            return is_roadmap(arguments->input, arguments->roadmap)
                       ? convert_roadmap(*app, *arguments)
                       : convert_grid(*app, *arguments);
          }};
}

}  // namespace quadrille::cli
