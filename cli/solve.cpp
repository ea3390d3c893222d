// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <cerrno>
#include <filesystem>
#include <memory>
#include <new>
#include <sstream>
#include <utility>
#include <vector>

#include "input.hpp"
#include "outcome_check.hpp"
#include "output.hpp"
#include "picture.hpp"
#include "progress.hpp"
#include "report.hpp"
#include "signals.hpp"
#include "solve_roadmap.hpp"
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
  std::optional<PlanFormat> plan_format;
  bool quiet = false;
};

std::optional<Objective> parse_objective(std::string_view text) {
  for (const Objective objective : {Objective::sum_of_costs, Objective::makespan})
    if (text == to_string(objective)) return objective;
  return std::nullopt;
}

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
  add_choice<discrete::MddGrowth>(app, "--mdd-growth", options.mdd_growth, "on-demand or full",
                                  discrete::parse_mdd_growth,
                                  "How far the MDDs reach at first: on-demand (default) or full")
      ->group(group);
  app.add_flag("--forbid-first", options.forbid_first,
               "dpll: try first to forbid usages; faster on some hard instances, slower on others")
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
  add_seconds(app, "--cpu-limit", limits.cpu_s, "Stop after this CPU time")->group(group);
  add_integer(app, "--memory-limit", arguments.memory_mib, 1, std::int64_t{1} << 40,
              "Stop when the process is larger than this many MiB")
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
                  "json, cbsh2, visualizer or yaml; default: by the name of the file, else json")
      ->group(group);
  add_file(app, "--json", arguments.json, "Write the result as JSON; - is standard output")
      ->group(group);
  app.add_flag("--quiet", arguments.quiet, "Print nothing but errors and what is asked for")
      ->group(group);
  app.add_flag("--audit", arguments.request.options.audit,
               "Check every lemma against the rules; slow")
      ->group("Debugging");
  add_file(app, "--known-plan", arguments.request.known_plan,
           "Check every clause against this valid plan; slow")
      ->group("Debugging");
}

/// Whether both name one regular file, or would if they existed.
bool same_file(const std::string& a, const std::string& b) {
  if (a.empty() || b.empty()) return false;
  if (a == "-" || b == "-") return a == b;
  std::error_code ignored;
  const auto where = std::filesystem::weakly_canonical(a, ignored);
  if (std::filesystem::exists(where, ignored) && !std::filesystem::is_regular_file(where, ignored))
    return false;
  return std::filesystem::equivalent(a, b, ignored) ||
         where == std::filesystem::weakly_canonical(b, ignored);
}

/// What is wrong with the combination of options; empty if nothing is. Settles the system.
std::string settle(SolveArguments& arguments) {
  const InputOptions& input = arguments.request.input;
  std::string wrong = check_input_options(input, Need::tasks);
  if (!wrong.empty()) return wrong;
  if (same_file(arguments.plan, arguments.json)) return "--plan and --json name the same output";
  const std::vector<const std::string*> inputs = {&input.map, &input.scen, &input.instance,
                                                  &arguments.request.known_plan};
  for (const std::string* output : {&arguments.plan, &arguments.json})
    for (const std::string* in : inputs)
      if (*output != "-" && same_file(*output, *in)) return *output + " is an input of this run";
  if (arguments.plan_format && arguments.plan.empty()) return "--plan-format needs --plan";

  discrete::SolveOptions& options = arguments.request.options;
  options.system = arguments.system.value_or(System::dpll);
  if (arguments.check) {
    // Schedules are a matter of the MDD path model: DPLL(MAPF) as published.
    if (options.system == System::dpll) options.system = System::dpll_mdd;
    if (!has_schedule(options.system)) return "--check belongs to --system dpll-mdd";
    options.check = *arguments.check;
  }
  if (arguments.threads) options.threads = static_cast<std::size_t>(*arguments.threads);
  if (options.race && options.threads == 1) return "--race needs --threads";
  if (arguments.seed) options.seed = static_cast<std::uint32_t>(*arguments.seed);
  if (arguments.memory_mib) options.limits.memory_mib = static_cast<double>(*arguments.memory_mib);
  if (!arguments.plan_format)
    arguments.plan_format = discrete::plan_format_of(arguments.plan).value_or(PlanFormat::json);
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
      : arguments_(arguments),
        console_(arguments.quiet, arguments.json == "-" || arguments.plan == "-") {}

  ExitCode run();

 private:
  bool probe(const std::string& path, std::optional<OutputFile>& file);
  std::optional<Error> read_known_plan(const discrete::Instance& instance);
  SolveOutcome search(const discrete::Instance& instance);
  ExitCode deliver(const Input& input, SolveOutcome outcome);
  void write(const OutputFile& file, const std::string& text);

  SolveArguments& arguments_;
  Console console_;
  std::optional<OutputFile> plan_file_, json_file_;
  bool delivered_ = false;  // a file with the result has been written
  bool output_failed_ = false;
  std::string unwritten_;  // the text of an output that failed
};

bool SolveRun::probe(const std::string& path, std::optional<OutputFile>& file) {
  if (path.empty()) return true;
  auto probed = OutputFile::probe(path);
  if (probed)
    file = std::move(probed.value());
  else
    report_error(probed.error());
  return probed.has_value();
}

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
  request.options.known_plan = file->plan;
  return std::nullopt;
}

SolveOutcome SolveRun::search(const discrete::Instance& instance) {
  ProgressLine line(!arguments_.quiet);
  discrete::SolveOptions options = arguments_.request.options;
  if (line.active()) options.on_progress = [&line](const auto& progress) { line.show(progress); };
  try {
    return solve(instance, options);
  } catch (const std::bad_alloc&) {
    SolveOutcome outcome;
    outcome.stop = StopReason::memory;
    outcome.explanation = "the system has no more memory";
    return outcome;
  }
}

void SolveRun::write(const OutputFile& file, const std::string& text) {
  const int code = file.write(text);
  if (code == 0) {
    delivered_ = true;
    return;
  }
  report_write_failure(file.path(), code);
  output_failed_ = true;
  // A reader that has left does not want the rest.
  if (code != EPIPE) unwritten_ = text;
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
  if (plan_file_ && outcome.plan) {
    auto text = plan_text(instance.graph(), *outcome.plan, *arguments_.plan_format);
    if (text) {
      write(*plan_file_, *text);
    } else {
      report_error(text.error());
      output_failed_ = true;
    }
  } else if (plan_file_) {
    console_.print(fmt::format("plan       none; {} is not written\n", plan_file_->path()));
  }
  if (json_file_) write(*json_file_, result_json(instance, request, outcome));

  const auto* check = outcome.plan ? &replay : nullptr;
  const std::string summary = describe_outcome(request, outcome, check);
  console_.print(summary);
  if (outcome.plan && arguments_.plan.empty()) console_.print(draw_plan(instance, *outcome.plan));
  if (console_.failure() != 0) {
    report_write_failure("-", console_.failure());
    output_failed_ = true;
    if (console_.failure() != EPIPE) unwritten_ = summary + unwritten_;
  }
  // A result that went nowhere would have to be computed again.
  if (!delivered_) print_stderr(unwritten_);
  const ExitCode code = exit_code(outcome);
  return output_failed_ && code != ExitCode::internal ? ExitCode::output : code;
}

ExitCode SolveRun::run() {
  SolveRequest& request = arguments_.request;
  request.options.limits.interrupt = &catch_interrupts();

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
    const auto text = plan_text(input->instance.graph(), {}, *arguments_.plan_format);
    if (!text) {
      report_error(text.error());
      return ExitCode::bad_input;
    }
  }
  if (!probe(arguments_.plan, plan_file_) || !probe(arguments_.json, json_file_))
    return ExitCode::output;

  const discrete::SolveOptions& options = request.options;
  console_.print(describe_input(*input));
  console_.print(
      fmt::format("system     {}{}, objective {}, seed {}\n", to_string(options.system),
                  has_schedule(options.system) ? " with check " + to_string(options.check) : "",
                  to_string(options.objective), options.seed));
  return deliver(*input, search(input->instance));
}

/// What is wrong with the options of a solve in continuous time; empty if nothing is.
std::string settle_roadmap(const SolveArguments& arguments, RoadmapSolveRequest& request) {
  const InputOptions& other = arguments.request.input;
  if (!other.map.empty() || !other.scen.empty() || !other.instance.empty())
    return "--roadmap goes with --task, not with --map, --scen or --instance";
  if (arguments.check || arguments.plan_format || arguments.request.options.cost_search ||
      !arguments.request.known_plan.empty() || arguments.request.options.audit)
    return "--check, --cost-search, --plan-format, --known-plan and --audit are not for --roadmap";
  if (same_file(arguments.plan, arguments.json)) return "--plan and --json name the same output";
  for (const std::string* output : {&arguments.plan, &arguments.json})
    for (const std::string* in : {&arguments.roadmap.roadmap, &arguments.roadmap.task})
      if (*output != "-" && same_file(*output, *in)) return *output + " is an input of this run";
  const System system = arguments.system.value_or(System::dpll);
  const auto known = continuous::parse_system(to_string(system));
  if (!known) return "--roadmap needs --system dpll or smt-cbs";
  request.input = arguments.roadmap;
  request.agents = other.agents;
  const discrete::SolveOptions& options = arguments.request.options;
  request.options.objective = options.objective;
  request.options.system = *known;
  request.options.limits = options.limits;
  if (arguments.memory_mib)
    request.options.limits.memory_mib = static_cast<double>(*arguments.memory_mib);
  if (arguments.seed) request.options.seed = static_cast<std::uint32_t>(*arguments.seed);
  request.plan = arguments.plan;
  request.json = arguments.json;
  request.quiet = arguments.quiet;
  return check_roadmap_options(request.input, request.agents);
}

ExitCode run(const CLI::App& app, SolveArguments& arguments) {
  if (!arguments.roadmap.roadmap.empty()) {
    RoadmapSolveRequest request;
    const std::string wrong = settle_roadmap(arguments, request);
    return wrong.empty() ? solve_roadmap(std::move(request)) : usage_error(app, wrong);
  }
  const RoadmapOptions& unused = arguments.roadmap;
  if (!unused.task.empty() || unused.radius || unused.speed || unused.resolution ||
      unused.neighbourhood)
    return usage_error(app,
                       "--task, --radius, --speed, --neighbourhood and --resolution belong to "
                       "--roadmap");
  const std::string wrong = settle(arguments);
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
