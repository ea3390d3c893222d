// SPDX-License-Identifier: MIT
#include "roadmap/view_roadmap.hpp"

#include <filesystem>

#include "arguments.hpp"
#include "quadrille/continuous/plan_files.hpp"
#include "quadrille/view/page.hpp"
#include "quadrille/view/picture.hpp"

namespace quadrille::cli {

ExitCode view_roadmap(const CLI::App& app, const ViewArguments& arguments) {
  std::string wrong = check_roadmap_options(arguments.roadmap, arguments.input, Need::tasks);
  if (wrong.empty()) wrong = arguments.format.why_not_continuous("--plan-format");
  if (wrong.empty()) wrong = check_view_outputs(arguments);
  if (!wrong.empty()) return usage_error(app, wrong);

  const auto read = [&](const RoadmapInput& input) {
    const std::filesystem::path path(arguments.plan);
    return continuous::read_plan(path, input.instance, input.grid_or_null(),
                                 arguments.format.continuous);
  };
  const auto page = [&](const RoadmapInput& input, const continuous::Plan& plan) {
    view::PageOptions options;
    options.title = std::filesystem::path(input.source).filename().string();
    return view::page(input.instance, plan, options, input.grid_or_null());
  };
  const auto draw = [&](const RoadmapInput& input, const continuous::Plan& plan) {
    return view::picture(input.instance, plan, arguments.picture.options, input.grid_or_null());
  };
  return view_and_write(
      arguments, [&] { return load_roadmap_input(arguments.roadmap, arguments.input); }, read, page,
      draw);
}

}  // namespace quadrille::cli
