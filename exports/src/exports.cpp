// SPDX-License-Identifier: MIT
#include "quadrille/exports/exports.hpp"

#include <algorithm>
#include <initializer_list>
#include <utility>
#include <vector>

#include "quadrille/continuous/quantise.hpp"
#include "quadrille/core/decimal.hpp"

namespace quadrille::exports {
namespace {

constexpr std::pair<ExportFormat, std::string_view> kFormats[] = {
    {ExportFormat::csv, "csv"},
    {ExportFormat::multidof, "multidof"},
    {ExportFormat::path, "path"},
    {ExportFormat::vda5050, "vda5050"},
    {ExportFormat::rmf_plan, "open-rmf-plan"},
    {ExportFormat::planviz, "planviz"}};

/// The lines of one agent.
std::string table(AgentId agent, const std::vector<Sample>& samples, bool is_flat) {
  std::string text;
  const auto row = [&](std::initializer_list<double> numbers) {
    text += std::to_string(agent.value());
    for (const double number : numbers) text += "," + decimal(number);
    text += "\n";
  };
  for (const Sample& s : samples)
    if (is_flat)
      row({s.time, s.x, s.y, s.vx, s.vy});
    else
      row({s.time, s.x, s.y, s.z, s.vx, s.vy, s.vz});
  return text;
}

constexpr double kMaxSamples = 1e7;

}  // namespace

std::optional<ExportFormat> parse_export_format(std::string_view text) noexcept {
  for (const auto& [format, name] : kFormats)
    if (name == text) return format;
  return std::nullopt;
}

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
    return Error{ErrorCode::out_of_range, "more than 10 million samples; take a smaller rate", {}};
  if (options.format != ExportFormat::csv && last > kLastRosSecond)
    return Error{ErrorCode::out_of_range,
                 "the times of ROS end at 2147483647 seconds, and the plan later",
                 {}};
  return std::nullopt;
}

std::string export_samples(const continuous::Instance& instance, const Yaws* yaws,
                           const continuous::Plan& plan, const RobotNames& robots,
                           const SampleOptions& options) {
  Sampler sampler(instance, yaws, options.rate);
  const bool is_flat = instance.is_flat();
  std::string csv = is_flat ? "agent,time,x,y,vx,vy\n" : "agent,time,x,y,z,vx,vy,vz\n";
  JsonLines messages;
  for (const AgentId agent : instance.agent_ids()) {
    const auto samples = sampler.samples(agent, plan.paths[agent]);
    if (options.format == ExportFormat::csv)
      csv += table(agent, samples, is_flat);
    else if (options.format == ExportFormat::multidof)
      messages.add(multidof_message(robots[agent], samples, options.ros));
    else
      messages.add(path_message(samples, options.ros));
  }
  return options.format == ExportFormat::csv ? csv : messages.text();
}

}  // namespace quadrille::exports
