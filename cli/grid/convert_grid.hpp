// SPDX-License-Identifier: MIT
#pragma once

#include "asked/conversion.hpp"

namespace quadrille::cli {

/// `convert` for grids and graphs: checks the arguments, reads and writes.
[[nodiscard]] ExitCode convert_grid(const CLI::App& app, const ConvertArguments& arguments);

}  // namespace quadrille::cli
