// SPDX-License-Identifier: MIT
#include "grid/view_grid.hpp"

#include <filesystem>
#include <optional>
#include <sstream>

#include "asked/given_plan.hpp"
#include "asked/shown_names.hpp"
#include "frame/arguments.hpp"
#include "quadrille/discrete/plan_formats.hpp"
#include "quadrille/input/attribution.hpp"
#include "quadrille/input/grid.hpp"
#include "quadrille/view/page.hpp"
#include "quadrille/view/picture.hpp"

namespace quadrille::cli {

namespace {

input::ReadVertex reader_of_vertices(const discrete::Graph& graph) {
  return [&graph](text::Checker& check, text::Document::Node node, VertexId& vertex) {
    std::int64_t x = 0, y = 0;
    if (graph.layout()) {
      if (!check.pair(node, INT32_MAX, x, y)) return false;
      const auto found =
          graph.layout()->vertex_at({static_cast<std::int32_t>(x), static_cast<std::int32_t>(y)});
      if (found) vertex = *found;
      return found || check.fail(node, "there is no such cell, or it is blocked");
    }
    if (!check.integer(node, 0, static_cast<std::int64_t>(graph.num_vertices()) - 1, x))
      return false;
    vertex = VertexId(static_cast<std::size_t>(x));
    return true;
  };
}

}  // namespace

ExitCode view_grid(const CLI::App& app, const ViewArguments& arguments) {
  std::string wrong = why_no_roadmap(arguments.roadmap);
  if (wrong.empty()) wrong = check_grid_options(arguments.input, Need::plan);
  if (wrong.empty()) wrong = arguments.format.why_not_discrete("--plan-format");
  if (wrong.empty()) wrong = check_view_outputs(arguments);
  if (!wrong.empty()) return usage_error(app, wrong);

  std::optional<Attribution> attribution;
  Objective objective = Objective::sum_of_costs;
  GivenPlan plan(arguments.plan);
  // `where`: a graph or an instance.
  const auto read_for = [&](const auto& where) -> Result<discrete::PlanFile> {
    if (!plan.text()) return plan.text().error();
    std::istringstream in(*plan.text());
    return discrete::read_plan(in, plan.file(), where, arguments.format.discrete);
  };
  const auto load = [&]() -> Result<input::GridInput> {
    auto input = load_grid_input(arguments.input);
    if (!input || !is_map_alone(arguments.input)) return input;
    const auto file = read_for(input->instance.graph());
    if (!file) return file.error();
    return with_agents_of(*std::move(input), file->plan, arguments.plan);
  };
  const auto read = [&](const input::GridInput& input) -> Result<discrete::PlanFile> {
    auto file = read_for(input.instance);
    if (!file) return file;
    const auto found =
        input::read_attribution(*plan.text(), arguments.plan, input.instance.num_agents(),
                                reader_of_vertices(input.instance.graph()));
    if (!found) return found.error();
    attribution = *found;
    objective = file->stated.objective;
    return file;
  };
  const auto page = [&](const input::GridInput& input, const discrete::Plan& paths) {
    view::PageOptions options;
    options.title = std::filesystem::path(input.source).filename().string();
    options.objective = objective;
    options.agent_names = shown_names(input.names);
    options.attribution = attribution;
    return view::page(input.instance, paths, options);
  };
  const auto draw = [&](const input::GridInput& input, const discrete::Plan& paths) {
    return view::picture(input.instance, paths, arguments.picture.options);
  };
  return view_and_write(arguments, load, read, page, draw);
}

}  // namespace quadrille::cli
