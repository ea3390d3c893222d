// SPDX-License-Identifier: MIT
#include "roadmap/dispatch_roadmap.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <utility>

#include "answers/delivery.hpp"
#include "asked/shown_names.hpp"
#include "frame/arguments.hpp"
#include "frame/output.hpp"
#include "quadrille/input/grid.hpp"
#include "quadrille/view/page.hpp"
#include "roadmap/dispatch_run.hpp"
#include "roadmap/dispatch_serve.hpp"
#include "roadmap/roadmap_text.hpp"

namespace quadrille::cli {
namespace {

/// What is wrong with times; empty if nothing is.
std::string check_times(const DispatchArguments& arguments, double tick) {
  const std::pair<const char*, const std::optional<double>*> times[] = {
      {"--step", &arguments.step},
      {"--service", &arguments.service},
      {"--longest", &arguments.longest},
      {"--reach", &arguments.reach},
      {"--patience", &arguments.patience}};
  for (const auto& [option, time] : times)
    if (*time && **time / tick > 1e9) return fmt::format("{} is too long", option);
  const auto steps = static_cast<double>(arguments.steps.value_or(kDispatchSteps));
  if (steps * arguments.step.value_or(1) / tick >
      static_cast<double>(geometry::kMaxDuration.value()) / 4)
    return "--steps times --step is too long";
  return "";
}

/// The options that a simulation has, and a server has not.
std::string check_serving(const DispatchArguments& arguments) {
  if (!arguments.serves) return "";
  const std::pair<const char*, bool> others[] = {
      {"--steps", arguments.steps.has_value()},     {"--step", arguments.step.has_value()},
      {"--service", arguments.service.has_value()}, {"--delays", arguments.pauses.has_value()},
      {"--longest", arguments.longest.has_value()}, {"--seed", arguments.seed.has_value()},
      {"--json", !arguments.json.empty()},          {"--view", !arguments.view.empty()}};
  for (const auto& [option, is_given] : others)
    if (is_given) return fmt::format("{} belongs to a simulation, not to --serve", option);
  return "";
}

std::string check(const DispatchArguments& arguments, bool has_roadmap) {
  std::string wrong = check_serving(arguments);
  if (!wrong.empty()) return wrong;
  if (has_roadmap) {
    wrong = check_roadmap_options(arguments.roadmap, arguments.input, Need::tasks);
  } else {
    wrong = why_no_roadmap(arguments.roadmap);
    if (wrong.empty()) wrong = check_grid_options(arguments.input, Need::tasks);
  }
  if (!wrong.empty()) return wrong;
  return check_outputs({{"--json", &arguments.json}, {"--view", &arguments.view}},
                       {&arguments.input.map, &arguments.input.scen, &arguments.input.instance,
                        &arguments.roadmap.roadmap, &arguments.roadmap.task},
                       !arguments.quiet && !arguments.serves);
}

Result<input::RoadmapInput> load(const DispatchArguments& arguments, bool has_roadmap) {
  if (has_roadmap) return load_roadmap_input(arguments.roadmap, arguments.input);
  const auto grid = load_grid_input(arguments.input);
  if (!grid) return grid.error();
  return input::as_roadmap(*grid);
}

std::string page(const input::RoadmapInput& input, const std::vector<view::Track>& tracks) {
  view::PageOptions options;
  options.title = std::filesystem::path(input.source).filename().string();
  options.agent_names = shown_names(input.names);
  return view::page(input.instance, tracks, options, input.cells_or_null());
}

ExitCode simulate(const DispatchArguments& arguments, const input::RoadmapInput& input) {
  Delivery delivery(arguments.quiet, "", arguments.json, arguments.view);
  if (!delivery.probe()) return ExitCode::output;
  DispatchRun run(arguments, input);
  if (auto error = run.run()) {
    report_error(*error);
    return ExitCode::bad_input;
  }
  if (delivery.has_view_file()) delivery.write_view(Result<std::string>(page(input, run.tracks())));
  if (delivery.has_json_file()) delivery.write_json(run.report().json());
  delivery.print_summary(describe_input(input) + run.report().text(), "");
  return delivery.finish(run.report().contacts > 0 ? ExitCode::internal : ExitCode::success);
}

}  // namespace

ExitCode dispatch_on_roadmap(const CLI::App& app, DispatchArguments& arguments) {
  const bool has_roadmap = is_roadmap(arguments.input, arguments.roadmap);
  std::string wrong = check(arguments, has_roadmap);
  if (!wrong.empty()) return usage_error(app, wrong);
  const auto input = load(arguments, has_roadmap);
  if (!input) {
    report_error(input.error());
    return ExitCode::bad_input;
  }
  wrong = check_times(arguments, input->instance.resolution().time);
  if (!wrong.empty()) return usage_error(app, wrong);
  return arguments.serves ? serve_dispatcher(arguments, *input) : simulate(arguments, *input);
}

}  // namespace quadrille::cli
