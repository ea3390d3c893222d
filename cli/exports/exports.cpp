// SPDX-License-Identifier: MIT
#include "exports/exports.hpp"

#include <fmt/format.h>

#include <utility>
#include <vector>

namespace quadrille::cli {
namespace {

constexpr std::pair<ExportFormat, std::string_view> kFormats[] = {
    {ExportFormat::csv, "csv"},
    {ExportFormat::multidof, "multidof"},
    {ExportFormat::path, "path"},
    {ExportFormat::vda5050, "vda5050"},
    {ExportFormat::planviz, "planviz"}};

/// The lines of one agent.
std::string table(AgentId agent, const std::vector<Sample>& samples, bool is_flat) {
  std::string text;
  for (const Sample& s : samples)
    text += is_flat
                ? fmt::format("{},{},{},{},{},{}\n", agent.value(), s.time, s.x, s.y, s.vx, s.vy)
                : fmt::format("{},{},{},{},{},{},{},{}\n", agent.value(), s.time, s.x, s.y, s.z,
                              s.vx, s.vy, s.vz);
  return text;
}

}  // namespace

std::optional<ExportFormat> parse_export_format(std::string_view text) noexcept {
  for (const auto& [format, name] : kFormats)
    if (name == text) return format;
  return std::nullopt;
}

std::string export_samples(const continuous::Instance& instance, const continuous::PoseGrid* poses,
                           const continuous::Plan& plan, const RobotNames& robots,
                           const SampleOptions& options) {
  Sampler sampler(instance, poses, options.rate);
  const bool is_flat = instance.is_flat();
  std::string csv = is_flat ? "agent,time,x,y,vx,vy\n" : "agent,time,x,y,z,vx,vy,vz\n";
  JsonLines messages;
  for (const AgentId agent : instance.agent_ids()) {
    const auto samples = sampler.samples(agent, plan.paths[agent]);
    if (options.format == ExportFormat::csv)
      csv += table(agent, samples, is_flat);
    else if (options.format == ExportFormat::multidof)
      messages.add(multidof_message(robots[agent], samples, options.ros).dump());
    else
      messages.add(path_message(samples, options.ros).dump());
  }
  return options.format == ExportFormat::csv ? csv : messages.text();
}

}  // namespace quadrille::cli
