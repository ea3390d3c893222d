// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <memory>

#include "asked/view_arguments.hpp"
#include "frame/arguments.hpp"
#include "frame/subcommands.hpp"
#include "grid/view_grid.hpp"
#include "roadmap/view_roadmap.hpp"

namespace quadrille::cli {
namespace {

constexpr const char* kFooter =
    "The page is one file that needs no network; open it in a browser. A plan that breaks rules "
    "is\n"
    "shown with what is wrong with it.\n"
    "\n"
    "Example:\n"
    "  quadrille view --map empty-8-8.map --scen empty-8-8-random-1.scen --agents 10 \\\n"
    "    --output plan.html plan.json\n"
    "  quadrille view --roadmap map.xml --task task.xml --output plan.html plan.xml\n"
    "\n";

}  // namespace

std::string check_view_outputs(const ViewArguments& arguments) {
  const std::string page =
      arguments.output.empty() && arguments.picture.file.empty() ? "-" : arguments.output;
  const std::string wrong =
      check_outputs({{"--output", &page}, {"--svg", &arguments.picture.file}},
                    {&arguments.input.map, &arguments.input.scen, &arguments.input.instance,
                     &arguments.roadmap.roadmap, &arguments.roadmap.task, &arguments.plan});
  return wrong.empty() ? check_picture_options(arguments.picture) : wrong;
}

Subcommand add_view(CLI::App& program) {
  CLI::App* app = program.add_subcommand("view", "Make a page that plays a plan in a browser");
  const auto arguments = std::make_shared<ViewArguments>();
  add_input_options(*app, arguments->input);
  add_roadmap_options(*app, arguments->roadmap);
  add_input_file(*app, "PLAN", arguments->plan, "Plan file, valid or not")->required();
  add_plan_format(*app, "--plan-format", arguments->format,
                  "json, cbsh2, lns2, visualizer, lacam or yaml, for roadmaps json or ccbs;\n"
                  "default: by what the file says");
  add_file(*app, "--output", arguments->output,
           "Where to write the page; default - is standard output, or nowhere with --svg");
  add_picture_options(*app, arguments->picture, "Pictures");
  app->footer(std::string(kFooter) + kExitCodesHelp);
  return {app, [app, arguments] {
            return is_roadmap(arguments->input, arguments->roadmap) ? view_roadmap(*app, *arguments)
                                                                    : view_grid(*app, *arguments);
          }};
}

}  // namespace quadrille::cli
