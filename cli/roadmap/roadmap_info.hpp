// SPDX-License-Identifier: MIT
#pragma once

#include "exit_codes.hpp"
#include "roadmap/roadmap_input.hpp"

namespace quadrille::cli {

/// `info` for a roadmap. Requires options that pass check_roadmap_options.
[[nodiscard]] ExitCode print_roadmap_info(const RoadmapOptions& options, const InputOptions& input);

}  // namespace quadrille::cli
