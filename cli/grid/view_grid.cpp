// SPDX-License-Identifier: MIT
#include "grid/view_grid.hpp"

#include <filesystem>

#include "arguments.hpp"
#include "grid/grid_input.hpp"
#include "quadrille/discrete/plan_formats.hpp"
#include "quadrille/view/page.hpp"
#include "quadrille/view/picture.hpp"

namespace quadrille::cli {

ExitCode view_grid(const CLI::App& app, const ViewArguments& arguments) {
  std::string wrong = why_no_roadmap(arguments.roadmap);
  if (wrong.empty()) wrong = check_grid_options(arguments.input, Need::tasks);
  if (wrong.empty()) wrong = arguments.format.why_not_discrete("--plan-format");
  if (wrong.empty()) wrong = check_view_outputs(arguments);
  if (!wrong.empty()) return usage_error(app, wrong);

  const auto read = [&](const GridInput& input) {
    const std::filesystem::path path(arguments.plan);
    return discrete::read_plan(path, input.instance.graph(), arguments.format.discrete);
  };
  const auto page = [&](const GridInput& input, const discrete::Plan& plan) {
    view::PageOptions options;
    options.title = std::filesystem::path(input.source).filename().string();
    return view::page(input.instance, plan, options);
  };
  const auto draw = [&](const GridInput& input, const discrete::Plan& plan) {
    return view::picture(input.instance, plan, arguments.picture.options);
  };
  return view_and_write(
      arguments, [&] { return load_grid_input(arguments.input); }, read, page, draw);
}

}  // namespace quadrille::cli
