// SPDX-License-Identifier: MIT
#include "grid/view_grid.hpp"

#include <filesystem>
#include <optional>
#include <sstream>

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
  if (wrong.empty()) wrong = check_grid_options(arguments.input, Need::tasks);
  if (wrong.empty()) wrong = arguments.format.why_not_discrete("--plan-format");
  if (wrong.empty()) wrong = check_view_outputs(arguments);
  if (!wrong.empty()) return usage_error(app, wrong);

  std::optional<Attribution> attribution;
  Objective objective = Objective::sum_of_costs;
  const auto read = [&](const input::GridInput& input) -> Result<discrete::PlanFile> {
    const discrete::Graph& graph = input.instance.graph();
    const auto text = input::read_text(arguments.plan);
    if (!text) return text.error();
    std::istringstream in(*text);
    auto file = discrete::read_plan(in, arguments.plan, graph, arguments.format.discrete);
    if (!file) return file;
    const auto found = input::read_attribution(*text, arguments.plan, input.instance.num_agents(),
                                               reader_of_vertices(graph));
    if (!found) return found.error();
    attribution = *found;
    objective = file->stated.objective;
    return file;
  };
  const auto page = [&](const input::GridInput& input, const discrete::Plan& plan) {
    view::PageOptions options;
    options.title = std::filesystem::path(input.source).filename().string();
    options.objective = objective;
    options.attribution = attribution;
    return view::page(input.instance, plan, options);
  };
  const auto draw = [&](const input::GridInput& input, const discrete::Plan& plan) {
    return view::picture(input.instance, plan, arguments.picture.options);
  };
  return view_and_write(
      arguments, [&] { return load_grid_input(arguments.input); }, read, page, draw);
}

}  // namespace quadrille::cli
