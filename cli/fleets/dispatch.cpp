// SPDX-License-Identifier: MIT
#include "fleets/dispatch.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <memory>
#include <utility>

#include "answers/delivery.hpp"
#include "asked/shown_names.hpp"
#include "fleets/dispatch_run.hpp"
#include "fleets/dispatch_serve.hpp"
#include "fleets/grid_fleet.hpp"
#include "fleets/roadmap_fleet.hpp"
#include "frame/arguments.hpp"
#include "frame/output.hpp"
#include "grid/grid_text.hpp"
#include "quadrille/input/grid.hpp"
#include "quadrille/input/robot_runners.hpp"
#include "quadrille/view/page.hpp"
#include "roadmap/roadmap_text.hpp"

namespace quadrille::cli {
namespace {

/// What is wrong with times of whole ticks; empty if nothing is.
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

/// Those that one dispatcher has, and the other one has not.
std::string check_kind(const DispatchArguments& arguments, DispatcherKind kind) {
  if (kind == DispatcherKind::roadmap)
    return arguments.window ? "--window belongs to --dispatcher grid" : "";
  const std::pair<const char*, bool> others[] = {{"--step", arguments.step.value_or(1) != 1},
                                                 {"--reach", arguments.reach.has_value()},
                                                 {"--patience", arguments.patience.has_value()}};
  for (const auto& [option, is_given] : others)
    if (is_given)
      return fmt::format(
          "{}: on a grid a call is one timestep, which all take at the same time; "
          "it belongs to --dispatcher roadmap",
          option);
  for (const auto& [option, time] :
       {std::pair{"--service", arguments.service}, {"--longest", arguments.longest}})
    if (time && *time != std::floor(*time))
      return fmt::format("{}: on a grid times are whole timesteps", option);
  return "";
}

/// What the input is: read as a grid or as a roadmap.
struct Choice {
  bool has_roadmap = false;  ///< Options or file name one.
  DispatcherKind kind = DispatcherKind::grid;
};

std::string check(const DispatchArguments& arguments, const Choice& choice) {
  std::string wrong = check_serving(arguments);
  if (wrong.empty()) wrong = check_kind(arguments, choice.kind);
  if (!wrong.empty()) return wrong;
  if (choice.has_roadmap) {
    const auto& text = arguments.input.instance_text;
    if (choice.kind == DispatcherKind::grid && !(text && input::is_robot_runners(*text)))
      return "--dispatcher grid needs a grid or graph, and not a roadmap";
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

/// The cells of `cells`, if it has any; tracks are in its ticks and length units.
std::string page(const input::RoadmapInput& input, const std::vector<view::Track>& tracks) {
  view::PageOptions options;
  options.title = std::filesystem::path(input.source).filename().string();
  options.agent_names = shown_names(input.names);
  return view::page(input.instance, tracks, options, input.cells_or_null());
}

/// Of who goes from cell to cell: seen as discs on the roadmap that the grid is.
Result<std::string> page(const input::GridInput& input, std::vector<view::Track> tracks) {
  const auto cells = input::as_roadmap(input);
  if (!cells) return cells.error();
  const continuous::Resolution& sizes = cells->instance.resolution();
  const double pitch = 1 / sizes.length;
  const auto timestep = static_cast<std::int64_t>(std::llround(1 / sizes.time));
  for (view::Track& track : tracks)
    for (view::Sight& sight : track)
      sight = {pitch * sight.x, pitch * sight.y, 0, timestep * sight.arrive,
               timestep * sight.depart};
  return page(*cells, tracks);
}

/// Lets it work, and says what came of it. `run_fleet`: on what it drives.
template <class Input, class RunFleet>
ExitCode simulate(const DispatchArguments& arguments, const Input& input, DispatchWork work,
                  const RunFleet& run_fleet) {
  Delivery delivery(arguments.quiet, "", arguments.json, arguments.view);
  if (!delivery.probe()) return ExitCode::output;
  DispatchRun run(arguments, std::move(work));
  if (auto error = run_fleet(arguments, input, run)) {
    report_error(*error);
    return ExitCode::bad_input;
  }
  if (delivery.has_view_file()) {
    Result<std::string> text = page(input, run.tracks());
    if (!text) {
      report_error(text.error());
      return ExitCode::bad_input;
    }
    delivery.write_view(std::move(text));
  }
  if (delivery.has_json_file()) delivery.write_json(run.report().json());
  delivery.print_summary(describe_input(input) + run.report().text(), "");
  return delivery.finish(run.report().contacts > 0 ? ExitCode::internal : ExitCode::success);
}

/// Vertices of a grid are called [x, y].
text::Names names_with_cells(const input::GridInput& input) {
  text::Names names = input.names;
  const auto& layout = input.instance.graph().layout();
  if (!layout || !names.vertices.empty()) return names;
  for (const VertexId v : IdRange<VertexId>(layout->num_vertices())) {
    const discrete::Cell cell = layout->cell_of(v);
    names.vertices.push_back(fmt::format("[{},{}]", cell.x, cell.y));
  }
  return names;
}

ExitCode serve_fleet(const DispatchArguments& arguments, const text::Names& names,
                     Result<std::unique_ptr<LiveFleet>> fleet) {
  if (fleet) return serve(arguments, names, **fleet);
  report_error(fleet.error());
  return ExitCode::bad_input;
}

/// Loads it, and does what was asked with it.
ExitCode dispatch_on_roadmap(const CLI::App& app, const DispatchArguments& arguments,
                             const Result<input::RoadmapInput>& input) {
  if (!input) {
    report_error(input.error());
    return ExitCode::bad_input;
  }
  if (auto wrong = check_times(arguments, input->instance.resolution().time); !wrong.empty())
    return usage_error(app, wrong);
  if (arguments.serves)
    return serve_fleet(arguments, input->names, serve_on_roadmap(arguments, *input));
  return simulate(arguments, *input, work_on_roadmap(*input), run_on_roadmap);
}

Result<input::GridInput> load_fleet(const input::InputOptions& options) {
  auto grid = load_grid_input(options);
  if (grid && grid->instance.now() != 0)
    return Error{ErrorCode::invalid_instance,
                 fmt::format("robots that are sent about begin at timestep 0, and not at {}",
                             grid->instance.now()),
                 {grid->source, 0}};
  return grid;
}

ExitCode dispatch_on_grid(const CLI::App& app, const DispatchArguments& arguments) {
  const auto input = load_fleet(arguments.input);
  if (!input) {
    report_error(input.error());
    return ExitCode::bad_input;
  }
  if (auto wrong = check_times(arguments, 1); !wrong.empty()) return usage_error(app, wrong);
  if (arguments.serves)
    return serve_fleet(arguments, names_with_cells(*input), serve_on_grid(arguments, *input));
  return simulate(arguments, *input, work_on_grid(*input), run_on_grid);
}

Result<input::RoadmapInput> grid_as_roadmap(const input::InputOptions& options) {
  const auto grid = load_fleet(options);
  if (!grid) return grid.error();
  return input::as_roadmap(*grid);
}

}  // namespace

ExitCode dispatch_fleet(const CLI::App& app, DispatchArguments& arguments) {
  Choice choice{is_roadmap(arguments.input, arguments.roadmap)};
  choice.kind = arguments.dispatcher.value_or(choice.has_roadmap ? DispatcherKind::roadmap
                                                                 : DispatcherKind::grid);
  if (const std::string wrong = check(arguments, choice); !wrong.empty())
    return usage_error(app, wrong);
  if (choice.kind == DispatcherKind::grid) return dispatch_on_grid(app, arguments);
  return dispatch_on_roadmap(app, arguments,
                             choice.has_roadmap
                                 ? load_roadmap_input(arguments.roadmap, arguments.input)
                                 : grid_as_roadmap(arguments.input));
}

}  // namespace quadrille::cli
