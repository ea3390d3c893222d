// SPDX-License-Identifier: MIT
#include "roadmap/solve_roadmap.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <sstream>
#include <utility>
#include <vector>

#include "asked/solving.hpp"
#include "frame/arguments.hpp"
#include "quadrille/continuous/free_cost.hpp"
#include "quadrille/continuous/plan_files.hpp"
#include "quadrille/continuous/quantise.hpp"
#include "quadrille/continuous/solver.hpp"
#include "quadrille/input/called.hpp"
#include "quadrille/poses/steps.hpp"
#include "roadmap/drawing.hpp"
#include "roadmap/opinion_report.hpp"
#include "roadmap/roadmap_report.hpp"
#include "roadmap/roadmap_text.hpp"

namespace quadrille::cli {
namespace {

using continuous::PlanFormat;
using continuous::SolveOptions;
using continuous::SolveOutcome;

/// What is wrong with the combination of options; empty if nothing is.
std::string check(const CLI::App& app, const SolveArguments& arguments) {
  for (const char* option : {"--check", "--cost-search", "--mdd-growth", "--forbid-first", "--tie",
                             "--backtracking", "--no-first-plan"})
    if (const CLI::Option* const given = app.get_option_no_throw(option);  // not of every command
        given != nullptr && given->count() > 0)
      return std::string(option) + " does not apply to roadmaps";
  std::string wrong = check_roadmap_options(arguments.roadmap, arguments.input, Need::tasks);
  if (wrong.empty()) wrong = arguments.plan_format.why_not_continuous("--plan-format");
  if (wrong.empty()) wrong = check_solve_outputs(arguments);
  if (wrong.empty() && arguments.options.race && arguments.threads.value_or(1) == 1)
    wrong = "--race needs --threads";
  if (wrong.empty() && arguments.options.explain && arguments.threads.value_or(1) > 1)
    wrong = "--explain needs one thread";
  if (wrong.empty() && !arguments.proof.empty() && arguments.roadmap.headings)
    wrong = "--proof does not know robots that turn yet";
  return wrong;
}

/// nullopt: there is no such system for roadmaps.
std::optional<SolveOptions> options_of(const SolveArguments& arguments) {
  const auto system =
      continuous::parse_system(to_string(arguments.system.value_or(discrete::System::dpll)));
  if (!system) return std::nullopt;
  SolveOptions options;
  static_cast<Choices&>(options) = arguments.options;
  options.system = *system;
  options.limits = arguments.options.limits;
  if (arguments.seed) options.seed = static_cast<std::uint32_t>(*arguments.seed);
  if (arguments.threads) options.threads = static_cast<std::size_t>(*arguments.threads);
  options.explain = arguments.options.explain;
  options.proof = !arguments.proof.empty();
  options.debug.audit = arguments.options.debug.audit;
  return options;
}

/// The parts of solve_and_deliver.
class RoadmapSolve {
 public:
  /// `used`: while it was read.
  RoadmapSolve(const SolveArguments& arguments, const SolveOptions& options,
               const input::RoadmapInput& input, const Usage& used)
      : arguments_(arguments), options_(options), input_(input), used_(used) {}

  [[nodiscard]] const continuous::Instance& instance() const { return input_.instance; }
  [[nodiscard]] Objective objective() const { return options_.objective; }

  [[nodiscard]] std::string describe_request() const {
    return describe_input(input_) + fmt::format("system     {}, objective {}, seed {}\n",
                                                to_string(options_.system),
                                                to_string(options_.objective), options_.seed);
  }
  [[nodiscard]] Result<SolveOutcome> solve(
      ProgressLine& line, const std::function<void(const continuous::Plan&)>& on_plan) const {
    SolveOptions options = options_;
    options.limits = limits_left(options.limits, used_);
    if (arguments_.plan_every) {
      options.on_plan = on_plan;
      options.plan_interval_s = *arguments_.plan_every;
    }
    if (line.active())
      options.on_progress = [&](const Progress& progress) {
        line.show(progress_text(progress, instance().resolution()));
      };
    if (arguments_.history) keep_history(options, notes_.history);
    const RemainingLimits left(options.limits);
    auto outcome = input_.poses ? poses::solve(*input_.poses, instance(), options)
                                : continuous::solve(instance(), options);
    if (outcome && outcome->plan && arguments_.check_with) ask_second_verifier(*outcome);
    if (outcome && arguments_.finds_reasons) trace_clauses(left, *outcome);
    if (outcome && outcome->attribution)
      notes_.reasons =
          find_reasons(*outcome->attribution, arguments_.finds_reasons ? recheck(left) : Recheck(),
                       kMaxRechecks);
    return outcome;
  }
  [[nodiscard]] Result<std::string> plan_text(const continuous::Plan& plan) const {
    std::ostringstream text;
    const PlanFormat format = arguments_.plan_format.continuous.value_or(
        continuous::plan_format_of(arguments_.plan).value_or(PlanFormat::json));
    if (auto error = write_plan(text, "", instance(), plan, format, input_.grid_or_null()))
      return *error;
    return text.str();
  }
  [[nodiscard]] std::string json(const SolveOutcome& outcome,
                                 const continuous::VerifyReport& replay) const {
    notes_.history.note(outcome.statistics.wall_s, outcome.statistics.cpu_s, outcome.lower_bound,
                        outcome.cost);
    return result_json(&instance(), arguments_, options_, outcome, replay, notes_);
  }
  [[nodiscard]] Called called() const { return input::called(input_.names); }
  [[nodiscard]] Result<std::string> page(const SolveOutcome& outcome) const {
    return page_of(input_, outcome.plan.value_or(continuous::Plan{}),
                   page_options(input_.source, input_.names, objective(), outcome));
  }
  [[nodiscard]] Result<std::string> drawing(const continuous::Plan& plan) const {
    return picture_of(input_, plan, arguments_.picture.options);
  }
  [[nodiscard]] std::optional<Result<std::string>> proof(const SolveOutcome& outcome) const {
    if (!outcome.certificate) return std::nullopt;
    return outcome.certificate->bytes;
  }
  [[nodiscard]] std::string describe(const SolveOutcome& outcome,
                                     const continuous::VerifyReport& replay) const {
    std::string text = describe_outcome(instance(), objective(), outcome, replay) + notes_.opinion;
    text += describe_proof(outcome, [&](Cost claim) {
      return fmt::format("{}", continuous::in_input_units(claim, instance().resolution()));
    });
    if (options_.proof) text += "           without the bounds of joint search and routes\n";
    if (outcome.attribution)
      text += describe_attribution(*outcome.attribution, notes_.reasons, names_of(instance()),
                                   kMaxSites);
    if (arguments_.finds_reasons && outcome.plan && instance().has_goal_sets())
      text += describe_farther_goals(farther_goals(*outcome.plan), names_of(instance()));
    return text;
  }
  /// Each goal takes a search of the roadmap: none are named where there are many.
  [[nodiscard]] std::vector<FartherGoal> farther_goals(const continuous::Plan& plan) const {
    constexpr std::size_t kMostGoals = 2000;
    std::size_t num_goals = 0;
    for (const continuous::Agent& agent : instance().agents()) num_goals += agent.goals.size();
    if (num_goals > kMostGoals) return {};
    const auto end = [&](AgentId i) { return plan.paths[i].back().vertex; };
    const auto cost_to = [&](AgentId i, VertexId goal) -> std::optional<Cost> {
      continuous::Agent one = instance().agent(i);
      one.goals = goal;
      const auto alone = instance().with_agents({one});
      const auto way = alone ? continuous::free_cost(*alone, AgentId(0)) : std::nullopt;
      return way ? std::optional<Cost>(continuous::as_cost(*way)) : std::nullopt;
    };
    return find_farther_goals(instance(), end, cost_to);
  }
  [[nodiscard]] std::string picture(const continuous::Plan& plan) const {
    return arguments_.finds_reasons ? "" : list_paths(instance(), plan);
  }

 private:
  /// A plan that it refuses becomes an internal error.
  void ask_second_verifier(SolveOutcome& outcome) const {
    const auto opinion = continuous::ask_fcl(instance(), *outcome.plan);
    notes_.second_opinion = opinion_json(instance(), opinion);
    notes_.opinion = describe_opinion(instance(), opinion);
    const std::string contradiction = find_contradiction(true, opinion);
    if (!contradiction.empty() && !outcome.internal_error)
      outcome.internal_error = Error{ErrorCode::internal, contradiction, {}};
  }

  /// Searches that know no clauses do not say where agents collide: another one may. Its raises are
  /// taken, too, if they prove as much.
  void trace_clauses(const RemainingLimits& left, SolveOutcome& outcome) const {
    if (!outcome.attribution || !outcome.attribution->sites.empty()) return;
    if (outcome.attribution->raises.empty()) return;
    const auto limits = left.next(kRecheckConflicts);
    if (!limits) return;
    SolveOptions options = options_;
    options.limits = *limits;
    options.route_work = options.joint_work = 0;
    const auto traced = continuous::solve(instance(), options);
    if (!traced || !traced->attribution || traced->internal_error) return;
    if (traced->lower_bound == outcome.lower_bound)
      outcome.attribution->raises = traced->attribution->raises;
    outcome.attribution->sites = traced->attribution->sites;
  }

  /// What some of the agents cost when they are alone with the obstacles. `left` outlives it.
  [[nodiscard]] Recheck recheck(const RemainingLimits& left) const {
    return [this, &left](const std::vector<AgentId>& agents) -> std::optional<Cost> {
      const auto limits = left.next(kRecheckConflicts);
      if (!limits) return std::nullopt;
      std::vector<continuous::Agent> kept;
      for (const AgentId i : agents) kept.push_back(instance().agent(i));
      const auto part = instance().with_agents(std::move(kept));
      SolveOptions options;
      options.objective = objective();
      options.seed = options_.seed;
      options.limits = *limits;
      const auto outcome = continuous::solve(part.value(), options);
      if (outcome->internal_error || outcome->status == Status::infeasible) return std::nullopt;
      return outcome->lower_bound;
    };
  }

  const SolveArguments& arguments_;
  const SolveOptions& options_;
  const input::RoadmapInput& input_;
  const Usage used_;
  mutable SearchNotes notes_;  // of the one solve
};

/// An outcome without an instance.
ExitCode deliver(const SolveArguments& arguments, const SolveOptions& options,
                 const SolveOutcome& outcome) {
  return deliver_without_search(
      arguments, outcome, [&] { return result_json(nullptr, arguments, options, outcome, {}, {}); },
      describe_refused(outcome));
}

/// Reads all that there is to read. Plans go into the options.
Result<input::RoadmapInput> read_input(const SolveArguments& arguments, SolveOptions& options) {
  auto input = load_roadmap_input(arguments.roadmap, arguments.input);
  if (!input) return input;
  const auto read = [&](const std::filesystem::path& path) {
    return continuous::read_plan(path, input->instance, input->grid_or_null());
  };
  if (auto error = check_picture_agents(arguments.picture, input->instance.num_agents()))
    return *std::move(error);
  if (auto error = read_given_plans(arguments, input->instance, options, read))
    return *std::move(error);
  return input;
}

}  // namespace

ExitCode solve_roadmap(const CLI::App& app, const SolveArguments& arguments, InputWatch& watch) {
  std::string wrong = check(app, arguments);
  auto options = options_of(arguments);
  if (wrong.empty() && !options) wrong = "a roadmap needs --system dpll or smt-cbs";
  if (!wrong.empty()) {
    watch.finish();
    return usage_error(app, wrong);
  }
  const auto input = read_input(arguments, *options);
  const Usage used = watch.finish();
  if (!input && input.error().code == ErrorCode::no_plan) {
    // It cannot have a plan, as can be seen without a search.
    SolveOutcome outcome;
    outcome.status = Status::infeasible;
    outcome.explanation = input.error().to_string();
    return deliver(arguments, *options, outcome);
  }
  if (!input) {
    report_error(input.error());
    return ExitCode::bad_input;
  }
  if (arguments.known_bound) {
    options->known_lower_bound =
        continuous::quantise_bound(*arguments.known_bound, input->instance.resolution());
    if (!options->known_lower_bound) return usage_error(app, "--known-bound is out of range");
  }
  if (!arguments.quiet) warn_of_durations(*input);
  // Neither of these searches makes clauses that could be checked against the plan.
  if (options->debug.known_plan) options->route_work = options->joint_work = 0;
  return solve_and_deliver(RoadmapSolve(arguments, *options, *input, used), arguments);
}

ExitCode end_roadmap_input(const SolveArguments& arguments, StopReason reason, const Usage& used) {
  const SolveOptions options = options_of(arguments).value_or(SolveOptions());
  return deliver(arguments, options, ended_before_search<SolveOutcome>(reason, used));
}

}  // namespace quadrille::cli
