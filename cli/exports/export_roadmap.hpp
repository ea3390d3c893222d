// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "frame/exit_codes.hpp"
#include "frame/input_options.hpp"
#include "frame/option_parser.hpp"
#include "quadrille/exports/exports.hpp"
#include "quadrille/exports/orders.hpp"
#include "quadrille/input/roadmap.hpp"

namespace quadrille::cli {

/// What `export` was asked on the command line.
struct ExportArguments {
  InputOptions input;
  RoadmapOptions roadmap;
  std::string plan;
  PlanFormats from;
  std::optional<exports::ExportFormat> to;
  std::optional<double> rate;
  std::optional<std::int64_t> ros;  ///< Of exports::RosVersion.
  std::optional<exports::VdaVersion> vda_version;
  std::string names;       ///< A file for exports::parse_naming.
  std::string order_id;    ///< Empty: as robots are called.
  std::string time_stamp;  ///< Empty: the epoch.
  std::string states;      ///< Messages of robots that go; empty: the orders at the start.
  bool allow_cycles = false;
  std::string output = "-";
};

/// Checks the arguments, reads instance and plan, and writes.
[[nodiscard]] ExitCode export_roadmap(const CLI::App& app, const ExportArguments& arguments);

}  // namespace quadrille::cli
