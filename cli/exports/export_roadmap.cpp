// SPDX-License-Identifier: MIT
#include "exports/export_roadmap.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "asked/conversion.hpp"
#include "frame/arguments.hpp"
#include "quadrille/continuous/plan_files.hpp"
#include "quadrille/continuous/verify.hpp"
#include "quadrille/exports/planviz.hpp"
#include "quadrille/exports/releasing.hpp"
#include "quadrille/exports/rmf.hpp"
#include "quadrille/input/source.hpp"
#include "roadmap/roadmap_text.hpp"

namespace quadrille::cli {
namespace {

/// The options that belong to some formats only.
std::string check_formats(const ExportArguments& arguments) {
  const exports::ExportFormat to = *arguments.to;
  const bool is_ros = to == exports::ExportFormat::multidof || to == exports::ExportFormat::path;
  const bool is_vda = to == exports::ExportFormat::vda5050;
  const bool is_rmf = to == exports::ExportFormat::rmf_plan;
  if (arguments.rate && (is_vda || is_rmf)) return "--rate belongs to samples; orders have none";
  if (arguments.rate && to == exports::ExportFormat::planviz)
    return "--rate belongs to samples; planviz has one action per timestep";
  if (arguments.ros && !is_ros) return "--ros belongs to multidof and path";
  if (!arguments.names.empty() && !is_vda && !is_rmf && to != exports::ExportFormat::multidof)
    return "--names belongs to vda5050, open-rmf-plan and multidof; the others have no names";
  if (is_vda) return "";
  if (arguments.vda_version) return "--vda-version belongs to --to vda5050";
  if (!arguments.order_id.empty()) return "--order-id belongs to --to vda5050";
  if (!arguments.time_stamp.empty()) return "--time-stamp belongs to --to vda5050";
  if (!arguments.states.empty()) return "--states belongs to --to vda5050";
  if (arguments.allow_cycles && !is_rmf)
    return "--allow-cycles belongs to --to vda5050 and open-rmf-plan; samples have times, and "
           "nobody waits";
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

std::optional<exports::Yaws> yaws_of(const input::RoadmapInput& input) {
  if (!input.poses) return std::nullopt;
  return exports::yaws_of(*input.poses);
}

/// What agents and vertices are called: as the file of --names says, else as the instance does.
Result<exports::Naming> naming(const ExportArguments& arguments, const input::RoadmapInput& input) {
  exports::Naming own;
  own.names = input.names;
  own.source = input.task_source;
  if (arguments.names.empty()) return own;
  const auto text = input::read_text(arguments.names);
  if (!text) return text.error();
  return exports::parse_naming(*text, arguments.names, std::move(own), input.instance.num_agents(),
                               input.instance.roadmap().num_vertices());
}

struct Checked {
  continuous::Plan plan;
  execution::Precedences order;
};

Result<Checked> read_checked(const ExportArguments& arguments, const input::RoadmapInput& input) {
  const bool is_vda = arguments.to == exports::ExportFormat::vda5050;
  const bool is_rmf = arguments.to == exports::ExportFormat::rmf_plan;
  if ((is_vda || is_rmf) && !input.instance.roadmap().is_flat())
    return Error{ErrorCode::invalid_instance,
                 std::string(is_vda ? "orders of VDA 5050" : "plans of Open-RMF") +
                     " have no heights, and the roadmap has",
                 {input.source, 0}};
  auto file = continuous::read_plan(std::filesystem::path(arguments.plan), input.instance,
                                    input.grid_or_null(), arguments.from.continuous);
  if (!file) return file.error();
  if (!is_vda && !is_rmf) {
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
                 const exports::OrderNames& names) {
  const auto lines = exports::describe_lock_up(order, names);
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
  return exports::export_planviz(*input.poses, checked->plan,
                                 verify(input.instance, checked->plan));
}

/// The text of the plan as messages of Open-RMF.
Result<std::string> convert_to_rmf(const ExportArguments& arguments,
                                   const input::RoadmapInput& input) {
  const auto checked = read_checked(arguments, input);
  if (!checked) return checked.error();
  warn_of_durations(input);
  const auto named = naming(arguments, input);
  if (!named) return named.error();
  auto robots = exports::robot_names(named->names, input.instance.num_agents());
  if (!robots) return Error{robots.error().code, robots.error().message, {named->source, 0}};
  exports::RmfHeads heads;
  heads.robots = std::move(robots).value();
  heads.names = named->names;
  heads.map = named->map;
  const auto cycle = exports::blocked_for_ever(checked->order);
  if (!cycle.empty() && !arguments.allow_cycles)
    return Error{ErrorCode::invalid_plan,
                 "with these blockers robots wait for each other for ever, among them " +
                     heads.robots[cycle.front().agent] +
                     "; nothing is written; plan with larger bodies or shorter edges, or use "
                     "--allow-cycles",
                 {arguments.plan, 0}};
  return exports::export_rmf_plan(input.instance, checked->plan, checked->order, heads);
}

/// The text of the plan as samples, as actions, or for Open-RMF.
Result<std::string> convert(const ExportArguments& arguments, const input::RoadmapInput& input) {
  if (arguments.to == exports::ExportFormat::planviz) return convert_to_actions(arguments, input);
  if (arguments.to == exports::ExportFormat::rmf_plan) return convert_to_rmf(arguments, input);
  const auto checked = read_checked(arguments, input);
  if (!checked) return checked.error();
  warn_of_durations(input);
  exports::SampleOptions options{*arguments.to};
  if (arguments.rate) options.rate = *arguments.rate;
  if (arguments.ros) options.ros = static_cast<exports::RosVersion>(*arguments.ros);
  if (auto error = exports::why_no_samples(input.instance, checked->plan, options))
    return *std::move(error);
  const auto named = naming(arguments, input);
  if (!named) return named.error();
  const auto robots = exports::robot_names(named->names, input.instance.num_agents());
  if (!robots) return Error{robots.error().code, robots.error().message, {named->source, 0}};
  const auto yaws = yaws_of(input);
  return exports::export_samples(input.instance, yaws ? &*yaws : nullptr, checked->plan, *robots,
                                 options);
}

ExitCode release(const ExportArguments& arguments, const exports::OrderWriter& writer,
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
  const auto error =
      exports::release_orders(writer, order, states, arguments.states, take, report_warning);
  if (failure != 0) {
    report_write_failure("-", failure);
    return ExitCode::output;
  }
  if (!error) return ExitCode::success;
  report_error(*error);
  return ExitCode::bad_input;
}

Result<exports::OrderNames> names_in_orders(const ExportArguments& arguments,
                                            const input::RoadmapInput& input,
                                            const continuous::Plan& plan) {
  const auto named = naming(arguments, input);
  if (!named) return named.error();
  auto names = exports::order_names(*named, plan, input.instance.roadmap(), arguments.order_id);
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
  const auto yaws = yaws_of(input);
  const exports::OrderWriter writer(input.instance, yaws ? &*yaws : nullptr, checked.plan,
                                    std::move(names).value(),
                                    arguments.vda_version.value_or(exports::VdaVersion::v3_0));
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
  if (arguments.to == exports::ExportFormat::vda5050) return give_orders(arguments);
  return convert_and_write(
      arguments.output, [&] { return load_roadmap_input(arguments.roadmap, arguments.input); },
      [&](const auto& input) { return convert(arguments, input); });
}

}  // namespace quadrille::cli
