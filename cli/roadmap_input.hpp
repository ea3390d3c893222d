// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>

#include "quadrille/continuous/grid.hpp"
#include "quadrille/continuous/instance.hpp"
#include "quadrille/core/result.hpp"

namespace quadrille::cli {

/// Where an instance in continuous time comes from: `--roadmap`, `--task` and what goes with them.
struct RoadmapOptions {
  std::string roadmap, task;
  std::optional<double> radius, speed, resolution;
  std::optional<std::int64_t> neighbourhood;
};

void add_roadmap_options(CLI::App& app, RoadmapOptions& options);
/// What is wrong with the combination of options; empty if nothing is. Requires a roadmap.
[[nodiscard]] std::string check_roadmap_options(const RoadmapOptions& options,
                                                std::optional<std::int64_t> agents);

struct RoadmapInput {
  continuous::Instance instance;
  std::optional<continuous::GridRoadmap> grid;
  std::string description;  ///< Lines of the human output about the files.
};
/// Requires options that pass check_roadmap_options. All rows of the task without `agents`.
[[nodiscard]] Result<RoadmapInput> load_roadmap_input(const RoadmapOptions& options,
                                                      std::optional<std::int64_t> agents);

}  // namespace quadrille::cli
