// SPDX-License-Identifier: MIT
#include "roadmap/export_roadmap.hpp"

#include <filesystem>

#include "arguments.hpp"
#include "conversion.hpp"
#include "quadrille/continuous/plan_files.hpp"

namespace quadrille::cli {
namespace {

constexpr double kDefaultRate = 10, kMaxSamples = 1e7;

std::string check(const ExportArguments& arguments) {
  std::string wrong = check_roadmap_options(arguments.roadmap, arguments.input, Need::tasks);
  if (wrong.empty()) wrong = arguments.from.why_not_continuous("--from");
  if (wrong.empty() && arguments.rate && arguments.to == ExportFormat::vda5050)
    wrong = "--rate belongs to samples; orders have none";
  if (wrong.empty())
    wrong = check_outputs({{"--output", &arguments.output}},
                          {&arguments.input.instance, &arguments.roadmap.roadmap,
                           &arguments.roadmap.task, &arguments.plan});
  return wrong;
}

/// The text of the plan in its new format.
Result<std::string> convert(const ExportArguments& arguments, const RoadmapInput& input) {
  auto file = continuous::read_plan(std::filesystem::path(arguments.plan), input.instance,
                                    input.grid_or_null(), arguments.from.continuous);
  if (!file) return file.error();
  // Verifies the plan as well.
  const auto order = execution::precedences(input.instance, file->plan);
  if (!order) {
    Error error = order.error();
    error.where.file = arguments.plan;
    return error;
  }
  if (arguments.to == ExportFormat::vda5050)
    return export_orders(input.instance, file->plan, *order);
  const double rate = arguments.rate.value_or(kDefaultRate);
  double time = 0;
  for (const AgentId agent : input.instance.agent_ids())
    time += static_cast<double>(order->end(agent).count()) * input.instance.resolution().time;
  if (time * rate > kMaxSamples)
    return Error{
        ErrorCode::out_of_range, "more than 10 million samples; take a smaller --rate", {}};
  return export_samples(input.instance, file->plan, *arguments.to, rate);
}

}  // namespace

ExitCode export_roadmap(const CLI::App& app, const ExportArguments& arguments) {
  if (const std::string wrong = check(arguments); !wrong.empty()) return usage_error(app, wrong);
  return convert_and_write(
      arguments.output, [&] { return load_roadmap_input(arguments.roadmap, arguments.input); },
      [&](const auto& input) { return convert(arguments, input); });
}

}  // namespace quadrille::cli
