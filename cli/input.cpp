// SPDX-License-Identifier: MIT
#include "input.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "arguments.hpp"

namespace quadrille::cli {
namespace {

constexpr std::int64_t kMaxAgents = 1'000'000'000;

void add_letters(CLI::App& app, const std::string& name, std::string& letters,
                 const std::string& help) {
  const auto read = [&letters, name](const std::string& text) {
    if (text.empty()) refuse_value(name, text, "a list of letters");
    letters = text;
  };
  app.add_option_function<std::string>(name, read, help)->type_name("LETTERS");
}

}  // namespace

void add_input_options(CLI::App& app, InputOptions& options) {
  const std::string group = "Instance";
  add_input_file(app, "--map", options.map, "Map in MovingAI's format")->group(group);
  add_input_file(app, "--scen", options.scen, "Scenario in MovingAI's format")->group(group);
  add_integer(app, "--agents", options.agents, 0, kMaxAgents,
              "Take the first N rows of --scen, or agents of --instance")
      ->group(group);
  add_input_file(app, "--instance", options.instance,
                 "Instead: one file, quadrille's JSON (also with a roadmap) or\n"
                 "libMultiRobotPlanning's YAML")
      ->group(group);
  add_letters(app, "--passable", options.letters.passable,
              "Map letters that are passable besides . and G");
  add_letters(app, "--blocked", options.letters.blocked,
              "Map letters that are blocked besides @, O and T");
  for (const char* name : {"--passable", "--blocked"}) app.get_option(name)->group(group);
}

std::optional<Error> check_agents(const InputOptions& options, std::size_t agents) {
  if (!options.agents || static_cast<std::size_t>(*options.agents) <= agents) return std::nullopt;
  return Error{ErrorCode::invalid_instance,
               fmt::format("there are only {} agents, not {}", agents, *options.agents),
               {options.instance, 0}};
}

std::optional<Error> check_map_size(const InputOptions& options, std::int64_t cells,
                                    const std::string& file) {
  if (static_cast<std::size_t>(cells) <= options.most_vertices) return std::nullopt;
  return Error{ErrorCode::out_of_range,
               fmt::format("the map has {} passable cells, more than {}, which are the most that "
                           "can be solved",
                           cells, options.most_vertices),
               {file, 0}};
}

Error with_letters_hint(Error error) {
  if (error.message.find("is neither known as passable nor as blocked") != std::string::npos)
    error.message += " (--passable and --blocked say what it is)";
  return error;
}

std::string why_no_instance(const std::string& text) {
  const std::string_view begin = std::string_view(text).substr(0, text.find_first_of("\r\n"));
  if (begin.starts_with("type ")) return "this is a map of MovingAI's: it belongs to --map";
  if (begin.starts_with("version "))
    return "this is a scenario of MovingAI's: it belongs to --scen";
  if (begin.starts_with('<')) return "this is XML: roadmaps belong to --roadmap, tasks to --task";
  return "";
}

std::string PlanFormats::why_not_discrete(const std::string& option) const {
  if (!is_given() || discrete) return "";
  return fmt::format("{} {} is for roadmaps", option, to_string(*continuous));
}

std::string PlanFormats::why_not_continuous(const std::string& option) const {
  if (!is_given() || continuous) return "";
  return fmt::format("{} {} is not for roadmaps, whose plans are json or ccbs", option,
                     to_string(*discrete));
}

CLI::Option* add_plan_format(CLI::App& app, const std::string& name, PlanFormats& formats,
                             const std::string& help) {
  const auto read = [&formats, name](const std::string& text) {
    formats = {discrete::parse_plan_format(text), continuous::parse_plan_format(text)};
    if (!formats.is_given()) refuse_value(name, text, "json, cbsh2, visualizer, yaml or ccbs");
  };
  return app.add_option_function<std::string>(name, read, help)->type_name("FORMAT");
}

}  // namespace quadrille::cli
