// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <memory>

#include "frame/subcommands.hpp"
#include "grid/grid_info.hpp"
#include "quadrille/input/grid.hpp"
#include "roadmap/roadmap_info.hpp"

namespace quadrille::cli {
namespace {

constexpr const char* kFooter =
    "Example:\n"
    "  quadrille info --map maze-32-32-4.map --scen maze-32-32-4-random-1.scen --agents 20\n"
    "  quadrille info --roadmap map.xml --task task.xml --agents 20\n"
    "\n";

}  // namespace

Subcommand add_info(CLI::App& program) {
  CLI::App* app = program.add_subcommand("info", "Describe a map or an instance");
  const auto options = std::make_shared<InputOptions>();
  add_input_options(*app, *options);
  const auto roadmap = std::make_shared<RoadmapOptions>();
  add_roadmap_options(*app, *roadmap);
  app->footer(std::string(kFooter) + kExitCodesHelp);
  return {app, [app, options, roadmap] {
            const bool continuous = is_roadmap(*options, *roadmap);
            std::string wrong = continuous ? check_roadmap_options(*roadmap, *options, Need::map)
                                           : why_no_roadmap(*roadmap);
            if (wrong.empty() && !continuous) wrong = check_grid_options(*options, Need::map);
            if (!wrong.empty()) return usage_error(*app, wrong);
            return continuous ? print_roadmap_info(*roadmap, *options) : print_grid_info(*options);
          }};
}

}  // namespace quadrille::cli
