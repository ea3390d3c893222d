// SPDX-License-Identifier: MIT
#pragma once

#include "frame/exit_codes.hpp"
#include "frame/input_options.hpp"

namespace quadrille::cli {

/// `info` on an instance with timesteps, or on a map alone, of which no graph is made: the largest
/// maps have 2^26 cells. Requires options that pass check_grid_options.
[[nodiscard]] ExitCode print_grid_info(const InputOptions& options);

}  // namespace quadrille::cli
