// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "answers/delivery.hpp"
#include "answers/outcome_check.hpp"
#include "answers/progress.hpp"
#include "answers/report.hpp"
#include "asked/shown_names.hpp"
#include "asked/solve_arguments.hpp"
#include "frame/input_watch.hpp"
#include "quadrille/core/in_names.hpp"
#include "quadrille/view/page.hpp"

namespace quadrille::cli {

/// A plan that is an input of `solve`, if there is one: `read` reads plan files for this instance.
/// Errors: those of the file, and that the plan is not a valid one.
template <class Plan, class Instance, class Read>
std::optional<Error> read_valid_plan(const std::string& name, const Instance& instance,
                                     std::optional<Plan>& plan, const Read& read) {
  if (name.empty()) return std::nullopt;
  auto file = read(std::filesystem::path(name));
  if (!file) return file.error();
  const auto replay = verify(instance, file->plan);
  if (!replay.valid())
    return Error{ErrorCode::invalid_plan,
                 "not a valid plan: " + replay.violations.front().message,
                 {name, 0}};
  plan = std::move(file.value().plan);
  return std::nullopt;
}

/// The plans of `--initial-plan` and `--known-plan`, into the options. Errors as above.
template <class Instance, class Options, class Read>
std::optional<Error> read_given_plans(const SolveArguments& arguments, const Instance& instance,
                                      Options& options, const Read& read) {
  if (auto error = read_valid_plan(arguments.initial_plan, instance, options.initial_plan, read))
    return error;
  return read_valid_plan(arguments.known_plan, instance, options.debug.known_plan, read);
}

/// What the page says of a solve; its title is the name of the file of the map.
template <class Outcome>
view::PageOptions page_options(const std::string& source, const text::Names& names,
                               Objective objective, const Outcome& outcome) {
  view::PageOptions options;
  options.title = std::filesystem::path(source).filename().string();
  options.objective = objective;
  options.agent_names = shown_names(names);
  options.status = outcome.status;
  options.lower_bound = outcome.lower_bound;
  options.attribution = outcome.attribution;
  if (outcome.status == Status::infeasible)
    options.obstruction =
        view::Obstruction{outcome.explanation, outcome.blocked, outcome.bottleneck};
  return options;
}

/// The answer where no search has begun: there is no instance, as it was refused, or not all of it
/// was read. `json`: text of the file of --json; `summary`: of the human output.
template <class Outcome, class MakeJson>
ExitCode deliver_without_search(const SolveArguments& arguments, const Outcome& outcome,
                                const MakeJson& json, const std::string& summary) {
  Delivery delivery(arguments.quiet, arguments.plan, arguments.json, arguments.view,
                    arguments.picture.file, arguments.proof);
  if (!delivery.probe()) return ExitCode::output;
  delivery.write_plan(std::nullopt);
  delivery.write_view(std::nullopt);
  delivery.write_svg(std::nullopt);
  delivery.write_proof(std::nullopt);
  if (delivery.has_json_file()) delivery.write_json(json());
  delivery.print_summary(summary, "");
  return delivery.finish(exit_code_of(outcome));
}

/// What is known when a signal or a limit comes before the search begins.
template <class Outcome>
Outcome ended_before_search(StopReason reason, const Usage& used) {
  Outcome outcome;
  outcome.stop = reason;
  outcome.explanation =
      "stopped while the input was read and checked: " + std::string(to_string(reason));
  outcome.statistics.cpu_s = used.cpu_s;
  outcome.statistics.wall_s = used.wall_s;
  outcome.statistics.peak_rss_mib = peak_rss_mib();
  return outcome;
}

/// From an instance to the exit code: solves, holds the outcome against a replay of its plan,
/// writes and prints. `Domain` supplies what differs:
///
///     instance(), objective()
///     describe_request()                 the first lines of the human output
///     solve(ProgressLine&, on_plan)      Result<Outcome>; on_plan(plan) hears of better plans
///     plan_text(plan)                    Result<std::string>, the file of --plan
///     json(outcome, replay)              the file of --json
///     page(outcome), drawing(plan)       the files of --view and --svg
///     proof(outcome)                     the file of --proof, where there are certificates
///     called()                           what agents and vertices are called in messages
///     describe(outcome, replay)          the last lines of the human output
///     picture(plan)                      the plan for the eye
template <class Domain>
ExitCode solve_and_deliver(const Domain& domain, const SolveArguments& arguments) {
  Delivery delivery(arguments.quiet, arguments.plan, arguments.json, arguments.view,
                    arguments.picture.file, arguments.proof);
  if (!delivery.probe()) return ExitCode::output;
  delivery.console().print(domain.describe_request());
  auto answer = [&] {
    ProgressLine line(!arguments.quiet);
    const auto write_plan = [&](const auto& plan) {
      // Nothing is given out that does not stand a replay.
      if (verify(domain.instance(), plan).valid())
        delivery.write_interim_plan(domain.plan_text(plan));
    };
    return domain.solve(line, write_plan);
  }();
  if (!answer) {
    report_error(answer.error());
    return ExitCode::bad_input;
  }
  auto outcome = *std::move(answer);
  const auto replay = check_outcome(domain.instance(), domain.objective(), outcome);
  outcome.explanation = in_names(outcome.explanation, domain.called());
  if (outcome.internal_error) {
    report_error({ErrorCode::internal, "internal check failed: " + outcome.internal_error->message,
                  outcome.internal_error->where});
    print_stderr(describe_violations(replay));
  }
  std::optional<Result<std::string>> plan;
  if (outcome.plan && delivery.has_plan_file()) plan = domain.plan_text(*outcome.plan);
  delivery.write_plan(plan);
  if (delivery.has_json_file()) delivery.write_json(domain.json(outcome, replay));
  if (delivery.has_view_file())
    delivery.write_view(outcome.plan || outcome.status == Status::infeasible
                            ? std::optional(domain.page(outcome))
                            : std::nullopt);
  if (delivery.has_svg_file())
    delivery.write_svg(outcome.plan ? std::optional(domain.drawing(*outcome.plan)) : std::nullopt);
  if constexpr (requires { domain.proof(outcome); })
    if (delivery.has_proof_file()) delivery.write_proof(domain.proof(outcome));
  const bool draw = outcome.plan && !delivery.has_plan_file();
  delivery.print_summary(domain.describe(outcome, replay),
                         draw ? domain.picture(*outcome.plan) : "");
  return delivery.finish(exit_code_of(outcome));
}

}  // namespace quadrille::cli
