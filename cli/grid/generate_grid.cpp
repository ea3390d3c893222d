// SPDX-License-Identifier: MIT
#include "grid/generate_grid.hpp"

#include <filesystem>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

#include "frame/arguments.hpp"
#include "frame/output.hpp"
#include "quadrille/discrete/generator.hpp"
#include "quadrille/input/source.hpp"

namespace quadrille::cli {
namespace {

using discrete::GridMap;

std::int32_t size_or(std::optional<std::int64_t> size, std::int32_t otherwise) {
  return size ? static_cast<std::int32_t>(*size) : otherwise;
}

Result<GridMap> make_map(const GenerateArguments& arguments) {
  if (!arguments.kind) return discrete::read_map(std::filesystem::path(arguments.map));
  const std::int32_t width = size_or(arguments.width, 32), height = size_or(arguments.height, 32);
  const std::uint64_t seed = arguments.random_seed();
  switch (*arguments.kind) {
    case Kind::empty:
      return discrete::empty_map(width, height);
    case Kind::random:
      return discrete::random_map(width, height, arguments.obstacles.value_or(0.2), seed);
    case Kind::maze:
      return discrete::maze_map(width, height, size_or(arguments.corridor_width, 2), seed);
    case Kind::room:
      return discrete::room_map(width, height, size_or(arguments.room_size, 4),
                                arguments.doors.value_or(0.5), seed);
    case Kind::warehouse:
    case Kind::roadmap:
      break;
  }
  discrete::WarehouseLayout layout;
  layout.shelf_columns = size_or(arguments.shelf_columns, layout.shelf_columns);
  layout.shelf_rows = size_or(arguments.shelf_rows, layout.shelf_rows);
  layout.shelf_length = size_or(arguments.shelf_length, layout.shelf_length);
  layout.shelf_width = size_or(arguments.shelf_width, layout.shelf_width);
  layout.aisle_width = size_or(arguments.aisle_width, layout.aisle_width);
  layout.side_width = size_or(arguments.side_width, layout.side_width);
  return discrete::warehouse_map(layout);
}

/// The name that scenario rows give their map: a file name without blanks.
std::string map_name(const GenerateArguments& arguments) {
  const std::string& file = arguments.kind ? arguments.map_output : arguments.map;
  std::string name = std::filesystem::path(file).filename().string();
  for (char& c : name)
    if (std::string_view(" \t\r\n\v\f").find(c) != std::string_view::npos) c = '_';
  return name.empty() || file == "-" || file == input::kStandardInput ? "map.map" : name;
}

/// The texts of the map and the scenario, in this order, as far as they are wanted.
Result<std::vector<std::string>> make_texts(const GenerateArguments& arguments) {
  const auto map = make_map(arguments);
  if (!map) return map.error();
  std::vector<std::string> texts;
  if (!arguments.map_output.empty()) {
    std::ostringstream text;
    if (auto error = write_map(text, arguments.map_output, *map)) return *error;
    texts.push_back(text.str());
  }
  if (!arguments.scen_output.empty()) {
    discrete::ScenarioOptions options;
    options.reachable = !arguments.any_goal;
    options.map_name = map_name(arguments);
    const auto agents = static_cast<std::size_t>(*arguments.agents);
    const auto scenario = discrete::random_scenario(*map, agents, arguments.random_seed(), options);
    if (!scenario) return scenario.error();
    std::ostringstream text;
    if (auto error = write_scenario(text, arguments.scen_output, *scenario)) return *error;
    texts.push_back(text.str());
  }
  return texts;
}

}  // namespace

ExitCode generate_grid(const CLI::App& app, const GenerateArguments& arguments) {
  std::vector<OutputFile> outputs;
  for (const std::string* path : {&arguments.map_output, &arguments.scen_output}) {
    if (path->empty()) continue;
    auto output = OutputFile::probe(*path);
    if (!output) {
      report_error(output.error());
      return ExitCode::output;
    }
    outputs.push_back(std::move(output.value()));
  }
  const auto texts = make_texts(arguments);
  if (!texts) {
    // A map that was read can be wrong; a map that was asked for can be impossible.
    if (arguments.kind) return usage_error(app, texts.error().message);
    report_error(texts.error());
    return ExitCode::bad_input;
  }
  bool all = true;
  for (std::size_t i = 0; i < outputs.size(); ++i)
    all = write_or_report(outputs[i], (*texts)[i]) && all;
  return all ? ExitCode::success : ExitCode::output;
}

}  // namespace quadrille::cli
