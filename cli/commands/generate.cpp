// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

#include "asked/generate_arguments.hpp"
#include "frame/arguments.hpp"
#include "frame/output.hpp"
#include "frame/subcommands.hpp"
#include "grid/generate_grid.hpp"
#include "roadmap/generate_roadmap.hpp"

namespace quadrille::cli {
namespace {

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

std::optional<std::optional<Kind>> choose_kind(std::string_view text) {
  constexpr std::pair<std::string_view, Kind> kKinds[] = {
      {"empty", Kind::empty}, {"random", Kind::random},       {"maze", Kind::maze},
      {"room", Kind::room},   {"warehouse", Kind::warehouse}, {"roadmap", Kind::roadmap}};
  for (const auto& [name, kind] : kKinds)
    if (text == name) return std::optional(kind);
  return std::nullopt;
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
      {"--altitude", {Kind::roadmap}},
      {"--radius", {Kind::roadmap}},
      {"--speed", {Kind::roadmap}},
      {"--mixed", {Kind::roadmap}},
      {"--reach", {Kind::roadmap}},
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
  add_input_file(app, "--map", arguments.map, "Instead: make a scenario for this map");
  add_file(app, "--map-output", arguments.map_output, "Write the map");
  add_file(app, "--scen-output", arguments.scen_output, "Write a scenario with random agents");
  add_integer(app, "--agents", arguments.agents, 0, kMost,
              "Rows of the scenario, or agents on the roadmap");
  app.add_flag("--any-goal", arguments.any_goal, "Draw goals that may be out of reach, too");
  add_integer(app, "--seed", arguments.seed, 0, INT64_MAX, "Seed of all random choices; default 0");
  const auto add = [&](const char* name, std::optional<std::int64_t>& number, int least,
                       const char* help) {
    add_integer(app, name, number, least, kMost, help)->group("Kinds of map");
  };
  add("--width", arguments.width, 1, "Columns; of a roadmap, its width; not warehouse; default 32");
  add("--height", arguments.height, 1, "Rows; of a roadmap, its height; not warehouse; default 32");
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
            if (arguments->kind != Kind::roadmap) return generate_grid(*app, *arguments);
            return generate_roadmap(*app, arguments->roadmap, arguments->width.value_or(32),
                                    arguments->height.value_or(32), *arguments->agents,
                                    arguments->random_seed());
          }};
}

}  // namespace quadrille::cli
