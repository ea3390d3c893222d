// SPDX-License-Identifier: MIT
#pragma once

#include "exit_codes.hpp"
#include "solve_arguments.hpp"

namespace quadrille::cli {

/// `solve` for grids and graphs: checks the arguments, reads, solves and writes.
[[nodiscard]] ExitCode solve_grid(const CLI::App& app, SolveArguments& arguments);

}  // namespace quadrille::cli
