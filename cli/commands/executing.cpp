// SPDX-License-Identifier: MIT
#include "commands/executing.hpp"

#include <CLI/CLI.hpp>

#include "frame/arguments.hpp"
#include "frame/output.hpp"
#include "grid/execution_grid.hpp"
#include "roadmap/execution_roadmap.hpp"

namespace quadrille::cli {

void add_execution_options(CLI::App& app, ExecutionArguments& arguments) {
  add_input_options(app, arguments.input);
  add_roadmap_options(app, arguments.roadmap);
  add_input_file(app, "PLAN", arguments.plan, "Plan file")->required();
  add_plan_format(app, "--plan-format", arguments.format,
                  "json, cbsh2, lns2, visualizer, lacam or yaml, for roadmaps json or ccbs;\n"
                  "default: by what the file says");
  add_file(app, "--json", arguments.json, "Write the report as JSON; - is standard output");
  app.add_flag("--quiet", arguments.quiet, "Print nothing but errors and what is asked for");
}

std::variant<ExecutionCase, ExitCode> load_execution(const CLI::App& app,
                                                     ExecutionArguments& arguments) {
  const bool roadmap = is_roadmap(arguments.input, arguments.roadmap);
  std::string wrong =
      roadmap ? check_execution_roadmap(arguments) : check_execution_grid(arguments);
  if (wrong.empty())
    wrong = check_outputs({{"--json", &arguments.json}},
                          {&arguments.input.map, &arguments.input.scen, &arguments.input.instance,
                           &arguments.roadmap.roadmap, &arguments.roadmap.task, &arguments.plan},
                          !arguments.quiet);
  if (!wrong.empty()) return usage_error(app, wrong);
  auto loaded = roadmap ? load_execution_roadmap(arguments) : load_execution_grid(arguments);
  if (loaded) return std::move(loaded).value();
  Error error = loaded.error();
  if (error.where.file.empty()) error.where.file = arguments.plan;
  report_error(error);
  return ExitCode::bad_input;
}

}  // namespace quadrille::cli
