// SPDX-License-Identifier: MIT
#pragma once

#include "asked/view_arguments.hpp"

namespace quadrille::cli {

/// `view` for roadmaps: checks the arguments, reads and writes.
[[nodiscard]] ExitCode view_roadmap(const CLI::App& app, const ViewArguments& arguments);

}  // namespace quadrille::cli
