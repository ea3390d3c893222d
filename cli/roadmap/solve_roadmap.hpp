// SPDX-License-Identifier: MIT
#pragma once

#include "asked/solve_arguments.hpp"
#include "frame/exit_codes.hpp"
#include "frame/input_watch.hpp"

namespace quadrille::cli {

/// `solve` for roadmaps: checks the arguments, reads, solves and writes. `watch` goes on until all
/// has been read.
[[nodiscard]] ExitCode solve_roadmap(const CLI::App& app, const SolveArguments& arguments,
                                     InputWatch& watch);
/// What the watch does in the end.
[[nodiscard]] ExitCode end_roadmap_input(const SolveArguments& arguments, StopReason reason,
                                         const Usage& used);

}  // namespace quadrille::cli
