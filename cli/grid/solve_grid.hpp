// SPDX-License-Identifier: MIT
#pragma once

#include "asked/solve_arguments.hpp"
#include "frame/exit_codes.hpp"
#include "frame/input_watch.hpp"

namespace quadrille::cli {

/// `solve` for grids and graphs: checks the arguments, reads, solves and writes. `watch` goes on
/// until all has been read.
[[nodiscard]] ExitCode solve_grid(const CLI::App& app, SolveArguments& arguments,
                                  InputWatch& watch);
/// What the watch does in the end.
[[nodiscard]] ExitCode end_grid_input(SolveArguments arguments, StopReason reason,
                                      const Usage& used);

}  // namespace quadrille::cli
