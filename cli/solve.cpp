// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <sstream>
#include <utility>
#include <vector>

#include "delivery.hpp"
#include "grid/picture.hpp"
#include "grid/report.hpp"
#include "input.hpp"
#include "outcome_check.hpp"
#include "output.hpp"
#include "progress.hpp"
#include "quadrille/discrete/verify.hpp"
#include "roadmap/solve_roadmap.hpp"
#include "signals.hpp"
#include "subcommands.hpp"

namespace quadrille::cli {
namespace {

using discrete::CostSearch;
using discrete::PlanFormat;
using discrete::SolveOutcome;
using discrete::System;

constexpr std::int64_t kMaxThreads = 64;
constexpr std::int64_t kMaxSeed = 2'000'000'000;

constexpr const char* kFooter =
    "Example:\n"
    "  quadrille solve --map empty-8-8.map --scen empty-8-8-random-1.scen --agents 10\n"
    "\n"
    "In continuous time:\n"
    "  quadrille solve --roadmap map.xml --task task.xml --agents 10 --radius 0.35\n"
    "  quadrille solve --instance discs.json\n"
    "\n"
    "SIGINT and SIGTERM end the search with what is known so far; a second one ends the program.\n"
    "\n";

struct SolveArguments {
  SolveRequest request;
  RoadmapOptions roadmap;
  std::optional<System> system;
  std::optional<discrete::CheckSchedule> check;
  std::optional<std::int64_t> seed, threads, memory_mib;
  std::string plan, json;
  PlanFormats plan_format;
  bool quiet = false;
};

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
  discrete::SolveOptions& options = arguments.request.options;
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
  app.add_flag("--forbid-first", options.lazy.forbid_first,
               "dpll: try first to forbid usages; faster on some hard instances, slower on others")
      ->group(group);
  add_choice<std::optional<bool>>(
      app, "--backtracking", options.lazy.chronological, "chronological or jump",
      choose_backtracking,
      "dpll: backtrack chronologically (default with 175 agents or more) or jump back as\n"
      "far as each lemma asks")
      ->group(group);
  app.add_flag("!--no-first-plan", options.first_plan,
               "Do not look for a plan of any cost before and beside the proof")
      ->group(group);
  add_integer(app, "--threads", arguments.threads, 1, kMaxThreads,
              "Searches side by side, with other systems; default 1")
      ->group(group);
  app.add_flag("--race", options.race,
               "With --threads: take the proof that comes first in time; the plan may differ from\n"
               "run to run then")
      ->group(group);
  add_integer(app, "--seed", arguments.seed, 0, kMaxSeed, "Seed of all random choices; default 0")
      ->group(group);
}

void add_limit_options(CLI::App& app, SolveArguments& arguments) {
  const std::string group = "Limits";
  Limits& limits = arguments.request.options.limits;
  add_seconds(app, "--time-limit", limits.wall_s,
              "Stop after this wall-clock time; 0 stops at once")
      ->group(group);
  add_seconds(app, "--cpu-limit", limits.cpu_s, "Stop after this CPU time, of all threads together")
      ->group(group);
  add_integer(app, "--memory-limit", arguments.memory_mib, 1, std::int64_t{1} << 40,
              "Stop when the search has added this many MiB to the process")
      ->group(group);
  add_integer(app, "--conflict-limit", limits.conflicts, 0, INT64_MAX,
              "Stop after this many conflicts of the SAT solver")
      ->group(group);
  add_per_cent(app, "--gap", arguments.request.options.gap_percent,
               "Stop when the plan is proved to cost at most this many per cent too much")
      ->group(group);
}

void add_output_options(CLI::App& app, SolveArguments& arguments) {
  const std::string group = "Output";
  add_file(app, "--plan", arguments.plan, "Write the plan to a file; - is standard output")
      ->group(group);
  add_plan_format(app, "--plan-format", arguments.plan_format,
                  "json, cbsh2, visualizer or yaml, for roadmaps json or ccbs; default: by the\n"
                  "name of the file, else json")
      ->group(group);
  add_file(app, "--json", arguments.json, "Write the result as JSON; - is standard output")
      ->group(group);
  app.add_flag("--quiet", arguments.quiet, "Print nothing but errors and what is asked for")
      ->group(group);
  app.add_flag("--audit", arguments.request.options.debug.audit,
               "Check every lemma against the rules; slow")
      ->group("Debugging");
  add_file(app, "--known-plan", arguments.request.known_plan,
           "Check every clause against this valid plan; slow")
      ->group("Debugging");
}

/// Why the outputs may not be written; empty if they may.
std::string check_files(const SolveArguments& arguments) {
  const SolveRequest& request = arguments.request;
  return check_outputs({{"--plan", &arguments.plan}, {"--json", &arguments.json}},
                       {&request.input.map, &request.input.scen, &request.input.instance,
                        &arguments.roadmap.roadmap, &arguments.roadmap.task, &request.known_plan});
}

/// What is wrong with the combination of options; empty if nothing is. Settles the system.
std::string settle(SolveArguments& arguments) {
  const InputOptions& input = arguments.request.input;
  std::string wrong = check_input_options(input, Need::tasks);
  if (!wrong.empty()) return wrong;
  wrong = check_files(arguments);
  if (!wrong.empty()) return wrong;
  if (arguments.plan_format.is_given() && arguments.plan.empty())
    return "--plan-format needs --plan";
  wrong = arguments.plan_format.why_not_discrete("--plan-format");
  if (!wrong.empty()) return wrong;

  discrete::SolveOptions& options = arguments.request.options;
  options.system = arguments.system.value_or(System::dpll);
  if (arguments.check) {
    // Schedules are a matter of the MDD path model: DPLL(MAPF) as published.
    if (options.system == System::dpll) options.system = System::dpll_mdd;
    if (!has_schedule(options.system)) return "--check belongs to --system dpll-mdd";
    options.mdd.check = *arguments.check;
  }
  if (arguments.threads) options.threads = static_cast<std::size_t>(*arguments.threads);
  if (options.race && options.threads == 1) return "--race needs --threads";
  if (arguments.seed) options.seed = static_cast<std::uint32_t>(*arguments.seed);
  if (arguments.memory_mib) options.limits.memory_mib = static_cast<double>(*arguments.memory_mib);
  if (!arguments.plan_format.discrete)
    arguments.plan_format.discrete =
        discrete::plan_format_of(arguments.plan).value_or(PlanFormat::json);
  return "";
}

/// The text of a plan file. Errors: the format cannot express it.
Result<std::string> plan_text(const discrete::Graph& graph, const discrete::Plan& plan,
                              PlanFormat format) {
  std::ostringstream text;
  if (auto error = write_plan(text, "", graph, plan, format)) return *error;
  return text.str();
}

/// One solve, from its arguments to its exit code.
class SolveRun {
 public:
  explicit SolveRun(SolveArguments& arguments)
      : arguments_(arguments), delivery_(arguments.quiet, arguments.plan, arguments.json) {}

  ExitCode run();

 private:
  std::optional<Error> read_known_plan(const discrete::Instance& instance);
  Result<SolveOutcome> search(const discrete::Instance& instance);
  ExitCode deliver(const Input& input, SolveOutcome outcome);

  SolveArguments& arguments_;
  Delivery delivery_;
};

std::optional<Error> SolveRun::read_known_plan(const discrete::Instance& instance) {
  SolveRequest& request = arguments_.request;
  if (request.known_plan.empty()) return std::nullopt;
  const std::filesystem::path path(request.known_plan);
  auto file = discrete::read_plan(path, instance.graph());
  if (!file) return file.error();
  const auto replay = verify(instance, file->plan);
  if (!replay.valid())
    return Error{ErrorCode::invalid_plan,
                 "not a valid plan: " + replay.violations.front().message,
                 {request.known_plan, 0}};
  request.options.debug.known_plan = file->plan;
  return std::nullopt;
}

Result<SolveOutcome> SolveRun::search(const discrete::Instance& instance) {
  ProgressLine line(!arguments_.quiet);
  discrete::SolveOptions options = arguments_.request.options;
  if (line.active())
    options.on_progress = [&line](const auto& progress) { line.show(progress_text(progress)); };
  return solve(instance, options);
}

ExitCode SolveRun::deliver(const Input& input, SolveOutcome outcome) {
  const SolveRequest& request = arguments_.request;
  const discrete::Instance& instance = input.instance;
  const auto replay = check_outcome(instance, request.options.objective, outcome);
  if (outcome.internal_error) {
    report_error({ErrorCode::internal, "internal check failed: " + outcome.internal_error->message,
                  outcome.internal_error->where});
    print_stderr(describe_violations(replay));
  }
  std::optional<Result<std::string>> plan;
  if (outcome.plan && delivery_.has_plan_file())
    plan = plan_text(instance.graph(), *outcome.plan, *arguments_.plan_format.discrete);
  delivery_.write_plan(plan);
  if (delivery_.has_json_file()) delivery_.write_json(result_json(instance, request, outcome));

  const auto* check = outcome.plan ? &replay : nullptr;
  const bool draw = outcome.plan && arguments_.plan.empty();
  delivery_.print_summary(describe_outcome(request, outcome, check),
                          draw ? draw_plan(instance, *outcome.plan) : "");
  return delivery_.finish(exit_code(outcome));
}

ExitCode SolveRun::run() {
  SolveRequest& request = arguments_.request;
  const auto input = load_input(request.input);
  if (!input) {
    report_error(input.error());
    return ExitCode::bad_input;
  }
  if (auto error = read_known_plan(input->instance)) {
    report_error(*error);
    return ExitCode::bad_input;
  }
  if (!arguments_.plan.empty()) {
    // Some formats need a grid; that must not come out after the search.
    const auto text = plan_text(input->instance.graph(), {}, *arguments_.plan_format.discrete);
    if (!text) {
      report_error(text.error());
      return ExitCode::bad_input;
    }
  }
  if (!delivery_.probe()) return ExitCode::output;

  const discrete::SolveOptions& options = request.options;
  delivery_.console().print(describe_input(*input));
  delivery_.console().print(
      fmt::format("system     {}{}, objective {}, seed {}\n", to_string(options.system),
                  has_schedule(options.system) ? " with check " + to_string(options.mdd.check) : "",
                  to_string(options.objective), options.seed));
  auto outcome = search(input->instance);
  if (!outcome) {
    report_error(outcome.error());
    return ExitCode::bad_input;
  }
  return deliver(*input, *std::move(outcome));
}

/// The options of a solve in continuous time. Errors are usage errors.
Result<RoadmapSolveRequest> settle_roadmap(const CLI::App& app, SolveArguments& arguments) {
  const auto refuse = [](std::string message) {
    return Error{ErrorCode::out_of_range, std::move(message), {}};
  };
  const InputOptions& input = arguments.request.input;
  for (const char* option : {"--check", "--cost-search", "--mdd-growth", "--forbid-first",
                             "--backtracking", "--no-first-plan", "--threads", "--race"})
    if (app.count(option) > 0) return refuse(std::string(option) + " does not apply to roadmaps");
  std::string wrong = check_roadmap_options(arguments.roadmap, input, Need::tasks);
  if (wrong.empty()) wrong = arguments.plan_format.why_not_continuous("--plan-format");
  if (!wrong.empty()) return refuse(wrong);
  if (arguments.plan_format.is_given() && arguments.plan.empty())
    return refuse("--plan-format needs --plan");
  wrong = check_files(arguments);
  if (!wrong.empty()) return refuse(wrong);
  const auto system = continuous::parse_system(to_string(arguments.system.value_or(System::dpll)));
  if (!system) return refuse("a roadmap needs --system dpll or smt-cbs");

  RoadmapSolveRequest request;
  request.roadmap = arguments.roadmap;
  request.input = input;
  const discrete::SolveOptions& options = arguments.request.options;
  request.options.objective = options.objective;
  request.options.system = *system;
  request.options.limits = options.limits;
  request.options.gap_percent = options.gap_percent;
  if (arguments.memory_mib)
    request.options.limits.memory_mib = static_cast<double>(*arguments.memory_mib);
  if (arguments.seed) request.options.seed = static_cast<std::uint32_t>(*arguments.seed);
  request.options.debug.audit = options.debug.audit;
  request.known_plan = arguments.request.known_plan;
  request.plan = arguments.plan;
  request.plan_format = arguments.plan_format.continuous.value_or(
      continuous::plan_format_of(arguments.plan).value_or(continuous::PlanFormat::json));
  request.json = arguments.json;
  request.quiet = arguments.quiet;
  return request;
}

ExitCode run(const CLI::App& app, SolveArguments& arguments) {
  arguments.request.options.limits.interrupt = &catch_interrupts();  // before anything is read
  if (is_roadmap(arguments.request.input, arguments.roadmap)) {
    auto request = settle_roadmap(app, arguments);
    return request ? solve_roadmap(std::move(request).value())
                   : usage_error(app, request.error().message);
  }
  std::string wrong = why_no_roadmap(arguments.roadmap);
  if (wrong.empty()) wrong = settle(arguments);
  return wrong.empty() ? SolveRun(arguments).run() : usage_error(app, wrong);
}

}  // namespace

Subcommand add_solve(CLI::App& program) {
  CLI::App* app = program.add_subcommand("solve", "Find a plan of least cost");
  const auto arguments = std::make_shared<SolveArguments>();
  add_input_options(*app, arguments->request.input);
  add_roadmap_options(*app, arguments->roadmap);
  add_search_options(*app, *arguments);
  add_limit_options(*app, *arguments);
  add_output_options(*app, *arguments);
  app->footer(std::string(kFooter) + kExitCodesHelp);
  return {app, [app, arguments] { return run(*app, *arguments); }};
}

}  // namespace quadrille::cli
