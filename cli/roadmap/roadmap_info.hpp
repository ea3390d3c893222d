// SPDX-License-Identifier: MIT
#pragma once

#include "frame/exit_codes.hpp"
#include "frame/input_options.hpp"

namespace quadrille::cli {

/// `info` for a roadmap. Requires options that pass check_roadmap_options.
[[nodiscard]] ExitCode print_roadmap_info(const RoadmapOptions& options, const InputOptions& input);

}  // namespace quadrille::cli
