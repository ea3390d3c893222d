// SPDX-License-Identifier: MIT
#include "fleets/dispatch.hpp"

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "frame/arguments.hpp"
#include "frame/subcommands.hpp"

namespace quadrille::cli {
namespace {

constexpr const char* kFooter =
    "Robots start where the agents of the instance do. Whoever has no task gets one at any\n"
    "vertex, or the nearest one that is known; robots are held up at random, and never collide\n"
    "(docs/dispatch.md). The gap of a call is by how much its paths are longer than they could\n"
    "be without the others. On grids and graphs all take a timestep at the same time; with\n"
    "--dispatcher roadmap each has a clock of its own, and a move takes one unit of time.\n"
    "\n"
    "Example:\n"
    "  quadrille dispatch --instance discs.json --steps 600 --step 0.5 --delays 0.02\n"
    "  quadrille dispatch --map x.map --scen x.scen --agents 50 --view work.html\n"
    "  quadrille dispatch --instance discs.json --serve\n"
    "\n";

constexpr std::int64_t kMaxSteps = 10'000'000;
constexpr std::int64_t kMaxWindow = 1'000;

std::optional<std::optional<DispatcherKind>> choose_dispatcher(std::string_view name) {
  if (name == "grid") return std::optional(DispatcherKind::grid);
  if (name == "roadmap") return std::optional(DispatcherKind::roadmap);
  return std::nullopt;
}

}  // namespace

Subcommand add_dispatch(CLI::App& program) {
  CLI::App* app =
      program.add_subcommand("dispatch", "Let a fleet work, with tasks that keep coming");
  const auto arguments = std::make_shared<DispatchArguments>();
  add_input_options(*app, arguments->input);
  add_roadmap_options(*app, arguments->roadmap);
  add_choice<std::optional<DispatcherKind>>(
      *app, "--dispatcher", arguments->dispatcher, "grid or roadmap", choose_dispatcher,
      "grid: timestep by timestep, all at the same time, thousands of robots; roadmap: each\n"
      "robot by a clock of its own; default: by the input; roadmap for robots that turn");
  add_integer(*app, "--steps", arguments->steps, 1, kMaxSteps,
              "Calls of the dispatcher; default 1000");
  add_positive(*app, "--step", arguments->step,
               "Time from one call to the next, in the instance's unit of time; default 1");
  app->add_flag(
      "--own-tasks", arguments->has_own_tasks,
      "The goals of the agents are all there is to do; default: the tasks of a problem of\n"
      "the League of Robot Runners, else random ones");
  add_positive(*app, "--service", arguments->service,
               "Time that a task takes at its goal; default 0");
  add_share(*app, "--delays", arguments->pauses,
            "Chance per call that a robot which goes on pauses; default 0");
  add_positive(*app, "--longest", arguments->longest, "Longest pause; default 3");
  add_positive(*app, "--effort", arguments->effort,
               "For looking for paths, per call: nominal milliseconds, counted in steps;\n"
               "default 20");
  add_integer(*app, "--window", arguments->window, 1, kMaxWindow,
              "On grids: timesteps that are planned ahead; default 20");
  add_positive(*app, "--reach", arguments->reach,
               "How far a robot may go beyond where it was last seen, as time on its course;\n"
               "default: any");
  add_positive(
      *app, "--patience", arguments->patience,
      "Robots that are later are planned for from where they are; default: 8 times --step");
  add_seconds(*app, "--call-limit", arguments->wall,
              "Seconds of wall clock per call for looking for paths; default: none");
  app->add_flag("--no-improvement", arguments->does_not_improve,
                "What is left of the effort is not used to make paths cheaper");
  add_integer(*app, "--seed", arguments->seed, 0, 2'000'000'000,
              "Seed of tasks and pauses; default 0");
  add_file(*app, "--json", arguments->json, "Write the report as JSON; - is standard output");
  add_file(*app, "--view", arguments->view,
           "Write a page that plays what the robots did; - is standard output");
  app->add_flag("--serve", arguments->serves,
                "No simulation: requests on standard input, one JSON object per line, and an\n"
                "answer to each on standard output");
  app->add_flag("--quiet", arguments->quiet, "Print nothing but errors and what is asked for");
  app->footer(std::string(kFooter) + kExitCodesHelp);
  return {app, [app, arguments] { return dispatch_fleet(*app, *arguments); }};
}

}  // namespace quadrille::cli
