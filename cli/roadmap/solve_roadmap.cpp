// SPDX-License-Identifier: MIT
#include "roadmap/solve_roadmap.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <sstream>
#include <utility>

#include "delivery.hpp"
#include "grid/report.hpp"
#include "outcome_check.hpp"
#include "progress.hpp"

namespace quadrille::cli {
namespace {

using continuous::Instance;
using continuous::SolveOutcome;

std::optional<Error> read_known_plan(const RoadmapInput& input, RoadmapSolveRequest& request) {
  if (request.known_plan.empty()) return std::nullopt;
  const std::filesystem::path path(request.known_plan);
  auto file = continuous::read_plan(path, input.instance, input.grid_or_null());
  if (!file) return file.error();
  const auto replay = verify(input.instance, file->plan);
  if (!replay.valid())
    return Error{ErrorCode::invalid_plan,
                 "not a valid plan: " + replay.violations.front().message,
                 {request.known_plan, 0}};
  request.options.debug.known_plan = std::move(file.value().plan);
  // Neither of these searches makes clauses that could be checked.
  request.options.route_work = request.options.joint_work = 0;
  return std::nullopt;
}

Result<SolveOutcome> search(const Instance& instance, const RoadmapSolveRequest& request) {
  ProgressLine line(!request.quiet);
  continuous::SolveOptions options = request.options;
  if (line.active())
    options.on_progress = [&](const continuous::Progress& progress) {
      line.show(progress_text(progress, instance.resolution()));
    };
  return solve(instance, options);
}

Result<std::string> plan_text(const RoadmapInput& input, const continuous::Plan& plan,
                              continuous::PlanFormat format) {
  std::ostringstream text;
  if (auto error = write_plan(text, "", input.instance, plan, format, input.grid_or_null()))
    return *error;
  return text.str();
}

/// What cannot have a plan, as can be seen without a search.
ExitCode report_refused(const Error& error, const RoadmapSolveRequest& request) {
  SolveOutcome outcome;
  outcome.status = Status::infeasible;
  outcome.explanation = error.to_string();
  Delivery delivery(request.quiet, request.plan, request.json);
  if (!delivery.probe()) return ExitCode::output;
  delivery.write_plan(std::nullopt);
  if (delivery.has_json_file()) delivery.write_json(result_json(nullptr, request, outcome, {}));
  delivery.print_summary(describe_refused(outcome), "");
  return delivery.finish(exit_code(outcome));
}

}  // namespace

ExitCode solve_roadmap(RoadmapSolveRequest request) {
  const auto input = load_roadmap_input(request.roadmap, request.input);
  if (!input) {
    if (input.error().code == ErrorCode::no_plan) return report_refused(input.error(), request);
    report_error(input.error());
    return ExitCode::bad_input;
  }
  if (auto error = read_known_plan(*input, request)) {
    report_error(*error);
    return ExitCode::bad_input;
  }
  Delivery delivery(request.quiet, request.plan, request.json);
  if (!delivery.probe()) return ExitCode::output;
  delivery.console().print(describe_input(*input));
  delivery.console().print(fmt::format("system     {}, objective {}, seed {}\n",
                                       to_string(request.options.system),
                                       to_string(request.options.objective), request.options.seed));
  const Instance& instance = input->instance;
  auto answer = search(instance, request);
  if (!answer) {
    report_error(answer.error());
    return ExitCode::bad_input;
  }
  SolveOutcome outcome = *std::move(answer);
  const auto replay = check_outcome(instance, request.options.objective, outcome);
  if (outcome.internal_error) {
    report_error({ErrorCode::internal, "internal check failed: " + outcome.internal_error->message,
                  outcome.internal_error->where});
    print_stderr(describe_violations(replay));
  }
  std::optional<Result<std::string>> plan;
  if (outcome.plan && delivery.has_plan_file())
    plan = plan_text(*input, *outcome.plan, request.plan_format);
  delivery.write_plan(plan);
  if (delivery.has_json_file())
    delivery.write_json(result_json(&instance, request, outcome, replay));
  const bool list = outcome.plan && request.plan.empty();
  delivery.print_summary(describe_outcome(instance, request, outcome, replay),
                         list ? list_paths(instance, *outcome.plan) : "");
  return delivery.finish(exit_code(outcome));
}

}  // namespace quadrille::cli
