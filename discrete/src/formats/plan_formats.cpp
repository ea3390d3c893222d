// SPDX-License-Identifier: MIT
#include "quadrille/discrete/plan_formats.hpp"

#include <istream>
#include <ostream>
#include <string>

#include "formats/plan_codecs.hpp"
#include "formats/text_input.hpp"
#include "quadrille/discrete/instance.hpp"
#include "quadrille/text/sniff.hpp"

namespace quadrille::discrete {
namespace {

bool needs_grid(PlanFormat format) {
  return format != PlanFormat::json && format != PlanFormat::yaml;
}

Error no_grid(PlanFormat format, const std::string& file) {
  return {ErrorCode::invalid_plan,
          "the plan format " + std::string(to_string(format)) + " needs a grid",
          {file, 0}};
}

/// The other formats, and who reads them, count from 0.
std::optional<Error> refuse_now(Timestep now, PlanFormat format, const std::string& file) {
  if (now < 0 || now > kMaxNow)
    return Error{ErrorCode::invalid_plan,
                 "the plan begins at timestep " + std::to_string(now) + ", not 0 .. " +
                     std::to_string(kMaxNow),
                 {file, 0}};
  if (now == 0 || format == PlanFormat::json) return std::nullopt;
  return Error{ErrorCode::invalid_plan,
               "plans of the format " + std::string(to_string(format)) +
                   " begin at timestep 0, and this one at " + std::to_string(now),
               {file, 0}};
}

}  // namespace

std::string_view to_string(PlanFormat format) noexcept {
  switch (format) {
    case PlanFormat::json:
      return "json";
    case PlanFormat::cbsh2:
      return "cbsh2";
    case PlanFormat::lns2:
      return "lns2";
    case PlanFormat::visualizer:
      return "visualizer";
    case PlanFormat::lacam:
      return "lacam";
    case PlanFormat::yaml:
      return "yaml";
  }
  return "?";
}

std::optional<PlanFormat> parse_plan_format(std::string_view text) noexcept {
  for (const PlanFormat format : kPlanFormats)
    if (text == to_string(format)) return format;
  return std::nullopt;
}

PlanFormat detect_plan_format(std::string_view text) {
  const auto begin = text.find_first_not_of(" \t\r\n");
  // An empty line is the plan for no agents, which an empty file is in no format.
  if (begin == std::string_view::npos) return text.empty() ? PlanFormat::yaml : PlanFormat::cbsh2;
  text.remove_prefix(begin);
  if (text.front() == '{') return PlanFormat::json;
  if (text.front() >= '0' && text.front() <= '9') return PlanFormat::visualizer;
  if (text.starts_with("Agent ")) return PlanFormat::cbsh2;
  if (text::sniff(text) == text::FileKind::lacam_result) return PlanFormat::lacam;
  return PlanFormat::yaml;
}

std::optional<PlanFormat> plan_format_of(const std::filesystem::path& path) {
  const std::filesystem::path extension = path.extension();
  if (extension == ".json") return PlanFormat::json;
  if (extension == ".yaml" || extension == ".yml") return PlanFormat::yaml;
  return std::nullopt;
}

namespace {

/// `agents`: null if there is only a graph.
Result<PlanFile> read_any_plan(std::istream& in, const std::string& file, const Graph& graph,
                               const IdVector<AgentId, Agent>* agents,
                               std::optional<PlanFormat> format) {
  using text::FileKind;
  const auto text = read_all(in, file);
  if (!text) return text.error();
  const FileKind kind = text::sniff(*text);
  if (auto error =
          text::refuse_other(kind, file,
                             {FileKind::own_plan, FileKind::cbsh2_paths, FileKind::visualizer_plan,
                              FileKind::lacam_result, FileKind::libmrp_schedule, FileKind::planviz,
                              FileKind::tracker_csv}))
    return *error;
  // These two have no name as a format: what they are is beyond doubt.
  const bool is_nameless = kind == FileKind::planviz || kind == FileKind::tracker_csv;
  if (is_nameless && format)
    return Error{ErrorCode::syntax, text::describe(kind) + ", without a plan format", {file, 1}};
  if (is_nameless && !graph.layout())
    return Error{ErrorCode::invalid_plan,
                 "this is " + std::string(text::in_words(kind)) + ", which needs a grid",
                 {file, 1}};
  if (kind == FileKind::planviz) return read_planviz_plan(*text, file, graph);
  if (kind == FileKind::tracker_csv && agents == nullptr)
    return Error{ErrorCode::invalid_plan,
                 "paths in the CSV of the MAPF tracker begin at the starts of an instance: it "
                 "needs a scenario",
                 {file, 1}};
  if (kind == FileKind::tracker_csv) return read_tracker_plan(*text, file, graph, *agents);
  const PlanFormat chosen = format.value_or(detect_plan_format(*text));
  if (needs_grid(chosen) && !graph.layout()) return no_grid(chosen, file);
  switch (chosen) {
    case PlanFormat::json:
      return read_json_plan(*text, file, graph);
    case PlanFormat::cbsh2:
    case PlanFormat::lns2:
      return read_cbsh2_plan(*text, file, graph);
    case PlanFormat::visualizer:
      return read_visualizer_plan(*text, file, graph);
    case PlanFormat::lacam:
      return read_lacam_plan(*text, file, graph);
    case PlanFormat::yaml:
      return read_yaml_plan(*text, file, graph);
  }
  return Error{ErrorCode::internal, "unknown plan format", {file, 0}};
}

}  // namespace

Result<PlanFile> read_plan(std::istream& in, const std::string& file, const Graph& graph,
                           std::optional<PlanFormat> format) {
  return read_any_plan(in, file, graph, nullptr, format);
}

Result<PlanFile> read_plan(std::istream& in, const std::string& file, const Instance& instance,
                           std::optional<PlanFormat> format) {
  return read_any_plan(in, file, instance.graph(), &instance.agents(), format);
}

Result<PlanFile> read_plan(const std::filesystem::path& path, const Graph& graph,
                           std::optional<PlanFormat> format) {
  std::ifstream in;
  if (auto error = open_input(path, in)) return *error;
  return read_plan(in, path.string(), graph, format);
}

Result<PlanFile> read_plan(const std::filesystem::path& path, const Instance& instance,
                           std::optional<PlanFormat> format) {
  std::ifstream in;
  if (auto error = open_input(path, in)) return *error;
  return read_plan(in, path.string(), instance, format);
}

std::optional<Error> write_plan(std::ostream& out, const std::string& file, const Graph& graph,
                                const Plan& plan, PlanFormat format) {
  if (needs_grid(format) && !graph.layout()) return no_grid(format, file);
  if (auto error = refuse_now(plan.now, format, file)) return error;
  for (std::size_t i = 0; i < plan.paths.size(); ++i) {
    const Path& path = plan.paths[AgentId(i)];
    const std::string agent = "the path of agent " + std::to_string(i);
    if (path.empty()) return Error{ErrorCode::invalid_plan, agent + " is empty", {file, 0}};
    for (const VertexId v : path)
      if (v.index() >= graph.num_vertices())
        return Error{ErrorCode::invalid_plan,
                     agent + " has a vertex that the graph does not have",
                     {file, 0}};
  }
  switch (format) {
    case PlanFormat::json:
      write_json_plan(out, graph, plan);
      break;
    case PlanFormat::cbsh2:
      write_cbsh2_plan(out, graph, plan, ": ");
      break;
    case PlanFormat::lns2:
      write_cbsh2_plan(out, graph, plan, ":");
      break;
    case PlanFormat::visualizer:
      write_visualizer_plan(out, graph, plan);
      break;
    case PlanFormat::lacam:
      write_lacam_plan(out, graph, plan);
      break;
    case PlanFormat::yaml:
      write_yaml_plan(out, graph, plan);
      break;
  }
  return finish_output(out, file);
}

}  // namespace quadrille::discrete
