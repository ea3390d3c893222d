// SPDX-License-Identifier: MIT
#pragma once

#include "asked/verdict.hpp"

namespace quadrille::cli {

/// `verify` for grids and graphs: checks the arguments, reads, replays and prints.
[[nodiscard]] ExitCode verify_grid(const CLI::App& app, const VerifyArguments& arguments);

}  // namespace quadrille::cli
