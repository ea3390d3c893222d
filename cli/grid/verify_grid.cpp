// SPDX-License-Identifier: MIT
#include "grid/verify_grid.hpp"

#include <filesystem>

#include "arguments.hpp"
#include "grid/grid_input.hpp"
#include "grid/grid_report.hpp"
#include "quadrille/discrete/verify.hpp"

namespace quadrille::cli {

ExitCode verify_grid(const CLI::App& app, const VerifyArguments& arguments) {
  std::string wrong = why_no_roadmap(arguments.roadmap);
  if (wrong.empty()) wrong = check_grid_options(arguments.input, Need::tasks);
  if (wrong.empty()) wrong = arguments.format.why_not_discrete("--plan-format");
  if (!wrong.empty()) return usage_error(app, wrong);

  const auto input = load_grid_input(arguments.input);
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
  const auto replay = verify(input->instance, file->plan);
  return pronounce(arguments.quiet, describe_input(*input), *file, replay,
                   describe_check(file->plan, replay), "");
}

}  // namespace quadrille::cli
