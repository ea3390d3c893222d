// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <sstream>
#include <utility>
#include <vector>

#include "output.hpp"
#include "quadrille/discrete/generator.hpp"
#include "roadmap/generate_roadmap.hpp"
#include "subcommands.hpp"

namespace quadrille::cli {
namespace {

using discrete::GridMap;

enum class Kind { empty, random, maze, room, warehouse, roadmap };

constexpr const char* kFooter =
    "Without --map-output and --scen-output the map goes to standard output. The same options and\n"
    "seed give the same files everywhere.\n"
    "\n"
    "Examples:\n"
    "  quadrille generate --kind random --width 32 --height 32 --obstacles 0.2 --seed 1 \\\n"
    "      --map-output r.map --scen-output r.scen --agents 50\n"
    "  quadrille generate --map r.map --scen-output other.scen --agents 50 --seed 2\n"
    "  quadrille generate --kind roadmap --vertices 60 --agents 12 --mixed --instance-output "
    "d.json\n"
    "\n";

struct GenerateArguments {
  std::optional<Kind> kind;
  std::string map;
  std::optional<std::int64_t> width, height, corridor_width, room_size;
  std::optional<double> obstacles, doors;
  std::optional<std::int64_t> shelf_columns, shelf_rows, shelf_length, shelf_width, aisle_width,
      side_width;
  std::optional<std::int64_t> agents, seed;
  bool any_goal = false;
  GenerateRoadmapOptions roadmap;
  std::string map_output, scen_output;

  [[nodiscard]] std::uint64_t random_seed() const {
    return static_cast<std::uint64_t>(seed.value_or(0));
  }
};

std::optional<std::optional<Kind>> choose_kind(std::string_view text) {
  constexpr std::pair<std::string_view, Kind> kKinds[] = {
      {"empty", Kind::empty}, {"random", Kind::random},       {"maze", Kind::maze},
      {"room", Kind::room},   {"warehouse", Kind::warehouse}, {"roadmap", Kind::roadmap}};
  for (const auto& [name, kind] : kKinds)
    if (text == name) return std::optional(kind);
  return std::nullopt;
}

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
  return name.empty() || name == "-" ? "map.map" : name;
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

ExitCode run(const CLI::App& app, const GenerateArguments& arguments) {
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

/// An option that belongs to some kinds of map only.
struct KindOption {
  const char* name;
  std::vector<Kind> kinds;
  /// Whether it belongs to all maps, given ones included.
  [[nodiscard]] bool of_maps() const {
    return kinds.size() == 5 && kinds.back() == Kind::warehouse;
  }
};

const std::vector<KindOption>& kind_options() {
  static const std::vector<KindOption> options = {
      {"--width", {Kind::empty, Kind::random, Kind::maze, Kind::room, Kind::roadmap}},
      {"--height", {Kind::empty, Kind::random, Kind::maze, Kind::room, Kind::roadmap}},
      {"--obstacles", {Kind::random}},
      {"--corridor-width", {Kind::maze}},
      {"--room-size", {Kind::room}},
      {"--doors", {Kind::room}},
      {"--shelf-columns", {Kind::warehouse}},
      {"--shelf-rows", {Kind::warehouse}},
      {"--shelf-length", {Kind::warehouse}},
      {"--shelf-width", {Kind::warehouse}},
      {"--aisle-width", {Kind::warehouse}},
      {"--side-width", {Kind::warehouse}},
      {"--vertices", {Kind::roadmap}},
      {"--radius", {Kind::roadmap}},
      {"--speed", {Kind::roadmap}},
      {"--mixed", {Kind::roadmap}},
      {"--resolution", {Kind::roadmap}},
      {"--instance-output", {Kind::roadmap}},
      {"--map-output", {Kind::empty, Kind::random, Kind::maze, Kind::room, Kind::warehouse}},
      {"--scen-output", {Kind::empty, Kind::random, Kind::maze, Kind::room, Kind::warehouse}},
      {"--any-goal", {Kind::empty, Kind::random, Kind::maze, Kind::room, Kind::warehouse}},
  };
  return options;
}

/// What is wrong with the combination of options; empty if nothing is. Settles where the map goes.
std::string settle(const CLI::App& app, GenerateArguments& arguments) {
  if (arguments.kind.has_value() == !arguments.map.empty())
    return "either --kind or --map is needed";
  for (const KindOption& option : kind_options()) {
    if (app.count(option.name) == 0) continue;
    if (!arguments.kind && option.of_maps()) continue;
    if (!arguments.kind) return fmt::format("{} belongs to --kind", option.name);
    bool fits = false;
    for (const Kind kind : option.kinds) fits = fits || kind == *arguments.kind;
    if (!fits) return fmt::format("{} does not belong to this --kind", option.name);
  }
  if (arguments.kind == Kind::roadmap) return arguments.agents ? "" : "--agents is missing";
  if (arguments.map_output.empty() && arguments.scen_output.empty()) {
    if (!arguments.kind) return "--scen-output is missing";
    arguments.map_output = "-";
  }
  if (!arguments.kind && !arguments.map_output.empty()) return "--map-output belongs to --kind";
  if (arguments.scen_output.empty() == arguments.agents.has_value())
    return arguments.agents ? "--agents needs --scen-output" : "--agents is missing";
  if (arguments.any_goal && arguments.scen_output.empty()) return "--any-goal needs --scen-output";
  return check_outputs(
      {{"--map-output", &arguments.map_output}, {"--scen-output", &arguments.scen_output}},
      {&arguments.map});
}

void add_options(CLI::App& app, GenerateArguments& arguments) {
  constexpr std::int64_t kMost = INT32_MAX;
  add_choice<std::optional<Kind>>(app, "--kind", arguments.kind,
                                  "empty, random, maze, room, warehouse or roadmap", choose_kind,
                                  "Make a map: empty, random, maze, room or warehouse; or a\n"
                                  "roadmap with agents in continuous time");
  add_file(app, "--map", arguments.map, "Instead: make a scenario for this map");
  add_file(app, "--map-output", arguments.map_output, "Write the map");
  add_file(app, "--scen-output", arguments.scen_output, "Write a scenario with random agents");
  add_integer(app, "--agents", arguments.agents, 0, kMost, "Number of agents");
  app.add_flag("--any-goal", arguments.any_goal, "Draw goals that may be out of reach, too");
  add_integer(app, "--seed", arguments.seed, 0, INT64_MAX, "Seed of all random choices; default 0");
  const auto add = [&](const char* name, std::optional<std::int64_t>& number, int least,
                       const char* help) {
    add_integer(app, name, number, least, kMost, help)->group("Kinds of map");
  };
  add("--width", arguments.width, 1, "All but warehouse; default 32");
  add("--height", arguments.height, 1, "All but warehouse; default 32");
  add_share(app, "--obstacles", arguments.obstacles, "Random: share of blocked cells; default 0.2")
      ->group("Kinds of map");
  add("--corridor-width", arguments.corridor_width, 1, "Maze; default 2");
  add("--room-size", arguments.room_size, 1, "Room; default 4");
  add_share(app, "--doors", arguments.doors,
            "Room: share of the doors beyond those that connect all rooms; default 0.5")
      ->group("Kinds of map");
  add("--shelf-columns", arguments.shelf_columns, 1, "Warehouse; default 10");
  add("--shelf-rows", arguments.shelf_rows, 1, "Warehouse; default 20");
  add("--shelf-length", arguments.shelf_length, 1, "Warehouse; default 10");
  add("--shelf-width", arguments.shelf_width, 1, "Warehouse; default 2");
  add("--aisle-width", arguments.aisle_width, 1, "Warehouse; default 1");
  add("--side-width", arguments.side_width, 0,
      "Warehouse: open columns left and right; default 25");
  add_generate_roadmap_options(app, arguments.roadmap);
}

}  // namespace

Subcommand add_generate(CLI::App& program) {
  CLI::App* app = program.add_subcommand("generate", "Make maps and scenarios");
  const auto arguments = std::make_shared<GenerateArguments>();
  add_options(*app, *arguments);
  app->footer(std::string(kFooter) + kExitCodesHelp);
  return {app, [app, arguments] {
            const std::string wrong = settle(*app, *arguments);
            if (!wrong.empty()) return usage_error(*app, wrong);
            if (arguments->kind != Kind::roadmap) return run(*app, *arguments);
            return generate_roadmap(*app, arguments->roadmap, arguments->width.value_or(32),
                                    arguments->height.value_or(32), *arguments->agents,
                                    arguments->random_seed());
          }};
}

}  // namespace quadrille::cli
