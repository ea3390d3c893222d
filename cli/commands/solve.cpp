// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <atomic>
#include <memory>
#include <utility>

#include "asked/solve_arguments.hpp"
#include "frame/arguments.hpp"
#include "frame/input_watch.hpp"
#include "frame/output.hpp"
#include "frame/signals.hpp"
#include "frame/subcommands.hpp"
#include "grid/solve_grid.hpp"
#include "quadrille/core/stated_outcome.hpp"
#include "roadmap/solve_roadmap.hpp"

namespace quadrille::cli {
namespace {

using discrete::CostSearch;
using discrete::System;

constexpr std::int64_t kMaxSeed = 2'000'000'000;

constexpr const char* kFooter =
    "Example:\n"
    "  quadrille solve --map empty-8-8.map --scen empty-8-8-random-1.scen --agents 10\n"
    "\n"
    "In continuous time:\n"
    "  quadrille solve --roadmap map.xml --task task.xml --agents 10 --radius 0.35\n"
    "  quadrille solve --instance discs.json\n"
    "\n"
    "Robots that turn, as in the League of Robot Runners:\n"
    "  quadrille solve --map empty-8-8.map --scen empty-8-8-random-1.scen --agents 10 --headings "
    "4\n"
    "\n"
    "SIGINT and SIGTERM end the search with what is known so far; a second one ends the program.\n"
    "\n";

constexpr const char* kExplainFooter =
    "Example:\n"
    "  quadrille explain --map maze.map --scen maze.scen --agents 10\n"
    "\n";

std::optional<std::optional<System>> choose_system(std::string_view text) {
  const auto system = discrete::parse_system(text);
  if (!system) return std::nullopt;
  return std::optional(system);
}

std::optional<std::optional<CostSearch>> choose_cost_search(std::string_view text) {
  const auto search = discrete::parse_cost_search(text);
  if (!search) return std::nullopt;
  return std::optional(search);
}

std::optional<std::optional<bool>> choose_backtracking(std::string_view text) {
  if (text == "chronological") return std::optional(true);
  if (text == "jump") return std::optional(false);
  return std::nullopt;
}

void add_search_options(CLI::App& app, SolveArguments& arguments) {
  const std::string group = "Search";
  discrete::SolveOptions& options = arguments.options;
  add_choice<Objective>(app, "--objective", options.objective, "sum-of-costs or makespan",
                        parse_objective, "sum-of-costs (default) or makespan")
      ->group(group);
  add_choice<std::optional<System>>(app, "--system", arguments.system,
                                    "dpll, dpll-mdd, smt-cbs or mdd-sat", choose_system,
                                    "dpll (default), dpll-mdd, smt-cbs or mdd-sat")
      ->group(group);
  const auto read_check = [&arguments](const std::string& text) {
    auto schedule = discrete::parse_check_schedule(text);
    if (!schedule) throw CLI::ValidationError("--check", schedule.error().message);
    arguments.check = std::move(schedule.value());
  };
  app.add_option_function<std::string>(
         "--check", read_check,
         "When dpll-mdd checks unfinished assignments: watch (default), propagate, or at\n"
         "shares of the assigned literals, such as 1/2,3/4. With it, dpll means dpll-mdd")
      ->type_name("SCHEDULE")
      ->group(group);
  add_choice<std::optional<CostSearch>>(
      app, "--cost-search", options.cost_search, "iterative or core-guided", choose_cost_search,
      "How the least sum of costs is searched for: core-guided (default of dpll) or\n"
      "iterative (default of the others)")
      ->group(group);
  add_choice<discrete::MddGrowth>(app, "--mdd-growth", options.mdd.growth, "on-demand or full",
                                  discrete::parse_mdd_growth,
                                  "How far the MDDs reach at first: on-demand (default) or full")
      ->group(group);
  add_choice<discrete::Tie>(
      app, "--tie", options.tie, "any or fewest-moves", discrete::parse_tie,
      "Which plan of least cost: any (default), or one with the fewest moves, proved")
      ->group(group);
  app.add_flag("--forbid-first", options.lazy.forbid_first,
               "dpll: try first to forbid usages; faster on some hard instances, slower on others")
      ->group(group);
  add_choice<std::optional<bool>>(
      app, "--backtracking", options.lazy.chronological, "chronological or jump",
      choose_backtracking,
      "dpll: backtrack chronologically (default with 175 agents or more) or jump back as\n"
      "far as each lemma asks")
      ->group(group);
  app.add_flag_callback(
         "--no-first-plan", [&options] { options.first_plan = false; },
         "Do not look for a plan of any cost before and beside the proof")
      ->group(group);
  add_input_file(app, "--initial-plan", arguments.initial_plan,
                 "Begin with this valid plan, such as that of a run that a limit ended")
      ->group(group);
  add_cost(app, "--known-bound", arguments.known_bound,
           "No plan costs less than this, as is known from elsewhere: begin with it")
      ->group(group);
  add_integer(app, "--threads", arguments.threads, 1, static_cast<std::int64_t>(kMaxThreads),
              "Searches side by side, 1 to 64: for the bound, for plans, further ones for either; "
              "default 1")
      ->group(group);
  app.add_flag(
         "--race", options.race,
         "With --threads: do not wait for each other, take the proof that comes first in time;\n"
         "the plan may differ from run to run then")
      ->group(group);
  add_integer(app, "--seed", arguments.seed, 0, kMaxSeed,
              "Seed of all random choices, 0 to 2000000000; default 0")
      ->group(group);
}

void add_limit_options(CLI::App& app, SolveArguments& arguments) {
  const std::string group = "Limits";
  Limits& limits = arguments.options.limits;
  add_seconds(app, "--time-limit", limits.wall_s,
              "Stop after this wall-clock time; 0 stops at once")
      ->group(group);
  add_seconds(app, "--cpu-limit", limits.cpu_s, "Stop after this CPU time, of all threads together")
      ->group(group);
  add_integer(app, "--memory-limit", arguments.memory_mib, 1, std::int64_t{1} << 40,
              "Stop when reading and searching have added this many MiB to the process")
      ->group(group);
  add_integer(app, "--conflict-limit", limits.conflicts, 0, INT64_MAX,
              "Stop after this many conflicts of the SAT solver")
      ->group(group);
  add_per_cents(app, "--gap", arguments.options.gap_percent,
                "Stop when the plan costs at most this many per cent more than is proved necessary")
      ->group(group);
}

/// For measurements: users are not told.
void add_settings(CLI::App& app, Settings& settings) {
  const auto read = [&settings](const std::vector<std::string>& assignments) {
    for (const std::string& assignment : assignments)
      if (const auto error = assign_setting(settings, assignment))
        throw CLI::ValidationError("--set", error->message);
  };
  app.add_option_function<std::vector<std::string>>("--set", read, "name=value of a setting")
      ->group("");
}

void add_output_options(CLI::App& app, SolveArguments& arguments) {
  const std::string group = "Output";
  add_file(app, "--plan", arguments.plan, "Write the plan to a file; - is standard output")
      ->group(group);
  add_plan_format(app, "--plan-format", arguments.plan_format,
                  "json, cbsh2, lns2, visualizer, lacam or yaml, for roadmaps json or ccbs;\n"
                  "default: by the name of the file, else json")
      ->group(group);
  add_seconds(app, "--plan-every", arguments.plan_every,
              "Write each better plan to the file of --plan, at most once in this time")
      ->group(group);
  add_file(app, "--json", arguments.json, "Write the result as JSON; - is standard output")
      ->group(group);
  add_check_with(app, arguments.check_with)->group(group);
  app.add_flag("--history", arguments.history,
               "With --json: tell in the result when which bound and which cost was known")
      ->group(group);
  add_file(app, "--view", arguments.view,
           "Write a page that plays the plan in a browser; - is standard output")
      ->group(group);
  add_picture_options(app, arguments.picture, group);
  add_file(app, "--proof", arguments.proof,
           "Write why no plan is cheaper, or why there is none, for quadrille-check;\n"
           "- is standard output")
      ->group(group);
  app.add_flag("--quiet", arguments.quiet, "Print nothing but errors and what is asked for")
      ->group(group);
  app.add_flag("--explain", arguments.options.explain,
               "Say what the lower bound is made of: which agents, where and when")
      ->group(group);
  app.add_flag("--audit", arguments.options.debug.audit,
               "Check every lemma against the rules; slow")
      ->group("Debugging");
  add_input_file(app, "--known-plan", arguments.known_plan,
                 "Check every clause against this valid plan; slow")
      ->group("Debugging");
  add_settings(app, arguments.options.settings);
}

ExitCode run(const CLI::App& app, SolveArguments& arguments) {
  Limits& limits = arguments.options.limits;
  limits.interrupt = &catch_interrupts();  // before anything is read
  if (arguments.memory_mib) limits.memory_mib = static_cast<double>(*arguments.memory_mib);
  arguments.input.most_vertices = discrete::kMaxVertices;
  std::atomic<bool> has_roadmap = arguments.roadmap.name_roadmap();
  InputWatch watch(limits, [&has_roadmap, arguments](StopReason reason, const Usage& used) {
    // The command line may not have been checked yet.
    if (!check_solve_outputs(arguments).empty()) return ExitCode::unknown;
    return has_roadmap ? end_roadmap_input(arguments, reason, used)
                       : end_grid_input(arguments, reason, used);
  });
  has_roadmap = is_roadmap(arguments.input, arguments.roadmap);
  return has_roadmap ? solve_roadmap(app, arguments, watch) : solve_grid(app, arguments, watch);
}

}  // namespace

std::string check_solve_outputs(const SolveArguments& arguments) {
  std::string wrong =
      check_outputs({{"--plan", &arguments.plan, &arguments.initial_plan},
                     {"--json", &arguments.json},
                     {"--view", &arguments.view},
                     {"--proof", &arguments.proof},
                     {"--svg", &arguments.picture.file}},
                    {&arguments.input.map, &arguments.input.scen, &arguments.input.instance,
                     &arguments.roadmap.roadmap, &arguments.roadmap.task, &arguments.initial_plan,
                     &arguments.known_plan},
                    !arguments.quiet);
  if (wrong.empty() && arguments.plan_format.is_given() && arguments.plan.empty())
    wrong = "--plan-format needs --plan";
  if (wrong.empty()) wrong = check_picture_options(arguments.picture);
  if (wrong.empty() && arguments.plan_every && (arguments.plan.empty() || arguments.plan == "-"))
    wrong = "--plan-every needs --plan with a file";
  if (wrong.empty() && arguments.history && arguments.json.empty())
    wrong = "--history needs --json";
  return wrong;
}

Subcommand add_explain(CLI::App& program) {
  CLI::App* app =
      program.add_subcommand("explain", "Say why no plan is cheaper, or why none exists");
  const auto arguments = std::make_shared<SolveArguments>();
  arguments->options.explain = arguments->finds_reasons = true;
  add_input_options(*app, arguments->input);
  add_roadmap_options(*app, arguments->roadmap);
  add_choice<Objective>(*app, "--objective", arguments->options.objective,
                        "sum-of-costs or makespan", parse_objective,
                        "sum-of-costs (default) or makespan");
  add_integer(*app, "--seed", arguments->seed, 0, kMaxSeed,
              "Seed of all random choices, 0 to 2000000000; default 0");
  add_limit_options(*app, *arguments);
  add_file(*app, "--json", arguments->json, "Write it as JSON; - is standard output");
  add_file(*app, "--view", arguments->view,
           "Write a page that shows it on the map, for a browser; - is standard output");
  app->footer(std::string(kExplainFooter) + kExitCodesHelp);
  return {app, [app, arguments] { return run(*app, *arguments); }};
}

Subcommand add_solve(CLI::App& program) {
  CLI::App* app = program.add_subcommand("solve", "Find a plan of least cost");
  const auto arguments = std::make_shared<SolveArguments>();
  add_input_options(*app, arguments->input);
  add_roadmap_options(*app, arguments->roadmap);
  add_search_options(*app, *arguments);
  add_limit_options(*app, *arguments);
  add_output_options(*app, *arguments);
  app->footer(std::string(kFooter) + kExitCodesHelp);
  return {app, [app, arguments] { return run(*app, *arguments); }};
}

}  // namespace quadrille::cli
