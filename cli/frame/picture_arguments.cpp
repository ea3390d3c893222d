// SPDX-License-Identifier: MIT
#include "frame/picture_arguments.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>

#include "frame/arguments.hpp"

namespace quadrille::cli {
namespace {

/// "0,3,12"; nullopt for anything else.
std::optional<std::vector<AgentId>> parse_agents(std::string_view text) {
  std::vector<AgentId> agents;
  while (true) {
    std::uint32_t number = 0;
    const std::string_view item = text.substr(0, text.find(','));
    const char* end = item.data() + item.size();
    const auto [stop, error] = std::from_chars(item.data(), end, number);
    if (error != std::errc() || stop != end) return std::nullopt;
    agents.emplace_back(number);
    if (item.size() == text.size()) return agents;
    text.remove_prefix(item.size() + 1);
  }
}

}  // namespace

void add_picture_options(CLI::App& app, PictureArguments& arguments, const std::string& group) {
  add_file(app, "--svg", arguments.file, "Write a picture of the plan as SVG; - is standard output")
      ->group(group);
  const auto read_kind = [&arguments](const std::string& text) {
    const auto kind = view::parse_picture_kind(text);
    if (!kind) refuse_value("--svg-kind", text, "map, space-time or waits");
    arguments.options.kind = *kind;
    arguments.has_details = true;
  };
  app.add_option_function<std::string>(
         "--svg-kind", read_kind,
         "map (default): the paths on the map; space-time: time along the path of the first\n"
         "agent; waits: who waits when")
      ->type_name("NAME")
      ->group(group);
  const auto read_agents = [&arguments](const std::string& text) {
    auto agents = parse_agents(text);
    if (!agents) refuse_value("--svg-agents", text, "a list of agents, such as 0,3,12");
    arguments.options.agents = std::move(*agents);
    arguments.has_details = true;
  };
  app.add_option_function<std::string>("--svg-agents", read_agents,
                                       "Draw these agents only, such as 0,3,12")
      ->type_name("LIST")
      ->group(group);
}

std::string check_picture_options(const PictureArguments& arguments) {
  if (arguments.has_details && arguments.file.empty())
    return "--svg-kind and --svg-agents need --svg";
  return "";
}

std::optional<Error> check_picture_agents(const PictureArguments& arguments,
                                          std::size_t num_agents) {
  const auto& agents = arguments.options.agents;
  const auto unknown = std::find_if(agents.begin(), agents.end(),
                                    [&](AgentId i) { return i.index() >= num_agents; });
  if (unknown == agents.end()) return std::nullopt;
  return Error{ErrorCode::out_of_range,
               fmt::format("--svg-agents names agent {}, but there are {} agents", unknown->value(),
                           num_agents),
               {}};
}

}  // namespace quadrille::cli
