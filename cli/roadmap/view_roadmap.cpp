// SPDX-License-Identifier: MIT
#include "roadmap/view_roadmap.hpp"

#include <filesystem>
#include <optional>

#include "asked/shown_names.hpp"
#include "frame/arguments.hpp"
#include "quadrille/input/attribution.hpp"
#include "roadmap/drawing.hpp"
#include "roadmap/roadmap_plan.hpp"

namespace quadrille::cli {

namespace {

input::ReadVertex reader_of_vertices(const continuous::Roadmap& roadmap) {
  return [&roadmap](text::Checker& check, text::Document::Node node, VertexId& vertex) {
    std::int64_t number = 0;
    const auto last = static_cast<std::int64_t>(roadmap.num_vertices()) - 1;
    if (!check.integer(node, 0, last, number)) return false;
    vertex = VertexId(static_cast<std::size_t>(number));
    return true;
  };
}

}  // namespace

ExitCode view_roadmap(const CLI::App& app, const ViewArguments& arguments) {
  std::string wrong = check_roadmap_options(arguments.roadmap, arguments.input, Need::plan);
  if (wrong.empty()) wrong = arguments.format.why_not_continuous("--plan-format");
  if (wrong.empty()) wrong = check_view_outputs(arguments);
  if (!wrong.empty()) return usage_error(app, wrong);

  std::optional<Attribution> attribution;
  Objective objective = Objective::sum_of_costs;
  RoadmapPlan given(arguments.roadmap, arguments.input, arguments.plan,
                    arguments.format.continuous);
  const auto read = [&](const input::RoadmapInput& input) -> Result<continuous::PlanFile> {
    auto file = given.read(input);
    if (!file) return file;
    const auto found =
        input::read_attribution(*given.text(), arguments.plan, input.instance.num_agents(),
                                reader_of_vertices(input.instance.roadmap()));
    if (!found) return found.error();
    attribution = *found;
    objective = file->stated.objective;
    return file;
  };
  const auto page = [&](const input::RoadmapInput& input, const continuous::Plan& plan) {
    view::PageOptions options;
    options.title = std::filesystem::path(input.source).filename().string();
    options.objective = objective;
    options.agent_names = shown_names(input.names);
    options.attribution = attribution;
    return page_of(input, plan, options);
  };
  const auto draw = [&](const input::RoadmapInput& input, const continuous::Plan& plan) {
    return picture_of(input, plan, arguments.picture.options);
  };
  return view_and_write(
      arguments, [&] { return given.load(); }, read, page, draw);
}

}  // namespace quadrille::cli
