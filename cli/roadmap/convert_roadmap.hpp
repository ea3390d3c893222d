// SPDX-License-Identifier: MIT
#pragma once

#include "asked/conversion.hpp"

namespace quadrille::cli {

/// `convert` for roadmaps: checks the arguments, reads and writes.
[[nodiscard]] ExitCode convert_roadmap(const CLI::App& app, const ConvertArguments& arguments);

}  // namespace quadrille::cli
