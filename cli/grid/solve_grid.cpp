// SPDX-License-Identifier: MIT
#include "grid/solve_grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <optional>
#include <sstream>
#include <utility>
#include <vector>

#include "asked/solving.hpp"
#include "frame/arguments.hpp"
#include "grid/grid_report.hpp"
#include "grid/grid_text.hpp"
#include "grid/picture.hpp"
#include "grid/reason_map.hpp"
#include "quadrille/discrete/feasibility.hpp"
#include "quadrille/discrete/goal_distances.hpp"
#include "quadrille/discrete/verify.hpp"
#include "quadrille/input/called.hpp"
#include "quadrille/input/grid.hpp"
#include "quadrille/view/page.hpp"
#include "quadrille/view/picture.hpp"

namespace quadrille::cli {
namespace {

using discrete::PlanFormat;
using discrete::SolveOutcome;
using discrete::System;

/// What is wrong with the combination of options; empty if nothing is. Settles the options.
std::string settle(SolveArguments& arguments) {
  std::string wrong = why_no_roadmap(arguments.roadmap);
  if (wrong.empty()) wrong = check_grid_options(arguments.input, Need::tasks);
  if (wrong.empty()) wrong = check_solve_outputs(arguments);
  if (wrong.empty()) wrong = arguments.plan_format.why_not_discrete("--plan-format");
  if (!wrong.empty()) return wrong;

  discrete::SolveOptions& options = arguments.options;
  options.system = arguments.system.value_or(System::dpll);
  if (arguments.check) {
    // Schedules are a matter of the MDD path model: DPLL(MAPF) as published.
    if (options.system == System::dpll) options.system = System::dpll_mdd;
    if (!has_schedule(options.system)) return "--check belongs to --system dpll-mdd";
    options.mdd.check = *arguments.check;
  }
  if (arguments.threads) options.threads = static_cast<std::size_t>(*arguments.threads);
  if (options.race && options.threads == 1) return "--race needs --threads";
  options.proof = !arguments.proof.empty();
  if (options.tie != discrete::Tie::any && options.gap_percent)
    return "--tie fewest-moves is about plans of least cost, and does not go with --gap";
  if (options.explain && options.threads > 1) return "--explain needs one thread";
  if (options.explain && options.system != System::dpll) return "--explain needs --system dpll";
  if (arguments.known_bound) {
    const auto bound = static_cast<Cost>(std::min(*arguments.known_bound, 0x1p62));
    if (static_cast<double>(bound) != *arguments.known_bound)
      return "--known-bound is a whole number of timesteps";
    options.known_lower_bound = bound;
  }
  if (arguments.seed) options.seed = static_cast<std::uint32_t>(*arguments.seed);
  if (!arguments.plan_format.discrete)
    arguments.plan_format.discrete =
        discrete::plan_format_of(arguments.plan).value_or(PlanFormat::json);
  return "";
}

/// For what takes a plan where there is none.
discrete::Plan no_paths(const discrete::Instance& instance) { return {{}, instance.now()}; }

/// The parts of solve_and_deliver.
class GridSolve {
 public:
  /// `used`: while it was read.
  GridSolve(const SolveArguments& arguments, const input::GridInput& input, const Usage& used)
      : arguments_(arguments), input_(input), used_(used) {}

  [[nodiscard]] const discrete::Instance& instance() const { return input_.instance; }
  [[nodiscard]] Objective objective() const { return arguments_.options.objective; }

  [[nodiscard]] std::string describe_request() const {
    const discrete::SolveOptions& options = arguments_.options;
    const std::string check =
        has_schedule(options.system) ? " with check " + to_string(options.mdd.check) : "";
    return describe_input(input_) + fmt::format("system     {}{}, objective {}, seed {}\n",
                                                to_string(options.system), check,
                                                to_string(options.objective), options.seed);
  }
  [[nodiscard]] Result<SolveOutcome> solve(
      ProgressLine& line, const std::function<void(const discrete::Plan&)>& on_plan) const {
    discrete::SolveOptions options = arguments_.options;
    options.limits = limits_left(options.limits, used_);
    if (arguments_.plan_every) {
      options.on_plan = on_plan;
      options.plan_interval_s = *arguments_.plan_every;
    }
    if (line.active())
      options.on_progress = [&line](const auto& progress) { line.show(progress_text(progress)); };
    if (arguments_.history) keep_history(options, notes_.history);
    const RemainingLimits left(options.limits);
    auto outcome = discrete::solve(instance(), options);
    if (outcome && outcome->attribution)
      notes_.reasons =
          find_reasons(*outcome->attribution, arguments_.finds_reasons ? recheck(left) : Recheck(),
                       kMaxRechecks);
    return outcome;
  }
  [[nodiscard]] Result<std::string> plan_text(const discrete::Plan& plan) const {
    std::ostringstream text;
    const PlanFormat format = *arguments_.plan_format.discrete;
    if (auto error = write_plan(text, "", instance().graph(), plan, format)) return *error;
    return text.str();
  }
  [[nodiscard]] std::string json(const SolveOutcome& outcome, const discrete::VerifyReport&) const {
    notes_.history.note(outcome.statistics.wall_s, outcome.statistics.cpu_s, outcome.lower_bound,
                        outcome.cost);
    return result_json(&instance(), arguments_, outcome, notes_);
  }
  [[nodiscard]] Called called() const { return input::called(input_.names); }
  [[nodiscard]] Result<std::string> page(const SolveOutcome& outcome) const {
    return view::page(instance(), outcome.plan.value_or(no_paths(instance())),
                      page_options(input_.source, input_.names, objective(), outcome));
  }
  [[nodiscard]] Result<std::string> drawing(const discrete::Plan& plan) const {
    return view::picture(instance(), plan, arguments_.picture.options);
  }
  [[nodiscard]] std::optional<Result<std::string>> proof(const SolveOutcome& outcome) const {
    if (!outcome.certificate) return std::nullopt;
    return outcome.certificate->bytes;
  }
  [[nodiscard]] std::string describe(const SolveOutcome& outcome,
                                     const discrete::VerifyReport& replay) const {
    std::string text = describe_outcome(objective(), outcome, replay);
    text += describe_proof(outcome, [](Cost claim) { return std::to_string(claim); });
    if (outcome.attribution)
      text += describe_attribution(*outcome.attribution, notes_.reasons, names_of(instance()),
                                   kMaxSites);
    if (!arguments_.finds_reasons) return text;
    if (outcome.plan && instance().has_goal_sets() && instance().is_plain())
      text += describe_farther_goals(farther_goals(*outcome.plan), names_of(instance()));
    if (outcome.attribution)
      text += draw_reasons(instance(), *outcome.attribution, notes_.reasons, kMaxSites);
    if (outcome.status == Status::infeasible)
      text += draw_obstruction(instance(), check_feasibility(instance()));
    return text;
  }
  [[nodiscard]] std::vector<FartherGoal> farther_goals(const discrete::Plan& plan) const {
    const auto end = [&](AgentId i) { return plan.paths[i].back(); };
    // Without rules all edges lead both ways.
    std::optional<VertexId> start;
    IdVector<VertexId, Timestep> ways;
    const auto cost_to = [&](AgentId i, VertexId goal) -> std::optional<Cost> {
      if (start != instance().agents()[i].start) {
        start = instance().agents()[i].start;
        ways = discrete::distances_to_nearest(instance().graph(), Goals(*start));
      }
      const Timestep way = ways[goal];
      return way == discrete::kUnreachable ? std::nullopt : std::optional<Cost>(way);
    };
    return find_farther_goals(instance(), end, cost_to);
  }
  [[nodiscard]] std::string picture(const discrete::Plan& plan) const {
    return arguments_.finds_reasons ? "" : draw_plan(instance(), plan);
  }

 private:
  /// What some of the agents cost when they are alone. `left` outlives it.
  [[nodiscard]] Recheck recheck(const RemainingLimits& left) const {
    return [this, &left](const std::vector<AgentId>& agents) -> std::optional<Cost> {
      const auto limits = left.next(kRecheckConflicts);
      if (!limits) return std::nullopt;
      std::vector<discrete::Agent> kept;
      for (const AgentId i : agents) kept.push_back(instance().agents()[i]);
      const auto part = instance().with_agents(std::move(kept));
      discrete::SolveOptions options;
      options.objective = objective();
      options.seed = arguments_.options.seed;
      options.limits = *limits;
      const auto outcome = discrete::solve(part.value(), options);
      if (outcome->internal_error || outcome->status == Status::infeasible) return std::nullopt;
      return outcome->lower_bound;
    };
  }

  const SolveArguments& arguments_;
  const input::GridInput& input_;
  const Usage used_;
  mutable SearchNotes notes_;  // of the one solve
};

/// Reads all that there is to read. Plans go into the options.
Result<input::GridInput> read_input(SolveArguments& arguments) {
  auto input = load_grid_input(arguments.input);
  if (!input) return input;
  const auto read = [&](const std::filesystem::path& path) {
    return discrete::read_plan(path, input->instance);
  };
  auto error = read_given_plans(arguments, input->instance, arguments.options, read);
  if (!error) error = check_picture_agents(arguments.picture, input->instance.num_agents());
  if (!error && !arguments.plan.empty()) {
    // Some formats need a grid, or a plan that begins at 0; that must not come out after the
    // search.
    const auto text = GridSolve(arguments, *input, {}).plan_text(no_paths(input->instance));
    if (!text) error = text.error();
  }
  if (error) return *std::move(error);
  return input;
}

}  // namespace

ExitCode solve_grid(const CLI::App& app, SolveArguments& arguments, InputWatch& watch) {
  if (const std::string wrong = settle(arguments); !wrong.empty()) {
    watch.finish();
    return usage_error(app, wrong);
  }
  const auto input = read_input(arguments);
  const Usage used = watch.finish();
  if (!input) {
    report_error(input.error());
    return ExitCode::bad_input;
  }
  // Not bad input: another system takes it, or other options do.
  if (input->instance.has_goal_sets() && arguments.options.proof)
    return usage_error(app, "some agents have several goals, which --proof does not know yet");
  const auto& agents = input->instance.agents();
  const bool has_waypoints = std::any_of(
      agents.begin(), agents.end(), [](const auto& agent) { return !agent.waypoints.empty(); });
  if (has_waypoints && arguments.options.system != System::dpll)
    return usage_error(app, "some agents have waypoints, which needs --system dpll");
  if (arguments.options.tie != discrete::Tie::any &&
      (has_waypoints || input->instance.has_goal_sets()))
    return usage_error(app,
                       "some agents have waypoints or several goals, which --tie does not know");
  if (!input->instance.is_plain() && (arguments.options.proof || arguments.options.explain))
    return usage_error(app,
                       "--proof and --explain know no rules: one-way edges, agents that leave, "
                       "releases, deadlines, "
                       "waypoints, blockages and robust plans");
  return solve_and_deliver(GridSolve(arguments, *input, used), arguments);
}

ExitCode end_grid_input(SolveArguments arguments, StopReason reason, const Usage& used) {
  static_cast<void>(settle(arguments));  // what is wrong with it will never be known
  const auto outcome = ended_before_search<SolveOutcome>(reason, used);
  return deliver_without_search(
      arguments, outcome, [&] { return result_json(nullptr, arguments, outcome, {}); },
      describe_outcome(arguments.options.objective, outcome, {}));
}

}  // namespace quadrille::cli
