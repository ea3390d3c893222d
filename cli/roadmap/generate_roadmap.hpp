// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "asked/generate_arguments.hpp"
#include "frame/exit_codes.hpp"
#include "frame/option_parser.hpp"

namespace quadrille::cli {

void add_generate_roadmap_options(CLI::App& app, GenerateRoadmapOptions& options);

/// Writes the instance. Impossible sizes are errors of usage.
[[nodiscard]] ExitCode generate_roadmap(const CLI::App& app, const GenerateRoadmapOptions& options,
                                        std::int64_t width, std::int64_t height,
                                        std::int64_t agents, std::uint64_t seed);

}  // namespace quadrille::cli
