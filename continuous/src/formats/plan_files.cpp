// SPDX-License-Identifier: MIT
#include "quadrille/continuous/plan_files.hpp"

#include <fstream>
#include <istream>
#include <ostream>
#include <string>

#include "formats/plan_codecs.hpp"
#include "quadrille/text/sniff.hpp"
#include "quadrille/text/text_input.hpp"

namespace quadrille::continuous {
namespace {

std::string why_not_in_file(const Instance& instance, AgentId agent, const Path& path,
                            PlanFormat format) {
  if (path.empty()) return "the path is empty";
  for (const Stop& stop : path)
    if (stop.vertex.index() >= instance.roadmap().num_vertices())
      return "there is no vertex " + std::to_string(stop.vertex.index());
  return format == PlanFormat::ccbs ? why_not_in_log(instance, agent, path) : "";
}

}  // namespace

std::string_view to_string(PlanFormat format) noexcept {
  return format == PlanFormat::json ? "json" : "ccbs";
}

std::optional<PlanFormat> parse_plan_format(std::string_view text) noexcept {
  for (const PlanFormat format : {PlanFormat::json, PlanFormat::ccbs})
    if (text == to_string(format)) return format;
  return std::nullopt;
}

std::optional<PlanFormat> plan_format_of(const std::filesystem::path& path) {
  if (path.extension() == ".json") return PlanFormat::json;
  if (path.extension() == ".xml") return PlanFormat::ccbs;
  return std::nullopt;
}

Result<PlanFile> read_plan(std::istream& in, const std::string& file, const Instance& instance,
                           const GridRoadmap* grid, std::optional<PlanFormat> format) {
  const auto text = text::read_all(in, file);
  if (!text) return text.error();
  if (auto error =
          text::refuse_other(*text, file, {text::FileKind::own_plan, text::FileKind::ccbs_log}))
    return *error;
  const auto first = text->find_first_not_of(" \t\r\n");
  const bool is_xml = first != std::string::npos && (*text)[first] == '<';
  if (format.value_or(is_xml ? PlanFormat::ccbs : PlanFormat::json) == PlanFormat::ccbs)
    return read_ccbs_log(*text, file, instance, grid);
  return read_json_plan(*text, file, instance);
}

Result<PlanFile> read_plan(const std::filesystem::path& path, const Instance& instance,
                           const GridRoadmap* grid, std::optional<PlanFormat> format) {
  std::ifstream in;
  if (auto error = text::open_input(path, in)) return *error;
  return read_plan(in, path.string(), instance, grid, format);
}

std::optional<Error> write_plan(std::ostream& out, const std::string& file,
                                const Instance& instance, const Plan& plan, PlanFormat format,
                                const GridRoadmap* grid) {
  if (format == PlanFormat::ccbs && plan.paths.empty() && instance.num_agents() > 0)
    return Error{ErrorCode::invalid_plan, "a log of no agent is no plan for some", {file, 0}};
  for (const AgentId i : IdRange<AgentId>(plan.paths.size())) {
    const std::string why = why_not_in_file(instance, i, plan.paths[i], format);
    if (!why.empty())
      return Error{ErrorCode::invalid_plan,
                   "agent " + std::to_string(i.index()) + " cannot be written as " +
                       std::string(to_string(format)) + ": " + why,
                   {file, 0}};
  }
  if (format == PlanFormat::ccbs)
    write_ccbs_log(out, instance, plan, grid);
  else
    write_json_plan(out, instance, plan);
  return text::finish_output(out, file);
}

}  // namespace quadrille::continuous
