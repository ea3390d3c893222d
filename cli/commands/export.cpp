// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <memory>

#include "exports/export_roadmap.hpp"
#include "frame/arguments.hpp"
#include "frame/subcommands.hpp"
#include "quadrille/exports/naming.hpp"

namespace quadrille::cli {
namespace {

constexpr const char* kFooter =
    "For plans on roadmaps; a grid is one with --roadmap map.map. A plan that breaks a rule is\n"
    "refused; so are orders, unless --allow-cycles is given, that wait for each other for ever: "
    "exit\n"
    "code 1.\n"
    "\n"
    "Examples:\n"
    "  quadrille export --instance discs.json --to csv --rate 20 --output plan.csv plan.json\n"
    "  quadrille export --instance discs.json --to vda5050 --vda-version 2.1 plan.json\n"
    "  ... | quadrille export --instance discs.json --to vda5050 --states - plan.json | ...\n"
    "\n";

}  // namespace

Subcommand add_export(CLI::App& program) {
  CLI::App* app = program.add_subcommand("export", "Write a plan for other systems");
  const auto arguments = std::make_shared<ExportArguments>();
  add_input_options(*app, arguments->input);
  add_roadmap_options(*app, arguments->roadmap);
  add_input_file(*app, "PLAN", arguments->plan, "Plan file")->required();
  add_choice(
      *app, "--to", arguments->to, "csv, multidof, path, vda5050, open-rmf-plan or planviz",
      +[](std::string_view text) -> std::optional<std::optional<exports::ExportFormat>> {
        const auto format = exports::parse_export_format(text);
        if (!format) return std::nullopt;
        return format;
      },
      "csv (samples), multidof (trajectory_msgs), path (nav_msgs), vda5050 (orders),\n"
      "open-rmf-plan (of a plan server) or planviz (actions of robots that turn)")
      ->required();
  add_positive(*app, "--rate", arguments->rate, "Samples per unit of time; default 10");
  add_integer(*app, "--ros", arguments->ros, static_cast<std::int64_t>(exports::RosVersion::one),
              static_cast<std::int64_t>(exports::RosVersion::two),
              "With multidof and path: whose field names, of ROS 1 or 2; default 2");
  add_choice<std::optional<exports::VdaVersion>>(
      *app, "--vda-version", arguments->vda_version, "2.0, 2.1 or 3.0",
      +[](std::string_view text) -> std::optional<std::optional<exports::VdaVersion>> {
        const auto version = exports::parse_vda_version(text);
        if (!version) return std::nullopt;
        return version;
      },
      "With vda5050: 2.0, 2.1 or 3.0 (default)")
      ->type_name("VERSION");
  add_input_file(*app, "--names", arguments->names,
                 "With vda5050 and multidof: what agents, vertices, map and manufacturer are\n"
                 "called, as JSON or YAML");
  const auto read_order_id = [arguments](const std::string& text) {
    if (text.empty()) refuse_value("--order-id", text, "a name");
    arguments->order_id = text;
  };
  add_word(*app, "--order-id", read_order_id,
           "With vda5050: what the ids of orders begin with, before the serial number of each\n"
           "robot; default: they are the serial numbers");
  const auto read_time_stamp = [arguments](const std::string& text) {
    if (!exports::is_time_stamp(text))
      refuse_value("--time-stamp", text, "a time in UTC such as 2026-01-31T12:00:00.000Z");
    arguments->time_stamp = text;
  };
  add_word(*app, "--time-stamp", read_time_stamp,
           "With vda5050: the time stamp of all messages, such as 2026-01-31T12:00:00.000Z;\n"
           "default: the epoch");
  add_input_file(*app, "--states", arguments->states,
                 "States of robots, one JSON message per line: release orders as they go");
  app->add_flag("--allow-cycles", arguments->allow_cycles,
                "With vda5050: write orders that wait for each other for ever, with a warning");
  add_plan_format(*app, "--from", arguments->from,
                  "Format of PLAN; default: by what the file says");
  add_file(*app, "--output", arguments->output, "Where to write; default - is standard output");
  app->footer(std::string(kFooter) + kExitCodesHelp);
  return {app, [app, arguments] {
            if (!is_roadmap(arguments->input, arguments->roadmap))
              return usage_error(*app,
                                 "export is for plans on roadmaps: --roadmap, or an "
                                 "--instance with one");
            return export_roadmap(*app, *arguments);
          }};
}

}  // namespace quadrille::cli
