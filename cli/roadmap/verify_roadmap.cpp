// SPDX-License-Identifier: MIT
#include "roadmap/verify_roadmap.hpp"

#include <filesystem>

#include "arguments.hpp"
#include "quadrille/continuous/plan_files.hpp"
#include "quadrille/continuous/verify.hpp"
#include "roadmap/roadmap_report.hpp"

namespace quadrille::cli {

ExitCode verify_roadmap(const CLI::App& app, const VerifyArguments& arguments) {
  std::string wrong = check_roadmap_options(arguments.roadmap, arguments.input, Need::tasks);
  if (wrong.empty()) wrong = arguments.format.why_not_continuous("--plan-format");
  if (!wrong.empty()) return usage_error(app, wrong);

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
  const auto replay = verify(input->instance, file->plan);
  const std::string clearance = describe_clearance(input->instance, replay);
  return pronounce(arguments.quiet, describe_input(*input), *file, replay,
                   describe_check(input->instance, replay),
                   clearance.empty() ? "" : "           " + clearance + "\n");
}

}  // namespace quadrille::cli
