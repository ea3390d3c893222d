// SPDX-License-Identifier: MIT
#pragma once

#include "exit_codes.hpp"
#include "solve_arguments.hpp"

namespace quadrille::cli {

/// `solve` for roadmaps: checks the arguments, reads, solves and writes.
[[nodiscard]] ExitCode solve_roadmap(const CLI::App& app, const SolveArguments& arguments);

}  // namespace quadrille::cli
