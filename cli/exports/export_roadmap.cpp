// SPDX-License-Identifier: MIT
#include "exports/export_roadmap.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "asked/conversion.hpp"
#include "exports/planviz.hpp"
#include "exports/releasing.hpp"
#include "frame/arguments.hpp"
#include "quadrille/continuous/plan_files.hpp"
#include "quadrille/continuous/quantise.hpp"
#include "quadrille/continuous/verify.hpp"
#include "roadmap/roadmap_text.hpp"

namespace quadrille::cli {
namespace {

constexpr double kMaxSamples = 1e7;

/// The options that belong to some formats only.
std::string check_formats(const ExportArguments& arguments) {
  const ExportFormat to = *arguments.to;
  const bool is_ros = to == ExportFormat::multidof || to == ExportFormat::path;
  const bool is_vda = to == ExportFormat::vda5050;
  if (arguments.rate && is_vda) return "--rate belongs to samples; orders have none";
  if (arguments.rate && to == ExportFormat::planviz)
    return "--rate belongs to samples; planviz has one action per timestep";
  if (arguments.ros && !is_ros) return "--ros belongs to multidof and path";
  if (!arguments.names.empty() && !is_vda && to != ExportFormat::multidof)
    return "--names belongs to vda5050 and multidof; the others have no names";
  if (is_vda) return "";
  if (arguments.vda_version) return "--vda-version belongs to --to vda5050";
  if (!arguments.order_id.empty()) return "--order-id belongs to --to vda5050";
  if (!arguments.time_stamp.empty()) return "--time-stamp belongs to --to vda5050";
  if (!arguments.states.empty()) return "--states belongs to --to vda5050";
  if (arguments.allow_cycles)
    return "--allow-cycles belongs to --to vda5050; samples have times, and nobody waits";
  return "";
}

std::string check(const ExportArguments& arguments) {
  std::string wrong = check_roadmap_options(arguments.roadmap, arguments.input, Need::tasks);
  if (wrong.empty()) wrong = arguments.from.why_not_continuous("--from");
  if (wrong.empty()) wrong = check_formats(arguments);
  if (wrong.empty() && !arguments.states.empty() && arguments.output != "-")
    wrong = "with --states orders go to standard output, as robots go";
  if (wrong.empty())
    wrong = check_outputs({{"--output", &arguments.output}},
                          {&arguments.input.map, &arguments.input.scen, &arguments.input.instance,
                           &arguments.roadmap.roadmap, &arguments.roadmap.task, &arguments.plan,
                           &arguments.states, &arguments.names});
  return wrong;
}

const continuous::PoseGrid* poses_or_null(const input::RoadmapInput& input) {
  return input.poses ? &*input.poses : nullptr;
}

/// What agents and vertices are called: as the file of --names says, else as the instance does.
Result<Naming> naming(const ExportArguments& arguments, const input::RoadmapInput& input) {
  Naming own;
  own.names = input.names;
  own.source = input.task_source;
  if (arguments.names.empty()) return own;
  return read_naming(arguments.names, std::move(own), input.instance.num_agents(),
                     input.instance.roadmap().num_vertices());
}

struct Checked {
  continuous::Plan plan;
  execution::Precedences order;
};

Result<Checked> read_checked(const ExportArguments& arguments, const input::RoadmapInput& input) {
  if (arguments.to == ExportFormat::vda5050 && !input.instance.roadmap().is_flat())
    return Error{ErrorCode::invalid_instance,
                 "orders of VDA 5050 have no heights, and the roadmap has",
                 {input.source, 0}};
  auto file = continuous::read_plan(std::filesystem::path(arguments.plan), input.instance,
                                    input.grid_or_null(), arguments.from.continuous);
  if (!file) return file.error();
  if (arguments.to != ExportFormat::vda5050) {
    // Samples have times: nobody waits for anybody, nor for obstacles.
    const auto report = verify(input.instance, file->plan);
    if (!report.valid())
      return Error{ErrorCode::invalid_plan, report.violations.front().message, {arguments.plan, 0}};
    return Checked{std::move(file->plan), {}};
  }
  // Verifies the plan as well.
  const auto order = execution::precedences(input.instance, file->plan);
  if (!order) {
    Error error = order.error();
    error.where.file = arguments.plan;
    return error;
  }
  return Checked{std::move(file->plan), *order};
}

/// Says it on stderr if robots that have to wait for each other's moves to end would do so for
/// ever. Whether the orders may be given all the same.
bool may_lock_up(const ExportArguments& arguments, const execution::Precedences& order,
                 const OrderNames& names) {
  const auto lines = describe_lock_up(order, names);
  if (lines.empty()) return true;
  const Error what{ErrorCode::invalid_plan, "with these orders robots wait for ever", {}};
  Error located = what;
  located.where.file = arguments.plan;
  if (arguments.allow_cycles)
    report_warning(located);
  else
    report_error(located);
  for (const std::string& line : lines) print_stderr("  " + line + "\n");
  if (!arguments.allow_cycles)
    print_stderr(
        "  nothing is written; plan with larger bodies or shorter edges, or use --allow-cycles\n");
  return arguments.allow_cycles;
}

/// The text of the plan as actions.
Result<std::string> convert_to_actions(const ExportArguments& arguments,
                                       const input::RoadmapInput& input) {
  if (!input.poses || input.poses->turn() != continuous::Ticks(1))
    return Error{
        ErrorCode::invalid_instance,
        "planviz shows robots on a grid that turn in one timestep: --headings, or a problem of "
        "the League of Robot Runners",
        {input.source, 0}};
  const auto checked = read_checked(arguments, input);
  if (!checked) return checked.error();
  return export_planviz(*input.poses, checked->plan, verify(input.instance, checked->plan));
}

/// Why the plan cannot be written as samples.
std::optional<Error> why_no_samples(const continuous::Instance& instance,
                                    const continuous::Plan& plan, const SampleOptions& options) {
  const auto units = [&](continuous::Ticks ticks) {
    return continuous::in_input_units(ticks, instance.resolution());
  };
  double time = 0, last = 0;
  for (const AgentId agent : instance.agent_ids()) {
    time += continuous::in_input_units(cost(plan.paths[agent]), instance.resolution());
    last = std::max(last, units(plan.paths[agent].back().arrive));
  }
  if (time * options.rate > kMaxSamples)
    return Error{
        ErrorCode::out_of_range, "more than 10 million samples; take a smaller --rate", {}};
  if (options.format != ExportFormat::csv && last > kLastRosSecond)
    return Error{ErrorCode::out_of_range,
                 "the times of ROS end at 2147483647 seconds, and the plan later",
                 {}};
  return std::nullopt;
}

/// The text of the plan as samples, or as actions.
Result<std::string> convert(const ExportArguments& arguments, const input::RoadmapInput& input) {
  if (arguments.to == ExportFormat::planviz) return convert_to_actions(arguments, input);
  const auto checked = read_checked(arguments, input);
  if (!checked) return checked.error();
  warn_of_durations(input);
  SampleOptions options{*arguments.to};
  if (arguments.rate) options.rate = *arguments.rate;
  if (arguments.ros) options.ros = static_cast<RosVersion>(*arguments.ros);
  if (auto error = why_no_samples(input.instance, checked->plan, options)) return *std::move(error);
  const auto named = naming(arguments, input);
  if (!named) return named.error();
  const auto robots = robot_names(named->names, input.instance.num_agents());
  if (!robots) return Error{robots.error().code, robots.error().message, {named->source, 0}};
  return export_samples(input.instance, poses_or_null(input), checked->plan, *robots, options);
}

ExitCode release(const ExportArguments& arguments, const OrderWriter& writer,
                 const execution::Precedences& order) {
  std::ifstream states(arguments.states);
  if (!states) {
    report_error({ErrorCode::io, "cannot be read", {arguments.states, 0}});
    return ExitCode::bad_input;
  }
  int failure = 0;
  // At once, for whoever hands them on.
  const auto take = [&failure](const std::string& text) {
    failure = write_stdout(text);
    return failure == 0;
  };
  const auto error = release_orders(writer, order, states, arguments.states, take, report_warning);
  if (failure != 0) {
    report_write_failure("-", failure);
    return ExitCode::output;
  }
  if (!error) return ExitCode::success;
  report_error(*error);
  return ExitCode::bad_input;
}

Result<OrderNames> names_in_orders(const ExportArguments& arguments,
                                   const input::RoadmapInput& input, const continuous::Plan& plan) {
  const auto named = naming(arguments, input);
  if (!named) return named.error();
  auto names =
      order_names(*named, plan, input.instance.roadmap().num_vertices(), arguments.order_id);
  if (names && !arguments.time_stamp.empty()) names->time_stamp = arguments.time_stamp;
  return names;
}

ExitCode write_orders(const ExportArguments& arguments, const OutputFile& output,
                      const input::RoadmapInput& input, const Checked& checked) {
  auto names = names_in_orders(arguments, input, checked.plan);
  if (!names) {
    report_error(names.error());
    return ExitCode::bad_input;
  }
  warn_of_durations(input);
  if (!may_lock_up(arguments, checked.order, *names)) return ExitCode::violations;
  const OrderWriter writer(input.instance, poses_or_null(input), checked.plan,
                           std::move(names).value(),
                           arguments.vda_version.value_or(VdaVersion::v3_0));
  if (!arguments.states.empty()) return release(arguments, writer, checked.order);
  return write_or_report(output, writer.orders(checked.order)) ? ExitCode::success
                                                               : ExitCode::output;
}

/// Writes the orders once, or again and again as robots go.
ExitCode give_orders(const ExportArguments& arguments) {
  const auto output = OutputFile::probe(arguments.output);
  if (!output) {
    report_error(output.error());
    return ExitCode::output;
  }
  const auto input = load_roadmap_input(arguments.roadmap, arguments.input);
  const auto checked = input ? read_checked(arguments, *input) : Result<Checked>(input.error());
  if (!checked) {
    report_error(checked.error());
    return ExitCode::bad_input;
  }
  return write_orders(arguments, *output, *input, *checked);
}

}  // namespace

ExitCode export_roadmap(const CLI::App& app, const ExportArguments& arguments) {
  if (const std::string wrong = check(arguments); !wrong.empty()) return usage_error(app, wrong);
  if (arguments.to == ExportFormat::vda5050) return give_orders(arguments);
  return convert_and_write(
      arguments.output, [&] { return load_roadmap_input(arguments.roadmap, arguments.input); },
      [&](const auto& input) { return convert(arguments, input); });
}

}  // namespace quadrille::cli
