// SPDX-License-Identifier: MIT
#pragma once

#include <variant>

#include "asked/execution_case.hpp"
#include "frame/exit_codes.hpp"
#include "frame/option_parser.hpp"

namespace quadrille::cli {

void add_execution_options(CLI::App& app, ExecutionArguments& arguments);

/// Reads instance and plan and finds the precedences; the exit code if that fails, after the error
/// has been reported.
[[nodiscard]] std::variant<ExecutionCase, ExitCode> load_execution(const CLI::App& app,
                                                                   ExecutionArguments& arguments);

}  // namespace quadrille::cli
