// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "exit_codes.hpp"
#include "option_parser.hpp"

namespace quadrille::cli {

/// What `generate --kind roadmap` is asked for, besides width, height, agents and seed.
struct GenerateRoadmapOptions {
  std::optional<std::int64_t> vertices;
  std::optional<double> altitude, radius, speed, reach, resolution;
  bool mixed = false;
  std::string output;
};

void add_generate_roadmap_options(CLI::App& app, GenerateRoadmapOptions& options);

/// Writes the instance. Impossible sizes are errors of usage.
[[nodiscard]] ExitCode generate_roadmap(const CLI::App& app, const GenerateRoadmapOptions& options,
                                        std::int64_t width, std::int64_t height,
                                        std::int64_t agents, std::uint64_t seed);

}  // namespace quadrille::cli
