// SPDX-License-Identifier: MIT
#pragma once

#include "asked/generate_arguments.hpp"
#include "frame/exit_codes.hpp"
#include "frame/option_parser.hpp"

namespace quadrille::cli {

/// Writes the map and the scenario. Impossible sizes are errors of usage.
[[nodiscard]] ExitCode generate_grid(const CLI::App& app, const GenerateArguments& arguments);

}  // namespace quadrille::cli
